#include "import.h"
#include "tool.h"

#include <stdio.h>

static const char help[] = "usage: radsig-atmosphere import MANIFEST.toml -o FILE.rad\n"
                           "\n"
                           "Makes a radiance database from MODTRAN's own output (tape7, .tp7, "
                           ".7sc). The manifest names the\n"
                           "files and tells their geometry: docs/atmosphere.md. A FILE that ends "
                           "in .radc is written as the\n"
                           "compact container.\n";

static status run(const char *path, const char *output)
{
    status rc = STATUS_OK;
    atmosphere *air = NULL;

    TRY(import_read(&air, path));
    TRY(tool_write_database(air, output));
out:
    atmosphere_free(air);
    return rc;
}

int tool_import(int argc, char **argv)
{
    tool_options options;
    const int misuse = tool_read(argc, argv, 0, &options);

    if (misuse == TOOL_HELP) fputs(help, stdout);
    if (misuse) return misuse == TOOL_HELP ? 0 : misuse;
    if (options.count != 1) return tool_misuse("import", "needs one manifest");
    if (!options.output) return tool_misuse("import", "needs -o FILE.rad");
    return tool_end("import", run(argv[options.first], options.output));
}
