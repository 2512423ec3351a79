/* radsig: the command line. */
#include "command.h"
#include "standard_output.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#ifndef RADSIG_VERSION
#error "the Makefile defines RADSIG_VERSION"
#endif

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *purpose;
} commands[] = {
    {"render", command_render, "make the image of a scene and its truth planes"},
    {"check", command_check, "read a scene, report every error, summarise it"},
    {"trace", command_trace, "intersect rays from stdin with meshes"},
    {"shape-factor", command_shape_factor, "share of the sky that a point sees"},
    {"thermal", command_thermal, "take one facet through a weather history"},
    {"sun", command_sun, "position of the sun"},
    {"weather", command_weather, "write the weather of a scene as a .wth"},
    {"validate", command_validate, "compare temperatures with measured ones"},
    {"view", command_view, "start the preview"},
    {"devices", command_devices, "list the OpenCL devices"},
};

enum { COMMAND_COUNT = sizeof commands / sizeof *commands };

static void print_help(FILE *stream)
{
    fputs("usage: radsig COMMAND [ARGUMENT ...]\n\n", stream);
    for (int i = 0; i < COMMAND_COUNT; i++)
        fprintf(stream, "  %-13s %s\n", commands[i].name, commands[i].purpose);
    fputs("\nradsig COMMAND --help tells more; radsig --version prints the version.\n"
          "Exit code: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n",
          stream);
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        print_help(stderr);
        return EXIT_USAGE;
    }
    const bool wants_version = !strcmp(argv[1], "--version");
    if (wants_version || !strcmp(argv[1], "--help") || !strcmp(argv[1], "-h")) {
        if (argc > 2) {
            fprintf(stderr, "radsig: %s stands alone, found '%s' (radsig --help)\n", argv[1],
                    argv[2]);
            return EXIT_USAGE;
        }
        if (wants_version)
            puts("radsig " RADSIG_VERSION);
        else
            print_help(stdout);
        return 0;
    }
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (!strcmp(argv[1], commands[i].name)) return commands[i].run(argc - 1, argv + 1);
    fprintf(stderr, "radsig: there is no command '%s' (radsig --help)\n", argv[1]);
    return EXIT_USAGE;
}

int main(int argc, char **argv)
{
    standard_output_open();
    const int code = run(argc, argv);
    const int end = command_end(argc > 1 ? argv[1] : "", standard_output_close());
    return code ? code : end;
}
