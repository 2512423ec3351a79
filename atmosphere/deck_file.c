#include "deck_file.h"

#include "deck_cards.h"
#include "sky/card_deck.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file, read twice side by side: as lines, and as cards. */
typedef struct reader {
    const char *path;
    record_file *lines, *cards;
    deck_cards run;
    card_deck deck;
    char *kept; /* the runs of which the next may keep something */
    int number; /* of the run, from 1 */
} reader;

static status skip_lines(record_file *file, size_t count)
{
    status rc = STATUS_OK;
    const char *text;

    for (size_t i = 0; i < count; i++) TRY(record_file_text(file, &text, "a card"));
out:
    return rc;
}

/* Without card 5, which the manual's columns put last. */
static status plain_text(char **out, const reader *r, int after)
{
    status rc = STATUS_OK;
    card_deck deck = r->deck;

    deck.modtran = false;
    TRY(card_deck_text(out, &deck, after));
    char *end = strrchr(*out, '\n');
    *end = '\0';
    strrchr(*out, '\n')[1] = '\0';
out:
    return rc;
}

/* Takes one run, all its cards but card 5. */
static status take_run(char **out, reader *r)
{
    status rc = STATUS_OK, counted;
    char *text = NULL;
    size_t length;
    const int after = r->run.irpt;
    FILE *stream = open_memstream(&text, &length);

    NEED(stream, STATUS_MEMORY, "%s: no memory to read it", r->path);
    counted = deck_cards_take(&r->run, r->lines, stream);
    fclose(stream);
    /* It tells best what is wrong with a plain card. */
    if (r->run.plain) TRY(card_deck_read_next(&r->deck, r->cards));
    TRY(counted);
    if (r->run.plain) {
        free(text);
        text = NULL;
        TRY(plain_text(&text, r, after));
    } else {
        TRY(skip_lines(r->cards, r->run.count));
    }
    *out = text;
    text = NULL;
out:
    free(text);
    return rc;
}

/* Two texts and the number of a card 5. */
static char *join(const char *before, const char *text, int irpt)
{
    const size_t size = strlen(before) + strlen(text) + 16;
    char *out = malloc(size);

    if (out) snprintf(out, size, "%s%s%5d\n", before, text, irpt);
    return out;
}

static status append(deck_runs *runs, const reader *r, const char *text)
{
    status rc = STATUS_OK;
    const bool only = r->number == 1 && r->run.irpt == DECK_END;
    const size_t size = strlen(r->path) + 32;
    char *name = malloc(size), *deck = join(r->kept, text, DECK_END);
    char **texts = realloc(runs->texts, (runs->count + 1) * sizeof *texts);

    if (texts) runs->texts = texts;
    char **names = realloc(runs->names, (runs->count + 1) * sizeof *names);
    if (names) runs->names = names;
    NEED(name && deck && texts && names, STATUS_MEMORY, "%s: no memory to read it", r->path);
    snprintf(name, size, only ? "%s" : "%s, run %d", r->path, r->number);
    texts[runs->count] = deck;
    names[runs->count++] = name;
    name = deck = NULL;
out:
    free(name);
    free(deck);
    return rc;
}

static status take_next(deck_runs *runs, reader *r)
{
    status rc = STATUS_OK;
    char *text = NULL;

    r->number++;
    TRY(take_run(&text, r));
    if (r->run.whole) *r->kept = '\0';
    TRY(append(runs, r, text));
    char *kept = join(r->kept, text, r->run.irpt);
    NEED(kept, STATUS_MEMORY, "%s: no memory to read it", r->path);
    free(r->kept);
    r->kept = kept;
out:
    free(text);
    return rc;
}

status deck_file_read(deck_runs *runs, const char *path)
{
    status rc = STATUS_OK;
    reader r = {.path = path, .kept = strdup("")};

    NEED(r.kept, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(record_file_open(&r.lines, path));
    TRY(record_file_open(&r.cards, path));
    do {
        TRY(take_next(runs, &r));
    } while (r.run.irpt != DECK_END);
    TRY(record_file_finish(r.lines));
out:
    record_file_free(r.cards);
    record_file_free(r.lines);
    free(r.kept);
    return rc;
}

void deck_file_free(deck_runs *runs)
{
    for (size_t i = 0; i < runs->count; i++) {
        free(runs->texts[i]);
        free(runs->names[i]);
    }
    free(runs->texts);
    free(runs->names);
    *runs = (deck_runs){0};
}
