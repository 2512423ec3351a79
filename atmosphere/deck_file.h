/* Deck file: a .cdk as LOWTRAN 7 reads it, of one run or several. Appendix A item 2. */
#ifndef DECK_FILE_H
#define DECK_FILE_H

#include "base/status.h"

#include <stddef.h>

typedef struct deck_runs {
    size_t count;
    char **texts; /* a deck for each run */
    char **names; /* for messages */
} deck_runs;

/* Appends the runs of a file; deck_file_free releases them all. Cards that host/card_deck knows may
 * be spaced freely, and may be MODTRAN's: its letter and resolution are dropped. A run with further
 * cards (own profile, aerosol, phase function) stands in the manual's columns and is taken as it is.
 * A run that keeps cards of those before it (IRPT 3, 4; MODEL 0 or 7 with IM 0) gets them before its
 * own, as LOWTRAN keeps more than the cards. Fails with STATUS_FORMAT where a card is wrong. */
status deck_file_read(deck_runs *runs, const char *path);

void deck_file_free(deck_runs *runs);

#endif
