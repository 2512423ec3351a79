/* Program: a command line of several commands: finds the one that is named, prints help, warnings
 * and failures. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include "base/status.h"

#include <stddef.h>

enum { EXIT_USAGE = 2, EXIT_INTERRUPTED = 130 };

/* What `PROGRAM NAME ...` runs: argv[0] is NAME; returns the exit code. */
typedef struct program_command {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *purpose; /* one line */
} program_command;

typedef struct program {
    const char *name;
    const program_command *command; /* shape (count) */
    size_t count;
} program;

/* Runs the command that argv[1] names, or answers `-h`, `--help`, `help`, `help COMMAND` and
 * `--version`. Returns the exit code: 0 done, 1 failed, 2 wrong usage, 130 interrupted. */
int program_run(const program *p, int argc, char **argv);

/* Prints the warnings so far and, unless rc is STATUS_OK, the failure, each line behind the
 * command's full name, such as `radsig render`; returns the exit code. */
int program_end(const char *command, status rc);

/* Closes the standard output, and tells if anything printed there was lost. Returns the exit code:
 * 1 then, unless `code` is another than 0 already. program_run does it. */
int program_close(const char *command, int code);

/* Prints the warnings so far and forgets them. */
void program_warn(const char *command);

/* Prints `COMMAND: message` and a pointer to its help; returns EXIT_USAGE. */
__attribute__((format(printf, 2, 3))) int program_misuse(const char *command, const char *format,
                                                         ...);

#endif
