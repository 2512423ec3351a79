/* Commands of radsig-atmosphere. argv[0] is the command's name. Each returns the exit code: 0 done, 1 failed, 2
 * wrong usage, 130 interrupted. Only these files print. */
#ifndef COMMAND_H
#define COMMAND_H

#include "options/option_table.h"
#include "options/program.h"

int command_make(int argc, char **argv);
int command_deck(int argc, char **argv);
int command_cloud(int argc, char **argv);
int command_import(int argc, char **argv);
int command_show(int argc, char **argv);

#endif
