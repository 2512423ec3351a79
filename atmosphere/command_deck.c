#include "command.h"
#include "database_output.h"
#include "deck_file.h"
#include "run_table.h"

#include <limits.h>

static const char command[] = "radsig-atmosphere deck";

static const char purpose[] =
    "Runs card decks of LOWTRAN 7 as they stand and writes a text radiance database. Decks that\n"
    "do not fill one are refused, unless FILE has another ending than .rad: it then holds what\n"
    "they give, in the same layout. A deck of several runs (IRPT 1, 3, 4) runs as a whole. Runs\n"
    "of other wavenumbers than the first go to files of their own, FILE_2.rad and so on. A deck\n"
    "for MODTRAN is taken too: its leading letter and its resolution are dropped.\n";

static status run(char **files, size_t count, const char *output)
{
    status rc = STATUS_OK;
    run_table *table = NULL;
    deck_runs runs = {0};

    for (size_t i = 0; i < count; i++) TRY(deck_file_read(&runs, files[i]));
    TRY(database_output_check(output));
    TRY(run_table_open(&table));
    TRY(lowtran_run_decks((const char *const *)runs.texts, (const char *const *)runs.names,
                          runs.count, run_table_add, table));
    TRY(run_table_write(table, (const char *const *)runs.texts, output));
out:
    run_table_free(table);
    deck_file_free(&runs);
    return rc;
}

int command_deck(int argc, char **argv)
{
    const char *output = NULL;
    option list[] = {database_output_option(&output, "FILE.rad")};
    const option_table table = {
        command, "FILE.cdk...", 1, INT_MAX, purpose, list, sizeof list / sizeof *list};
    int count = 0;
    const int code = option_table_read(&table, argc, argv, &count);

    if (code != OPTION_TABLE_DONE) return code;
    return program_end(command, run(argv + 1, (size_t)count, output));
}
