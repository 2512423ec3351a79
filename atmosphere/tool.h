/* Tool: the commands of radsig-atmosphere. argv[0] is the command's name. Each returns the exit
 * code: 0 done, 1 failed, 2 wrong usage, 130 interrupted. Only these files print. */
#ifndef TOOL_H
#define TOOL_H

#include "atmosphere.h"

#include <getopt.h>
#include <stdbool.h>
#include <stddef.h>

int tool_make(int argc, char **argv);
int tool_deck(int argc, char **argv);
int tool_cloud(int argc, char **argv);
int tool_import(int argc, char **argv);
int tool_show(int argc, char **argv);

enum { TOOL_USAGE = 2, TOOL_INTERRUPTED = 130, TOOL_HELP = -1 };

/* What stands on a command line beside its arguments. */
typedef struct tool_options {
    const char *output;     /* -o; NULL: not stated */
    const char *keep_decks; /* --keep-decks; NULL: not stated */
    const char *time;       /* --time; NULL: not stated */
    const char *plot;       /* --plot; NULL: not stated */
    int first, count;       /* of the arguments in argv */
} tool_options;

/* Options that a command knows beside --output and --help. */
enum { TOOL_TIME = 1, TOOL_KEEP_DECKS = 2, TOOL_PLOT = 4 };

/* Reads options. Returns 0, TOOL_HELP, or TOOL_USAGE after it has said what is wrong.
 *   known   a sum of the above */
int tool_read(int argc, char **argv, int known, tool_options *out);

/* Before a long run: fails with STATUS_FILE where the output could not be written. */
status tool_check_output(const char *path);

bool tool_is_container(const char *path); /* its name ends in .radc */

/* Writes a container or text, by the name. */
status tool_write_database(const atmosphere *air, const char *path);

/* Prints what was warned about and, unless rc is STATUS_OK, the failure; returns the exit code. */
int tool_end(const char *command, status rc);

/* Prints what is wrong with the usage; returns TOOL_USAGE. */
__attribute__((format(printf, 2, 3))) int tool_misuse(const char *command, const char *format, ...);

#endif
