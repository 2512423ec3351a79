#include "sky/card_deck.h"

#include "files/output_file.h"
#include "files/record_file.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* A field of a card: the manual's name, its place in the deck and in the columns, its range. */
typedef struct field {
    const char *name;
    size_t offset;
    int width;
    int decimals; /* WHOLE: the deck holds an int */
    double low, high;
} field;

typedef struct card {
    const char *name;
    size_t count;
    const field *fields;
} card;

enum { WHOLE = -1, FIELD_LIMIT = 15, BLANK = ' ' };

#define AT(member) offsetof(card_deck, member)
#define CARD(name, fields)                                                                         \
    {                                                                                              \
        name, sizeof fields / sizeof fields[0], fields                                             \
    }
#define DEGREE_LIMIT 360.0
#define KM_LIMIT 99999.0
#define CM1_LIMIT 5e4

static const field fields_1[] = {
    {"MODEL", AT(model), 5, WHOLE, 1, 6},   {"ITYPE", AT(itype), 5, WHOLE, 1, 3},
    {"IEMSCT", AT(iemsct), 5, WHOLE, 0, 3}, {"IMULT", AT(imult), 5, WHOLE, 0, 1},
    {"M1", AT(m[0]), 5, WHOLE, 0, 7},       {"M2", AT(m[1]), 5, WHOLE, 0, 7},
    {"M3", AT(m[2]), 5, WHOLE, 0, 7},       {"M4", AT(m[3]), 5, WHOLE, 0, 7},
    {"M5", AT(m[4]), 5, WHOLE, 0, 7},       {"M6", AT(m[5]), 5, WHOLE, 0, 7},
    {"MDEF", AT(mdef), 5, WHOLE, 0, 2},     {"IM", AT(im), 5, WHOLE, 0, 1},
    {"NOPRT", AT(noprt), 5, WHOLE, -1, 2},  {"TBOUND", AT(tbound_k), 8, 3, -1.0, 999.0},
    {"SALB", AT(salb), 7, 2, 0.0, 1.0},
};
static const field fields_2[] = {
    {"IHAZE", AT(ihaze), 5, WHOLE, 0, 10},      {"ISEASN", AT(iseasn), 5, WHOLE, 0, 2},
    {"IVULCN", AT(ivulcn), 5, WHOLE, 0, 8},     {"ICSTL", AT(icstl), 5, WHOLE, 0, 10},
    {"ICLD", AT(icld), 5, WHOLE, 0, 10},        {"IVSA", AT(ivsa), 5, WHOLE, 0, 0},
    {"VIS", AT(vis_km), 10, 3, 0.0, 1000.0},    {"WSS", AT(wss_m_s), 10, 3, 0.0, 200.0},
    {"WHH", AT(whh_m_s), 10, 3, 0.0, 200.0},    {"RAINRT", AT(rainrt_mm_h), 10, 3, 0.0, 1000.0},
    {"GNDALT", AT(gndalt_km), 10, 3, 0.0, 9.0},
};
static const field fields_3[] = {
    {"H1", AT(h1_km), 10, 3, 0.0, KM_LIMIT},
    {"H2", AT(h2_km), 10, 3, 0.0, KM_LIMIT},
    {"ANGLE", AT(angle_deg), 10, 3, 0.0, 180.0},
    {"RANGE", AT(range_km), 10, 3, 0.0, KM_LIMIT},
    {"BETA", AT(beta_deg), 10, 3, 0.0, 180.0},
    {"RO", AT(ro_km), 10, 3, 0.0, 7000.0},
    {"LEN", AT(len), 5, WHOLE, 0, 1},
};
/* IEMSCT 3; five blank columns stand before RO. */
static const field fields_3_sun[] = {
    {"H1", AT(h1_km), 10, 3, 0.0, KM_LIMIT},       {"H2", AT(h2_km), 10, 3, 0.0, KM_LIMIT},
    {"ANGLE", AT(angle_deg), 10, 3, 0.0, 180.0},   {"IDAY", AT(iday), 5, WHOLE, 0, 366},
    {"RO", AT(ro_km), 15, 3, 0.0, 7000.0},         {"ISOURC", AT(isourc), 5, WHOLE, 0, 1},
    {"ANGLEM", AT(anglem_deg), 10, 3, 0.0, 180.0},
};
static const field fields_3a1[] = {
    {"IPARM", AT(iparm), 5, WHOLE, 0, 2},
    {"IPH", AT(iph), 5, WHOLE, 0, 2},
    {"IDAY", AT(iday), 5, WHOLE, 0, 366},
    {"ISOURC", AT(isourc), 5, WHOLE, 0, 1},
};
static const field fields_3a2[] = {
    {"PARM1", AT(parm[0]), 10, 3, -DEGREE_LIMIT, DEGREE_LIMIT},
    {"PARM2", AT(parm[1]), 10, 3, -DEGREE_LIMIT, DEGREE_LIMIT},
    {"PARM3", AT(parm[2]), 10, 3, -DEGREE_LIMIT, DEGREE_LIMIT},
    {"PARM4", AT(parm[3]), 10, 3, -DEGREE_LIMIT, DEGREE_LIMIT},
    {"TIME", AT(time_h), 10, 3, 0.0, 24.0},
    {"PSIPO", AT(psipo_deg), 10, 3, -DEGREE_LIMIT, DEGREE_LIMIT},
    {"ANGLEM", AT(anglem_deg), 10, 3, 0.0, 180.0},
    {"G", AT(g), 10, 3, -1.0, 1.0},
};
static const field fields_4[] = {
    {"V1", AT(v1_cm1), 10, 3, 0.0, CM1_LIMIT},
    {"V2", AT(v2_cm1), 10, 3, 0.0, CM1_LIMIT},
    {"DV", AT(dv_cm1), 10, 3, 1e-3, CM1_LIMIT},
};
static const field fields_4_modtran[] = {
    {"IV1", AT(v1_cm1), 10, 0, 0.0, CM1_LIMIT},
    {"IV2", AT(v2_cm1), 10, 0, 0.0, CM1_LIMIT},
    {"IDV", AT(dv_cm1), 10, 0, 1.0, CM1_LIMIT},
    {"IRES", AT(resolution_cm1), 10, WHOLE, 1, 50},
};
static const field fields_5[] = {{"IRPT", AT(irpt), 5, WHOLE, 0, 4}};

enum { CARD_COUNT = 7 };

/* Which cards a run has follows from its card 1 and from the IRPT before it. Returns their number. */
static size_t card_list(const card_deck *deck, int after, card out[CARD_COUNT])
{
    static const card card_1 = CARD("card 1", fields_1), card_2 = CARD("card 2", fields_2),
                      card_3 = CARD("card 3", fields_3), card_3_sun = CARD("card 3", fields_3_sun),
                      card_3a1 = CARD("card 3A1", fields_3a1),
                      card_3a2 = CARD("card 3A2", fields_3a2), card_4 = CARD("card 4", fields_4),
                      card_4_modtran = CARD("card 4", fields_4_modtran),
                      card_5 = CARD("card 5", fields_5);
    size_t count = 0;

    const bool all = after != DECK_NEW_GEOMETRY && after != DECK_NEW_WAVENUMBERS;
    if (all) {
        out[count++] = card_1;
        out[count++] = card_2;
    }
    if (after != DECK_NEW_WAVENUMBERS) out[count++] = deck->iemsct == 3 ? card_3_sun : card_3;
    if (after != DECK_NEW_WAVENUMBERS && deck->iemsct == 2) {
        out[count++] = card_3a1;
        out[count++] = card_3a2;
    }
    if (after != DECK_NEW_GEOMETRY) out[count++] = deck->modtran ? card_4_modtran : card_4;
    out[count++] = card_5;
    return count;
}

static bool is_modtran_letter(char letter)
{
    return letter == 'T' || letter == 'F';
}

/* Reads the fields by the manual's columns, blank is 0. `column` is where the text starts. Returns
 * false where a field holds no number, or a column border cuts one in two. */
static bool read_columns(const char *text, size_t column, const card *c, double *values)
{
    const size_t length = strlen(text);
    size_t from = 0, to = 0;
    int found = 0;
    char part[32];

    for (size_t i = 0; i < c->count; i++, from = to) {
        to = from + (size_t)c->fields[i].width;
        const size_t first = from > column ? from - column : 0;
        const size_t end = to > column ? to - column : 0, last = end < length ? end : length;
        const size_t size = last > first ? last - first : 0;
        memcpy(part, text + (size ? first : 0), size);
        part[size] = '\0';
        const int numbers = record_numbers(part, 1, &values[i]);
        if (numbers < 0 || numbers > 1) return false;
        if (numbers == 0) values[i] = 0.0;
        found += numbers;
    }
    return found == record_numbers(text, 0, NULL);
}

static status store(card_deck *deck, const card *c, const double *values, const record_file *file)
{
    for (size_t i = 0; i < c->count; i++) {
        const field *f = &c->fields[i];
        const bool whole = f->decimals <= 0;
        void *place = (char *)deck + f->offset;
        if (values[i] < f->low || values[i] > f->high || (whole && values[i] != floor(values[i])))
            return record_file_reject(file, "%s with %s %s %g to %g", c->name, f->name,
                                      whole ? "a whole number from" : "from", f->low, f->high);
        if (f->decimals == WHOLE)
            *(int *)place = (int)values[i];
        else
            *(double *)place = values[i];
    }
    return STATUS_OK;
}

static status read_card(card_deck *deck, const card *c, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;
    double values[FIELD_LIMIT];
    char blanked[256];

    TRY(record_file_text(file, &text, c->name));
    if (c->fields == fields_1 && is_modtran_letter(*text)) {
        deck->modtran = true;
        deck->modtran_band = *text == 'T';
        snprintf(blanked, sizeof blanked, "%c%s", BLANK, text + 1);
        text = blanked;
    }
    if (record_numbers(text, c->count, values) != (int)c->count &&
        !read_columns(text, record_file_column(file), c, values)) {
        rc = record_file_reject(file, "%s: %zu numbers, or numbers in the manual's columns",
                                c->name, c->count);
        goto out;
    }
    TRY(store(deck, c, values, file));
out:
    return rc;
}

status card_deck_check_irpt(int irpt, int iemsct, const record_file *file)
{
    if (irpt < DECK_END || irpt == 2 || irpt > DECK_NEW_WAVENUMBERS)
        return record_file_reject(file, "card 5 with IRPT 0, 1, 3 or 4");
    if (irpt == DECK_NEW_GEOMETRY && iemsct >= 2)
        return record_file_reject(file, "card 5 with IRPT 0, 1 or 4: LOWTRAN takes 3 only where no "
                                        "sun is in the run (IEMSCT 0 or 1)");
    return STATUS_OK;
}

/* What no field's range tells. */
static status check_card(const card_deck *deck, const card *c, const record_file *file)
{
    const bool is_4 = c->fields == fields_4 || c->fields == fields_4_modtran;

    if (is_4 && deck->v2_cm1 < deck->v1_cm1)
        return record_file_reject(file, "card 4 with V1 below V2");
    if (c->fields == fields_2 && deck->ihaze == 7)
        return record_file_reject(file,
                                  "card 2 with another IHAZE than 7, which has further cards");
    if (c->fields == fields_3a1 && deck->iph == 1)
        return record_file_reject(file, "card 3A1 with IPH 0 or 2: 1 has further cards");
    if (c->fields == fields_5) return card_deck_check_irpt(deck->irpt, deck->iemsct, file);
    return STATUS_OK;
}

status card_deck_read_next(card_deck *deck, record_file *file)
{
    status rc = STATUS_OK;
    card_deck next = {0};
    card cards[CARD_COUNT];
    const int after = deck->irpt;

    if (after == DECK_NEW_GEOMETRY || after == DECK_NEW_WAVENUMBERS) next = *deck;
    /* The list is complete once card 1 is read. */
    for (size_t i = 0; i < card_list(&next, after, cards); i++) {
        TRY(read_card(&next, &cards[i], file));
        TRY(check_card(&next, &cards[i], file));
    }
    *deck = next;
out:
    return rc;
}

status card_deck_read(card_deck *out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    card_deck deck = {0};

    TRY(record_file_open(&file, path));
    TRY(card_deck_read_next(&deck, file));
    if (deck.irpt != 0) {
        rc = record_file_reject(file, "card 5 with IRPT 0: a deck of one run");
        goto out;
    }
    TRY(record_file_finish(file));
    *out = deck;
out:
    record_file_free(file);
    return rc;
}

/* As many decimals as the value has and the columns hold, at least the manual's. */
static void write_number(FILE *stream, double value, const field *f, int width)
{
    char text[64], longer[64];

    snprintf(text, sizeof text, "%.*f", f->decimals, value);
    for (int decimals = f->decimals + 1; strtod(text, NULL) != value; decimals++) {
        if (snprintf(longer, sizeof longer, "%.*f", decimals, value) >= width) break;
        memcpy(text, longer, sizeof text);
    }
    fprintf(stream, "%*s", width, text);
}

static void write_card(FILE *stream, const card_deck *deck, const card *c)
{
    for (size_t i = 0; i < c->count; i++) {
        const field *f = &c->fields[i];
        const void *place = (const char *)deck + f->offset;
        int width = f->width;
        if (f == fields_1 && deck->modtran) {
            fputc(deck->modtran_band ? 'T' : 'F', stream);
            width--;
        }
        if (f->decimals == WHOLE)
            fprintf(stream, "%*d", width, *(const int *)place);
        else
            write_number(stream, *(const double *)place, f, width);
    }
    fputc('\n', stream);
}

status card_deck_text(char **out, const card_deck *deck, int after)
{
    status rc = STATUS_OK;
    char *text = NULL;
    size_t length;
    card cards[CARD_COUNT];
    const size_t count = card_list(deck, after, cards);
    FILE *stream = open_memstream(&text, &length);

    NEED(stream, STATUS_MEMORY, "no memory for the text of a card deck");
    for (size_t i = 0; i < count; i++) write_card(stream, deck, &cards[i]);
    NEED(fclose(stream) == 0, STATUS_MEMORY, "no memory for the text of a card deck");
    *out = text;
    text = NULL;
out:
    free(text);
    return rc;
}

status card_deck_write(const card_deck *deck, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;
    char *text = NULL;

    TRY(card_deck_text(&text, deck, DECK_END));
    TRY(output_file_open(&file, path));
    fputs(text, output_file_stream(file));
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    free(text);
    return rc;
}
