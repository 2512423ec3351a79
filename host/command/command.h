/* Commands: what `radsig NAME ...` runs. argv[0] is the command's name. Each returns the exit code:
 * 0 done, 1 failed, 2 wrong usage, 130 interrupted. Only these files print. */
#ifndef COMMAND_H
#define COMMAND_H

#include "options/option_table.h"
#include "options/program.h"

int command_render(int argc, char **argv);
int command_check(int argc, char **argv);
int command_trace(int argc, char **argv);
int command_shape_factor(int argc, char **argv);
int command_thermal(int argc, char **argv);
int command_sun(int argc, char **argv);
int command_view(int argc, char **argv);
int command_weather(int argc, char **argv);
int command_material(int argc, char **argv);
int command_validate(int argc, char **argv);
int command_devices(int argc, char **argv);

#endif
