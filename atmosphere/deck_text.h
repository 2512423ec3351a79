/* Deck text: a card deck with the further cards of an own profile and phase function. */
#ifndef DECK_TEXT_H
#define DECK_TEXT_H

#include "sky/card_deck.h"

/* The cards in the manual's columns; the caller frees them.
 *   profile_cards   cards 2C, which follow card 2; "" for none
 *   phase_cards     cards 3B, which follow card 3A2; "" for none */
status deck_text(char **out, const card_deck *deck, const char *profile_cards,
                 const char *phase_cards);

#endif
