#include "base/spelling.h"
#include "cloud.h"
#include "command.h"
#include "database_output.h"

#include <stdio.h>
#include <string.h>

static const char command[] = "radsig-atmosphere cloud";

static const char purpose[] = "Writes the extinction of one of LOWTRAN 7's clouds, and beside it "
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
    TRY(database_output_check(output));
    TRY(cloud_compute(&c, model));
    TRY(cloud_write_extinction(c, model, output));
    TRY(cloud_write_scattering(c, model, path));
out:
    cloud_free(c);
    return rc;
}

static const cloud_model *find_model(const char *wanted, spelling *near)
{
    for (int i = 0; i < CLOUD_COUNT; i++) {
        if (!strcmp(wanted, cloud_models[i].name)) return &cloud_models[i];
        spelling_offer(near, cloud_models[i].name);
    }
    return NULL;
}

int command_cloud(int argc, char **argv)
{
    const char *output = NULL;
    option list[] = {database_output_option(&output, "FILE.ext")};
    const option_table table = {command, "NAME", 1, 1, purpose, list, sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);
    char hint[SPELLING_HINT_SIZE];

    if (code != OPTION_TABLE_DONE) return code;
    spelling near = spelling_of(argv[1]);
    const cloud_model *model = find_model(argv[1], &near);
    if (!model)
        return program_misuse(command, "unknown cloud '%s'%s", argv[1],
                              spelling_hint(&near, "", hint));
    return program_end(command, run(model, output));
}
