#include "cloud.h"
#include "tool.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] = "usage: radsig-atmosphere cloud NAME -o FILE.ext\n"
                           "\n"
                           "Writes the extinction of one of LOWTRAN 7's clouds, and beside it "
                           "FILE.scattering.csv with its\n"
                           "single-scattering albedo and asymmetry. NAME: cumulus, altostratus, "
                           "stratus, stratocumulus or\n"
                           "nimbostratus.\n";

static status run(const cloud_model *model, const char *output)
{
    status rc = STATUS_OK;
    cloud *c = NULL;
    char path[4096];
    const char *dot = strrchr(output, '.');
    const int stem = dot && !strchr(dot, '/') ? (int)(dot - output) : (int)strlen(output);

    snprintf(path, sizeof path, "%.*s.scattering.csv", stem, output);
    TRY(tool_check_output(output));
    TRY(cloud_compute(&c, model));
    TRY(cloud_write_extinction(c, model, output));
    TRY(cloud_write_scattering(c, model, path));
out:
    cloud_free(c);
    return rc;
}

int tool_cloud(int argc, char **argv)
{
    tool_options options;
    const int misuse = tool_read(argc, argv, 0, &options);
    const cloud_model *model = NULL;

    if (misuse == TOOL_HELP) fputs(help, stdout);
    if (misuse) return misuse == TOOL_HELP ? 0 : misuse;
    if (options.count != 1) return tool_misuse("cloud", "needs the name of one cloud");
    if (!options.output) return tool_misuse("cloud", "needs -o FILE.ext");
    for (int i = 0; i < CLOUD_COUNT; i++)
        if (!strcmp(argv[options.first], cloud_models[i].name)) model = &cloud_models[i];
    if (!model) return tool_misuse("cloud", "there is no cloud '%s'", argv[options.first]);
    return tool_end("cloud", run(model, options.output));
}
