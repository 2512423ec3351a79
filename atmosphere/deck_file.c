#include "deck_file.h"

#include "card_deck.h"
#include "record_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Cards 1, 2, 3, 3A1, 3A2, 4 and 5. */
enum { PLAIN_CARDS = 7 };

/* The lines as they stand, with the blanks before them, and their number. */
static status read_lines(char **out, int *out_count, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    FILE *stream = NULL;
    char *text = NULL;
    size_t length;
    const char *line = "";

    TRY(record_file_open(&file, path));
    stream = open_memstream(&text, &length);
    NEED(stream, STATUS_MEMORY, "%s: no memory to read it", path);
    for (*out_count = 0; !record_file_at_end(file); ++*out_count) {
        TRY(record_file_text(file, &line, "a card"));
        fprintf(stream, "%*s%s\n", (int)record_file_column(file), "", line);
    }
    if (*out_count > PLAIN_CARDS && strcmp(line, "0") != 0) {
        rc = record_file_reject(file, "card 5 with IRPT 0 at the end: one run a deck");
        goto out;
    }
    fclose(stream);
    stream = NULL;
    *out = text;
    text = NULL;
out:
    if (stream) fclose(stream);
    free(text);
    record_file_free(file);
    return rc;
}

status deck_file_read(char **out, const char *path)
{
    status rc = STATUS_OK;
    card_deck deck;
    char *lines = NULL;
    int count = 0;

    TRY(read_lines(&lines, &count, path));
    rc = card_deck_read(&deck, path);
    if (rc == STATUS_OK) {
        deck.modtran = false;
        TRY(card_deck_text(out, &deck));
    } else if (rc == STATUS_FORMAT && count > PLAIN_CARDS) {
        rc = STATUS_OK;
        *out = lines;
        lines = NULL;
    }
out:
    free(lines);
    return rc;
}
