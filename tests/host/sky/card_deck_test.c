#include "../assert_near.h"
#include "../text_file.h"

#include "sky/card_deck.h"

/* Thesis Appendix A item 2. */
static const char printed[] =
    "F  2   3   2   1   0   0   0   0   0   0   0   0   1 300.000   1.00\n"
    "   1   0   0   1   0   0   0.000   0.000   0.000   0.000   0.000\n"
    "   0.000   0.000  90.000   0.000   0.000   0.000   0\n"
    "   1   2  175   0\n"
    "  39.773  84.109   0.000   0.000  17.000  360.000   0.000   0.000\n"
    "  750    1250    100    2\n"
    "   0\n";

/* The manual's columns (Kneizys and others 1988), blank fields, sun's transmission. */
static const char lowtran_sun[] =
    "    2    3    3    0                                  0    0    1   0.000   0.00\n"
    "    1              1    0         23.000\n"
    "     0.000     0.000    37.151  175\n"
    "   740.000  1260.000     5.000\n"
    "    0\n";

static card_deck read_deck(const char *text)
{
    card_deck deck;
    const status rc = card_deck_read(&deck, text_file(text));

    if (rc != STATUS_OK) fail_msg("%s", status_message());
    return deck;
}

static void the_printed_deck_is_read(void **state)
{
    (void)state;
    const card_deck deck = read_deck(printed);

    assert_true(deck.modtran);
    assert_false(deck.modtran_band);
    assert_int_equal(deck.model, 2);
    assert_int_equal(deck.itype, 3);
    assert_int_equal(deck.iemsct, 2);
    assert_int_equal(deck.imult, 1);
    assert_int_equal(deck.im, 0);
    assert_int_equal(deck.noprt, 1);
    assert_near(deck.tbound_k, 300.0, 0.0);
    assert_near(deck.salb, 1.0, 0.0);
    assert_int_equal(deck.ihaze, 1);
    assert_int_equal(deck.icstl, 1);
    assert_near(deck.angle_deg, 90.0, 0.0);
    assert_int_equal(deck.len, 0);
}

static void the_printed_sun_and_band_are_read(void **state)
{
    (void)state;
    const card_deck deck = read_deck(printed);

    assert_int_equal(deck.iparm, 1);
    assert_int_equal(deck.iph, 2);
    assert_int_equal(deck.iday, 175);
    assert_near(deck.parm[0], 39.773, 0.0);
    assert_near(deck.parm[1], 84.109, 0.0);
    assert_near(deck.time_h, 17.0, 0.0);
    assert_near(deck.psipo_deg, 360.0, 0.0);
    assert_near(deck.v1_cm1, 750.0, 0.0);
    assert_near(deck.v2_cm1, 1250.0, 0.0);
    assert_near(deck.dv_cm1, 100.0, 0.0);
    assert_int_equal(deck.resolution_cm1, 2);
}

static void blank_fields_in_the_manuals_columns_are_zero(void **state)
{
    (void)state;
    const card_deck deck = read_deck(lowtran_sun);

    assert_false(deck.modtran);
    assert_int_equal(deck.iemsct, 3);
    assert_int_equal(deck.m[0], 0);
    assert_int_equal(deck.noprt, 1);
    assert_int_equal(deck.icstl, 1);
    assert_near(deck.vis_km, 23.0, 0.0);
    assert_near(deck.gndalt_km, 0.0, 0.0);
    assert_near(deck.angle_deg, 37.151, 0.0);
    assert_int_equal(deck.iday, 175);
    assert_near(deck.dv_cm1, 5.0, 0.0);
}

static void a_written_deck_reads_as_it_was(void **state)
{
    static const char *const decks[] = {printed, lowtran_sun};

    (void)state;
    for (int i = 0; i < 2; i++) {
        card_deck written = read_deck(decks[i]), deck = {0};
        written.h1_km = 9.8765; /* more decimals than the manual's format prints */
        assert_int_equal(card_deck_write(&written, text_file_at), STATUS_OK);
        assert_int_equal(card_deck_read(&deck, text_file_at), STATUS_OK);
        assert_near(deck.h1_km, 9.8765, 0.0);
        assert_int_equal(deck.modtran, written.modtran);
        assert_int_equal(deck.model, written.model);
        assert_int_equal(deck.iemsct, written.iemsct);
        assert_int_equal(deck.iday, written.iday);
        assert_near(deck.tbound_k, written.tbound_k, 0.0);
        assert_near(deck.vis_km, written.vis_km, 0.0);
        assert_near(deck.angle_deg, written.angle_deg, 0.0);
        assert_near(deck.parm[1], written.parm[1], 0.0);
        assert_near(deck.psipo_deg, written.psipo_deg, 0.0);
        assert_near(deck.v2_cm1, written.v2_cm1, 0.0);
        assert_int_equal(deck.resolution_cm1, written.resolution_cm1);
    }
}

/* The columns of LOWTRAN 7: 13I5,F8.3,F7.2 / 6I5,5F10.3 / 3F10.3,I5,5X,F10.3,I5,F10.3 / 3F10.3 / I5. */
static void a_deck_is_written_in_the_manuals_columns(void **state)
{
    static const char expected[] =
        "    2    3    3    0    0    0    0    0    0    0    0    0    1   0.000   0.00\n"
        "    1    0    0    1    0    0    23.000     0.000     0.000     0.000     0.000\n"
        "     0.000     0.000    37.151  175          0.000    0     0.000\n"
        "   740.000  1260.000     5.000\n"
        "    0\n";
    const card_deck deck = read_deck(lowtran_sun);
    char text[sizeof expected + 1] = "";

    (void)state;
    assert_int_equal(card_deck_write(&deck, text_file_at), STATUS_OK);
    FILE *stream = fopen(text_file_at, "rb");
    assert_true(fread(text, 1, sizeof text - 1, stream) > 0);
    fclose(stream);
    assert_string_equal(text, expected);
}

static void a_wrong_card_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {"F  2", "F  7", 1, "card 1 with MODEL a whole number from 1 to 6"},
        {"F  2", "G  2", 1, "card 1: 15 numbers"},
        {"   1   0   0   1   0   0   0.000", "   7   0   0   1   0   0   0.000   0.000", 2,
         "card 2: 11 numbers"},
        {"   1   0   0   1   0   0", "   1   0   0   1  18   0", 2, "ICLD a whole number from 0"},
        {"90.000", "190.000", 3, "card 3 with ANGLE from 0 to 180"},
        {"   1   2  175", "   1   2  475", 4, "card 3A1 with IDAY a whole number from 0 to 366"},
        {"17.000", "170.00", 5, "card 3A2 with TIME from 0 to 24"},
        {"  750    1250", "  1250    750", 6, "V1 below V2"},
        {"  750    1250", "  750.5    1250", 6, "IV1 a whole number"},
        {"2\n   0\n", "2\n   1\n", 7, "card 5 with IRPT 0: a deck of one run"},
        {"2\n   0\n", "2\n   2\n", 7, "card 5 with IRPT 0, 1, 3 or 4"},
        {"2\n   0\n", "2\n   3\n", 7, "card 5 with IRPT 0, 1 or 4"},
        {"2\n   0\n", "2\n   5\n", 7, "card 5 with IRPT a whole number from 0 to 4"},
        {"2\n   0\n", "2\n", 7, "the file ends, expected card 5"},
        {"2\n   0\n", "2\n   0\n0\n", 8, "the end of the file"},
    };
    card_deck deck;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(card_deck_read(&deck, text_file_with(printed, wrong[i].old, wrong[i].new)),
                       wrong[i].line, wrong[i].expected);
}

static void a_number_across_a_column_border_is_refused(void **state)
{
    card_deck deck;

    (void)state;
    assert_refused(card_deck_read(&deck, text_file_with(lowtran_sun, "     0.000     0.000    37",
                                                        "     0.000  0.000    37")),
                   3, "numbers in the manual's columns");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_deck_is_read),
        cmocka_unit_test(the_printed_sun_and_band_are_read),
        cmocka_unit_test(blank_fields_in_the_manuals_columns_are_zero),
        cmocka_unit_test(a_written_deck_reads_as_it_was),
        cmocka_unit_test(a_deck_is_written_in_the_manuals_columns),
        cmocka_unit_test(a_wrong_card_is_refused_at_its_line),
        cmocka_unit_test(a_number_across_a_column_border_is_refused),
    };

    return cmocka_run_group_tests_name("card_deck", tests, text_file_setup, text_file_teardown);
}
