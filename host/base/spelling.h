/* Spelling: the known name that is nearest to a misspelt one, by the Damerau-Levenshtein distance
 * (letters that are added, left out, exchanged, or swapped with their neighbour): Damerau, CACM 7
 * (1964) 171, with each letter edited once at most. */
#ifndef SPELLING_H
#define SPELLING_H

#include <stddef.h>

typedef struct spelling {
    const char *word;
    const char *nearest; /* of what was offered; NULL: none is near */
    size_t distance;     /* the next one must be nearer than this */
} spelling;

/* What counts as near: a third of the word's letters may be wrong, but at least one, and never
 * all. */
spelling spelling_of(const char *word);

/* Offers a known name, which must outlive *s. One that begins with the word counts as one edit away.
 * Of equals the first stays. */
void spelling_offer(spelling *s, const char *known);

enum { SPELLING_HINT_SIZE = 96 };

/* Writes ` (did you mean 'NEAREST'?)`, with a prefix to the name such as `--`; "" if none is near.
 * Returns out. */
const char *spelling_hint(const spelling *s, const char *prefix, char out[SPELLING_HINT_SIZE]);

/* The distance of two words; words beyond 63 bytes count as cut there. */
size_t spelling_distance(const char *a, const char *b);

#endif
