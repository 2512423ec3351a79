/* Deck cards: where a run of a card deck ends. Which cards follow is told by the cards before them.
 * Kneizys and others (1988). */
#ifndef DECK_CARDS_H
#define DECK_CARDS_H

#include "files/record_file.h"

#include <stdio.h>

typedef struct deck_cards {
    size_t count; /* lines of the run */
    int irpt;     /* of its card 5 */
    bool plain;   /* host/card_deck reads it: cards 1, 2, 3, 3A1, 3A2, 4 and 5 alone */
    bool whole;   /* needs nothing of the run before it */
    int model, iemsct, im;
} deck_cards;

/* Takes the cards of one run.
 *   run     the run before it, or zeros; becomes this run
 *   lines   gets all of them but card 5, with the blanks before them
 * Numbers stand in the manual's columns, on a card of a plain run also freely spaced. Fails with
 * STATUS_FORMAT where the file ends early, or on an IRPT at which LOWTRAN stops. */
status deck_cards_take(deck_cards *run, record_file *file, FILE *lines);

#endif
