#include "deck_file.h"
#include "run_table.h"
#include "tool.h"

#include <stdio.h>
#include <stdlib.h>

static const char help[] = "usage: radsig-atmosphere deck FILE.cdk [FILE.cdk ...] -o FILE.rad\n"
                           "\n"
                           "Runs card decks of LOWTRAN 7 as they stand and writes a text radiance "
                           "database as far as they\n"
                           "fill it. A deck for MODTRAN is taken too: its leading letter and its "
                           "resolution are dropped.\n";

static status run(char **files, size_t count, const char *output)
{
    status rc = STATUS_OK;
    run_table *table = NULL;
    char **decks = calloc(count, sizeof *decks);

    NEED(decks, STATUS_MEMORY, "%zu decks", count);
    for (size_t i = 0; i < count; i++) TRY(deck_file_read(&decks[i], files[i]));
    TRY(run_table_open(&table));
    TRY(lowtran_run_decks((const char *const *)decks, (const char *const *)files, count,
                          run_table_add, table));
    TRY(run_table_write(table, (const char *const *)decks, count, output));
out:
    run_table_free(table);
    for (size_t i = 0; decks && i < count; i++) free(decks[i]);
    free(decks);
    return rc;
}

int tool_deck(int argc, char **argv)
{
    tool_options options;
    const int misuse = tool_read(argc, argv, 0, &options);

    if (misuse == TOOL_HELP) fputs(help, stdout);
    if (misuse) return misuse == TOOL_HELP ? 0 : misuse;
    if (options.count < 1) return tool_misuse("deck", "needs a .cdk file");
    if (!options.output) return tool_misuse("deck", "needs -o FILE.rad");
    return tool_end("deck", run(argv + options.first, (size_t)options.count, options.output));
}
