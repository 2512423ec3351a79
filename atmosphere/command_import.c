#include "command.h"
#include "database_output.h"
#include "import.h"

static const char command[] = "radsig-atmosphere import";

static const char purpose[] = "Makes a radiance database from MODTRAN's own output (tape7, .tp7, "
                              ".7sc). The manifest names the\n"
                              "files and tells their geometry: docs/atmosphere.md. A FILE that "
                              "ends in .radc is written as the\n"
                              "compact container.\n";

static status run(const char *path, const char *output)
{
    status rc = STATUS_OK;
    atmosphere *air = NULL;

    TRY(import_read(&air, path));
    TRY(database_output_write(air, output));
out:
    atmosphere_free(air);
    return rc;
}

int command_import(int argc, char **argv)
{
    const char *output = NULL;
    option list[] = {database_output_option(&output, "FILE.rad")};
    const option_table table = {command, "MANIFEST.toml",           1, 1, purpose,
                                list,    sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);

    return code == OPTION_TABLE_DONE ? program_end(command, run(argv[1], output)) : code;
}
