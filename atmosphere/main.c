/* radsig-atmosphere: makes radiance databases and cloud extinctions with LOWTRAN 7. */
#include "lowtran.h"
#include "standard_output.h"
#include "tool.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *purpose;
} commands[] = {
    {"make", tool_make, "make the radiance database of a scene"},
    {"deck", tool_deck, "run card decks as they stand"},
    {"cloud", tool_cloud, "write the extinction of a cloud"},
    {"import", tool_import, "make a database from MODTRAN's own output"},
    {"show", tool_show, "print what a database holds"},
};

enum { COMMAND_COUNT = sizeof commands / sizeof *commands };

static void print_help(FILE *stream)
{
    fputs("usage: radsig-atmosphere COMMAND [ARGUMENT ...]\n\n", stream);
    for (int i = 0; i < COMMAND_COUNT; i++)
        fprintf(stream, "  %-8s %s\n", commands[i].name, commands[i].purpose);
    fputs("\nradsig-atmosphere COMMAND --help tells more; --version prints the version.\n"
          "Exit code: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n",
          stream);
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        print_help(stderr);
        return TOOL_USAGE;
    }
    if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h")) {
        print_help(stdout);
        return 0;
    }
    if (!strcmp(argv[1], "--version")) {
        puts("radsig-atmosphere " RADSIG_VERSION);
        return 0;
    }
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (!strcmp(argv[1], commands[i].name)) return commands[i].run(argc - 1, argv + 1);
    fprintf(stderr, "radsig-atmosphere: there is no command '%s' (radsig-atmosphere --help)\n",
            argv[1]);
    return TOOL_USAGE;
}

int main(int argc, char **argv)
{
    const struct sigaction interrupt = {.sa_handler = lowtran_interrupt};

    sigaction(SIGINT, &interrupt, NULL);
    sigaction(SIGTERM, &interrupt, NULL);
    if (signal(SIGHUP, SIG_IGN) != SIG_IGN) sigaction(SIGHUP, &interrupt, NULL); /* but for nohup */
    standard_output_open();
    const int code = run(argc, argv);
    const int end = tool_end(argc > 1 ? argv[1] : "", standard_output_close());
    return code ? code : end;
}
