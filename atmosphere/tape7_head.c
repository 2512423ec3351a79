#include "tape7_head.h"

#include "base/number.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_SIZE = 20, NUMBER_SIZE = 32, NAMES = 4 };

typedef struct word {
    tape7_place at;
    char text[WORD_SIZE]; /* in capitals, without underscores */
} word;

/* Names as they stand in heads, blanks and underscores left out. */
static const char *const names[TAPE7_WANTED][NAMES] = {
    {"FREQ", "FREQUENCY", "WAVLENMCRN", "WAVLENNANO"},
    {"TOTTRANS", "TRANS", "COMBINTRANS", "TOTALTRANS"},
    {"PTHTHRML", "PATHTHERMAL"},
    {"SOLSCAT", "SOLSCATT"},
    {"SOLAR", "SOLIRRAD"}};

static const char *const shown[TAPE7_WANTED] = {"FREQ", "TOT TRANS", "PTH THRML", "SOL SCAT",
                                                "SOLAR"};

const char *tape7_column_name(tape7_column column)
{
    return shown[column];
}

/* Words of a head of which two make one name. */
static bool joins(const char *first, const char *second)
{
    static const char *const pairs[][2] = {
        {"TOT", "TRANS"},   {"PTH", "THRML"},   {"THRML", "SCT"}, {"SURF", "EMIS"},
        {"SOL", "SCAT"},    {"SING", "SCAT"},   {"SNGL", "SCAT"}, {"GRND", "RFLT"},
        {"DRCT", "RFLT"},   {"TOTAL", "RAD"},   {"REF", "SOL"},   {"DIR", "EM"},
        {"SOL", "TR"},      {"DIR", "EMIS"},    {"TOA", "SUN"},   {"PATH", "THERMAL"},
        {"WAVLEN", "MCRN"}, {"WAVLEN", "NANO"}, {"SOL", "SCATT"}, {"SOL", "IRRAD"}};

    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (!strcmp(first, pairs[i][0]) && !strcmp(second, pairs[i][1])) return true;
    return false;
}

static int split(const char *text, int column, word words[TAPE7_COLUMNS])
{
    int count = 0;

    for (const char *c = text; count < TAPE7_COLUMNS;) {
        size_t length = 0;
        word *w = &words[count];
        c += strspn(c, " \t");
        if (!*c) break;
        w->at.begin = column + (int)(c - text);
        for (; *c && *c != ' ' && *c != '\t'; c++)
            if (*c != '_' && length + 1 < WORD_SIZE)
                w->text[length++] = (char)toupper((unsigned char)*c);
        w->text[length] = '\0';
        w->at.end = column + (int)(c - text);
        count++;
    }
    return count;
}

static int overlap(tape7_place a, tape7_place b)
{
    const int begin = a.begin > b.begin ? a.begin : b.begin;
    const int end = a.end < b.end ? a.end : b.end;

    return end - begin;
}

static void find_wanted(tape7_head *head)
{
    for (int k = 0; k < TAPE7_WANTED; k++) {
        head->column[k] = -1;
        for (int c = head->count - 1; c >= 0; c--)
            for (int i = 0; i < NAMES && names[k][i]; i++)
                if (!strcmp(head->name[c], names[k][i])) head->column[k] = c;
    }
}

bool tape7_head_read(tape7_head *out, const char *text, int column)
{
    word words[TAPE7_COLUMNS];
    const int count = split(text, column, words);

    if (count < 2 || (strcmp(words[0].text, "FREQ") != 0 && strcmp(words[0].text, "WAVLEN") != 0))
        return false;
    out->count = 0;
    for (int i = 0; i < count; i++) {
        tape7_place *at = &out->at[out->count];
        char *name = out->name[out->count++];
        *at = words[i].at;
        strcpy(name, words[i].text);
        if (i + 1 == count || !joins(words[i].text, words[i + 1].text)) continue;
        strncat(name, words[++i].text, TAPE7_NAME_SIZE - strlen(name) - 1);
        at->end = words[i].at.end;
    }
    out->has_wavelengths = !strcmp(words[0].text, "WAVLEN");
    find_wanted(out);
    return true;
}

bool tape7_head_add(tape7_head *head, const char *text, int column)
{
    word words[TAPE7_COLUMNS];
    const int count = split(text, column, words);

    if (count == 0 || strcmp(words[0].text, "CM-1") != 0) return false;
    for (int i = 1; i < count; i++)
        for (int c = 1; c < head->count; c++) {
            char *name = head->name[c];
            if (overlap(head->at[c], words[i].at) <= 0) continue;
            strncat(name, words[i].text, TAPE7_NAME_SIZE - strlen(name) - 1);
            if (words[i].at.begin < head->at[c].begin) head->at[c].begin = words[i].at.begin;
            break;
        }
    find_wanted(head);
    return true;
}

/* Takes Fortran's numbers too, which drop the letter of an exponent of three digits: 1.2345-101. */
static bool read_number(const char *text, size_t length, double *out)
{
    char copy[NUMBER_SIZE];
    size_t used = 0;

    if (length + 2 > sizeof copy) return false;
    for (size_t i = 0; i < length; i++) {
        const char c = text[i];
        const bool is_sign = c == '+' || c == '-';
        if (is_sign && i > 0 && (isdigit((unsigned char)text[i - 1]) || text[i - 1] == '.'))
            copy[used++] = 'E';
        if (used + 2 > sizeof copy) return false;
        copy[used++] = c == 'D' || c == 'd' ? 'E' : c;
    }
    copy[used] = '\0';
    return number_read(copy, out);
}

/* The column whose name lies over most of a number; count of columns behind the last, -1 for none. */
static int column_at(const tape7_head *head, tape7_place at)
{
    int best = -1, most = 0;

    if (at.begin >= head->at[head->count - 1].end) return head->count;
    for (int i = 0; i < head->count; i++) {
        const int common = overlap(head->at[i], at);
        if (common <= most) continue;
        most = common;
        best = i;
    }
    return best;
}

/* Whether every number stands below a name of its own. */
static bool place_numbers(const tape7_head *head, const tape7_place *at, int count,
                          int column[TAPE7_COLUMNS])
{
    int last = -1;

    for (int i = 0; i < count; i++) {
        column[i] = column_at(head, at[i]);
        if (column[i] < 0 || (column[i] == last && last < head->count)) return false;
        last = column[i];
    }
    return true;
}

bool tape7_head_row(const tape7_head *head, const char *text, int column, double out[TAPE7_WANTED])
{
    tape7_place at[TAPE7_COLUMNS];
    double value[TAPE7_COLUMNS];
    int place[TAPE7_COLUMNS], count = 0;

    for (const char *c = text;; count++) {
        c += strspn(c, " \t");
        if (!*c) break;
        const size_t length = strcspn(c, " \t");
        if (count == TAPE7_COLUMNS || !read_number(c, length, &value[count])) return false;
        at[count].begin = column + (int)(c - text);
        at[count].end = at[count].begin + (int)length;
        c += length;
    }
    if (!place_numbers(head, at, count, place)) {
        if (count != head->count) return false;
        for (int i = 0; i < count; i++) place[i] = i;
    }
    for (int k = 0; k < TAPE7_WANTED; k++) {
        out[k] = (double)NAN;
        for (int i = 0; i < count; i++)
            if (place[i] == head->column[k]) out[k] = value[i];
    }
    return !isnan(out[TAPE7_WAVENUMBER]);
}
