#include "deck_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lines of cards 1 and 2, and of 3, 3A1 and 3A2. */
enum { LINES_TO_PROFILE = 2, LINES_TO_PHASE = 3 };

static const char *skip_lines(const char *text, int count)
{
    while (count-- > 0) text += strcspn(text, "\n") + 1;
    return text;
}

status deck_text(char **out, const card_deck *deck, const char *profile_cards,
                 const char *phase_cards)
{
    status rc = STATUS_OK;
    char *plain = NULL, *text = NULL;

    TRY(card_deck_text(&plain, deck, DECK_END));
    const size_t size = strlen(plain) + strlen(profile_cards) + strlen(phase_cards) + 1;
    text = malloc(size);
    NEED(text, STATUS_MEMORY, "no memory for the text of a card deck");
    const char *profile = skip_lines(plain, LINES_TO_PROFILE);
    const char *phase = *phase_cards ? skip_lines(profile, LINES_TO_PHASE) : profile;
    snprintf(text, size, "%.*s%s%.*s%s%s", (int)(profile - plain), plain, profile_cards,
             (int)(phase - profile), profile, phase_cards, phase);
    *out = text;
out:
    free(plain);
    return rc;
}
