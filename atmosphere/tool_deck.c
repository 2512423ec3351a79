#include "deck_file.h"
#include "run_table.h"
#include "tool.h"

#include <stdio.h>
#include <stdlib.h>

static const char help[] = "usage: radsig-atmosphere deck FILE.cdk [FILE.cdk ...] -o FILE.rad\n"
                           "\n"
                           "Runs card decks of LOWTRAN 7 as they stand and writes a text radiance "
                           "database as far as they\n"
                           "fill it. A deck of several runs (IRPT 1, 3, 4) runs as a whole. Runs "
                           "of other wavenumbers than\n"
                           "the first go to files of their own, FILE_2.rad and so on. A deck for "
                           "MODTRAN is taken too: its\n"
                           "leading letter and its resolution are dropped.\n";

static status run(char **files, size_t count, const char *output)
{
    status rc = STATUS_OK;
    run_table *table = NULL;
    deck_runs runs = {0};

    for (size_t i = 0; i < count; i++) TRY(deck_file_read(&runs, files[i]));
    TRY(tool_check_output(output));
    TRY(run_table_open(&table));
    TRY(lowtran_run_decks((const char *const *)runs.texts, (const char *const *)runs.names,
                          runs.count, run_table_add, table));
    TRY(run_table_write(table, (const char *const *)runs.texts, output));
out:
    run_table_free(table);
    deck_file_free(&runs);
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
