/* Commands: what `radsig NAME ...` runs. argv[0] is the command's name. Each returns the exit code:
 * 0 done, 1 failed, 2 wrong usage, 130 interrupted. Only these files print. */
#ifndef COMMAND_H
#define COMMAND_H

#include "status.h"

int command_render(int argc, char **argv);
int command_check(int argc, char **argv);
int command_trace(int argc, char **argv);
int command_shape_factor(int argc, char **argv);
int command_thermal(int argc, char **argv);
int command_sun(int argc, char **argv);
int command_view(int argc, char **argv);
int command_weather(int argc, char **argv);
int command_validate(int argc, char **argv);
int command_devices(int argc, char **argv);

enum { EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

/* Prints what was warned about and, unless rc is STATUS_OK, the failure; returns the exit code. */
int command_end(const char *command, status rc);

/* Prints `radsig COMMAND: message` and a pointer to --help; returns EXIT_USAGE. */
__attribute__((format(printf, 2, 3))) int command_misuse(const char *command, const char *format,
                                                         ...);

#endif
