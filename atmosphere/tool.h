/* Tool: the commands of radsig-atmosphere. argv[0] is the command's name. Each returns the exit
 * code: 0 done, 1 failed, 2 wrong usage, 130 interrupted. Only these files print. */
#ifndef TOOL_H
#define TOOL_H

#include "options/option_table.h"
#include "options/program.h"
#include "sky/atmosphere.h"

#include <stdbool.h>

int tool_make(int argc, char **argv);
int tool_deck(int argc, char **argv);
int tool_cloud(int argc, char **argv);
int tool_import(int argc, char **argv);
int tool_show(int argc, char **argv);

/* -o FILE, required.
 *   value   as the help names it */
option tool_output_option(const char **path, const char *value);

/* Before a long run: fails with STATUS_FILE if the output could not be written. */
status tool_check_output(const char *path);

bool tool_is_container(const char *path); /* its name ends in .radc */

/* Writes a container or text, by the name. */
status tool_write_database(const atmosphere *air, const char *path);

#endif
