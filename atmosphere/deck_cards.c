#include "deck_cards.h"

#include "card_deck.h"

#include <stdlib.h>
#include <string.h>

enum { LINE_SIZE = 256, CARD_1 = 15, CARD_2 = 11, CARD_3A1 = 4, COLUMNS = 5 };
enum {
    OWN_LEVEL = 0,
    OWN_PROFILE = 7,
    OWN_AEROSOL = 7,
    OWN_CLOUD = 11,
    CIRRUS = 18,
    SCATTERED = 2
};
/* A card 2D1 and 47 wavelengths on cards 2D2, three each. */
enum { REGION_LIMIT = 4, REGION_CARDS = 17 };

typedef struct taker {
    deck_cards *run;
    record_file *file;
    FILE *lines;
    char line[LINE_SIZE]; /* the last one */
} taker;

static status take(taker *t, const char *expected)
{
    status rc = STATUS_OK;
    const char *text;

    TRY(record_file_text(t->file, &text, expected));
    snprintf(t->line, sizeof t->line, "%*s%s", (int)record_file_column(t->file), "", text);
    fprintf(t->lines, "%*s%s\n", (int)record_file_column(t->file), "", text);
    t->run->count++;
out:
    return rc;
}

static status take_several(taker *t, int count, const char *expected)
{
    status rc = STATUS_OK;

    for (int i = 0; i < count; i++) TRY(take(t, expected));
out:
    return rc;
}

/* Field `index` of the last line, whose first fields are five columns wide; by its place among
 * `count` numbers where the line holds that many. */
static int whole_number(const taker *t, int count, int index)
{
    double values[CARD_1];
    char field[COLUMNS + 1];
    const size_t column = (size_t)index * COLUMNS;

    if (record_numbers(t->line, (size_t)count, values) == count) return (int)values[index];
    if (strlen(t->line) <= column) return 0;
    snprintf(field, sizeof field, "%s", t->line + column);
    return atoi(field);
}

/* Cards 2C, 2C1, 2C2 and 2C3. */
static status take_profile(taker *t)
{
    status rc = STATUS_OK;

    TRY(take(t, "card 2C"));
    const int levels = whole_number(t, 3, 0);
    const bool gases = whole_number(t, 3, 1) == 1, aerosols = whole_number(t, 3, 2) == 1;
    TRY(take_several(t, levels * (1 + 2 * gases + aerosols), "cards 2C1 to 2C3 of each level"));
out:
    return rc;
}

/* Cards 2D, 2D1 and 2D2. */
static status take_aerosol(taker *t)
{
    status rc = STATUS_OK;
    int regions = 0;

    TRY(take(t, "card 2D"));
    for (int i = 0; i < REGION_LIMIT; i++) regions += whole_number(t, REGION_LIMIT, i) != 0;
    TRY(take_several(t, regions * REGION_CARDS, "cards 2D1 and 2D2 of each region"));
out:
    return rc;
}

/* Cards 1 and 2 and what belongs to them. */
static status take_air(taker *t)
{
    status rc = STATUS_OK;
    deck_cards *run = t->run;

    TRY(take(t, "card 1"));
    const bool modtran = strchr("TF", t->line[0]);
    if (modtran) t->line[0] = ' ';
    run->model = whole_number(t, CARD_1, 0);
    run->iemsct = whole_number(t, CARD_1, 2);
    run->im = whole_number(t, CARD_1, 11);
    const bool own_profile = run->model == OWN_LEVEL || run->model == OWN_PROFILE;
    TRY(take(t, "card 2"));
    const int cloud = whole_number(t, CARD_2, 4), structure = whole_number(t, CARD_2, 5);
    const bool own_aerosol = whole_number(t, CARD_2, 0) == OWN_AEROSOL || cloud == OWN_CLOUD;
    run->plain = !own_profile && !own_aerosol && cloud < CIRRUS && structure == 0;
    run->whole = !own_profile || run->im == 1;
    if (modtran && !run->plain) {
        rc =
            record_file_reject(t->file, "a deck for LOWTRAN: of MODTRAN's none with further cards");
        goto out;
    }
    if (cloud >= CIRRUS) TRY(take(t, "card 2A"));
    if (structure != 0) TRY(take(t, "card 2B"));
    if (own_profile && run->im == 1) TRY(take_profile(t));
    if (own_aerosol) TRY(take_aerosol(t));
out:
    return rc;
}

/* Card 3 and what belongs to it. */
static status take_geometry(taker *t)
{
    status rc = STATUS_OK;

    TRY(take(t, "card 3"));
    if (t->run->iemsct != SCATTERED) goto out;
    TRY(take(t, "card 3A1"));
    const bool own_phase = whole_number(t, CARD_3A1, 1) == 1;
    TRY(take(t, "card 3A2"));
    if (!own_phase) goto out;
    t->run->plain = false;
    TRY(take(t, "card 3B1"));
    TRY(take_several(t, whole_number(t, 1, 0), "cards 3B2, one each angle"));
out:
    return rc;
}

static status take_end(taker *t)
{
    status rc = STATUS_OK;
    const char *text;
    char *end;

    TRY(record_file_text(t->file, &text, "card 5"));
    t->run->irpt = (int)strtol(text, &end, 10);
    if (*end || end == text) {
        rc = record_file_reject(t->file, "card 5: one number");
        goto out;
    }
    TRY(card_deck_check_irpt(t->run->irpt, t->run->iemsct, t->file));
    t->run->count++;
out:
    return rc;
}

status deck_cards_take(deck_cards *run, record_file *file, FILE *lines)
{
    status rc = STATUS_OK;
    taker t = {run, file, lines, ""};
    const int after = run->irpt;

    run->count = 0;
    run->whole = false;
    if (after == DECK_END || after == DECK_NEW_CARDS) TRY(take_air(&t));
    if (after != DECK_NEW_WAVENUMBERS) TRY(take_geometry(&t));
    if (after != DECK_NEW_GEOMETRY) TRY(take(&t, "card 4"));
    TRY(take_end(&t));
out:
    return rc;
}
