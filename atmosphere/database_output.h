/* Database output: the file that a command writes its radiance database to. */
#ifndef DATABASE_OUTPUT_H
#define DATABASE_OUTPUT_H

#include "options/option_table.h"
#include "sky/atmosphere.h"

#include <stdbool.h>

/* -o FILE, required.
 *   value   as the help names it */
option database_output_option(const char **path, const char *value);

/* Before a long run: fails with STATUS_FILE if the output could not be written. */
status database_output_check(const char *path);

bool database_output_is_container(const char *path); /* its name ends in .radc */

/* Writes a container or text, by the name. */
status database_output_write(const atmosphere *air, const char *path);

#endif
