#include "deck_cards.h"

#include "base/number.h"
#include "sky/card_deck.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places of the fields on cards 1, 2 and 3A1. */
enum { MODEL = 0, IEMSCT = 2, IM = 11, IHAZE = 0, ICLD = 4, IVSA = 5, IPH = 1 };
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

/* Cards that LOWTRAN reads as they stand: for it a comma ends a field, so that 0,350 would be 0. */
static status take_several(taker *t, int count, const char *expected)
{
    status rc = STATUS_OK;

    for (int i = 0; i < count; i++) {
        TRY(take(t, expected));
        for (const char *c = strchr(t->line, ','); c; c = strchr(c + 1, ','))
            if (c > t->line && isdigit((unsigned char)c[-1]) && isdigit((unsigned char)c[1]))
                TRY(record_file_reject(t->file, "%s, decimal points in them, not commas",
                                       expected));
    }
out:
    return rc;
}

/* Whether a number is a whole one that fits into the columns of a field. */
static bool is_field(double value)
{
    return value > -1e4 && value < 1e5 && value == floor(value);
}

/* Reads the first fields of the last line, whole numbers in five columns each; by their place among
 * `count` numbers where the line holds that many. */
static status read_fields(const taker *t, const char *card, int count, int limit, int *out)
{
    status rc = STATUS_OK;
    double values[CARD_1];
    char field[COLUMNS + 1];
    const size_t length = strlen(t->line);
    const bool is_free = record_numbers(t->line, (size_t)count, values) == count;

    for (int i = 0; i < limit; i++) {
        const size_t column = (size_t)i * COLUMNS;
        snprintf(field, sizeof field, "%s", column < length ? t->line + column : "");
        const int found = is_free ? 1 : record_numbers(field, 1, &values[i]);
        if (found < 0 || found > 1 || (found && !is_field(values[i]))) {
            rc = record_file_reject(
                t->file,
                "%s: %d numbers, the first %d of them whole, or numbers in the manual's columns",
                card, count, limit);
            goto out;
        }
        out[i] = found ? (int)values[i] : 0;
    }
out:
    return rc;
}

/* Cards 2C, 2C1, 2C2 and 2C3. */
static status take_profile(taker *t)
{
    status rc = STATUS_OK;

    int fields[3]; /* ML, IRD1, IRD2 */

    TRY(take(t, "card 2C"));
    TRY(read_fields(t, "card 2C", 3, 3, fields));
    const int cards = 1 + 2 * (fields[1] == 1) + (fields[2] == 1);
    TRY(take_several(t, fields[0] * cards, "cards 2C1 to 2C3 of each level"));
out:
    return rc;
}

/* Cards 2D, 2D1 and 2D2. */
static status take_aerosol(taker *t)
{
    status rc = STATUS_OK;
    int regions = 0, fields[REGION_LIMIT]; /* IREG */

    TRY(take(t, "card 2D"));
    TRY(read_fields(t, "card 2D", REGION_LIMIT, REGION_LIMIT, fields));
    for (int i = 0; i < REGION_LIMIT; i++) regions += fields[i] != 0;
    TRY(take_several(t, regions * REGION_CARDS, "cards 2D1 and 2D2 of each region"));
out:
    return rc;
}

/* Cards 1 and 2 and what belongs to them. */
static status take_air(taker *t)
{
    status rc = STATUS_OK;
    deck_cards *run = t->run;
    int first[IM + 1], second[IVSA + 1];

    TRY(take(t, "card 1"));
    const bool modtran = strchr("TF", t->line[0]);
    if (modtran) t->line[0] = ' ';
    TRY(read_fields(t, "card 1", CARD_1, IM + 1, first));
    run->model = first[MODEL];
    run->iemsct = first[IEMSCT];
    run->im = first[IM];
    const bool own_profile = run->model == OWN_LEVEL || run->model == OWN_PROFILE;
    TRY(take(t, "card 2"));
    TRY(read_fields(t, "card 2", CARD_2, IVSA + 1, second));
    const int cloud = second[ICLD], structure = second[IVSA];
    const bool own_aerosol = second[IHAZE] == OWN_AEROSOL || cloud == OWN_CLOUD;
    run->plain = !own_profile && !own_aerosol && cloud < CIRRUS && structure == 0;
    run->whole = !own_profile || run->im == 1;
    if (modtran && !run->plain) {
        rc = record_file_reject(t->file,
                                "a deck for LOWTRAN, or one for MODTRAN without further cards");
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
    int fields[IPH + 1];

    TRY(take(t, "card 3"));
    if (t->run->iemsct != SCATTERED) goto out;
    TRY(take(t, "card 3A1"));
    TRY(read_fields(t, "card 3A1", CARD_3A1, IPH + 1, fields));
    TRY(take(t, "card 3A2"));
    if (fields[IPH] != 1) goto out;
    t->run->plain = false;
    TRY(take(t, "card 3B1"));
    TRY(read_fields(t, "card 3B1", 1, 1, fields));
    TRY(take_several(t, fields[0], "cards 3B2, one each angle"));
out:
    return rc;
}

static status take_end(taker *t)
{
    status rc = STATUS_OK;
    const char *text;
    int64_t irpt;

    TRY(record_file_text(t->file, &text, "card 5"));
    if (!number_read_whole(text, INT_MIN, INT_MAX, &irpt)) {
        rc = record_file_reject(t->file, "card 5: one number");
        goto out;
    }
    t->run->irpt = (int)irpt;
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
