#include "base/spelling.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { LETTERS = 63 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

size_t spelling_distance(const char *a, const char *b)
{
    const size_t rows = strnlen(a, LETTERS), columns = strnlen(b, LETTERS);
    size_t d[LETTERS + 1][LETTERS + 1]; /* of the first i letters of a and the first k of b */

    for (size_t i = 0; i <= rows; i++) d[i][0] = i;
    for (size_t k = 0; k <= columns; k++) d[0][k] = k;
    for (size_t i = 1; i <= rows; i++)
        for (size_t k = 1; k <= columns; k++) {
            const size_t exchanged = d[i - 1][k - 1] + (a[i - 1] != b[k - 1]);
            d[i][k] = least(exchanged, 1 + least(d[i - 1][k], d[i][k - 1]));
            if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
                d[i][k] = least(d[i][k], d[i - 2][k - 2] + 1);
        }
    return d[rows][columns];
}

spelling spelling_of(const char *word)
{
    const size_t length = strlen(word), most = length < 6 ? 1 : length / 3;

    return (spelling){.word = word, .distance = least(most + 1, length)};
}

void spelling_offer(spelling *s, const char *known)
{
    const bool is_cut = !strncmp(known, s->word, strlen(s->word));
    const size_t distance = is_cut ? 1 : spelling_distance(s->word, known);

    if (distance >= s->distance) return;
    s->distance = distance;
    s->nearest = known;
}

const char *spelling_hint(const spelling *s, const char *prefix, char out[SPELLING_HINT_SIZE])
{
    *out = '\0';
    if (s->nearest)
        snprintf(out, SPELLING_HINT_SIZE, " (did you mean '%s%.63s'?)", prefix, s->nearest);
    return out;
}
