/* Deck file: a .cdk as LOWTRAN 7 reads it. Appendix A item 2. */
#ifndef DECK_FILE_H
#define DECK_FILE_H

#include "status.h"

/* Reads a deck and returns its text; the caller frees it. A deck of up to seven cards may be spaced
 * freely, and may be MODTRAN's: its letter and resolution are dropped. One with further cards (own
 * profile, phase function) stands in the manual's columns and goes to LOWTRAN as it is. Fails with
 * STATUS_FORMAT where a card is wrong, or the deck asks for a second run. */
status deck_file_read(char **out, const char *path);

#endif
