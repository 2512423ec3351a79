/* Option table: what a command takes, told once: the command line is read by it, and the help is
 * printed from it. Every command knows -h and --help. */
#ifndef OPTION_TABLE_H
#define OPTION_TABLE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct option option;

/* Reads the value of an option. Fails with `found 'TEXT', expected ...`. */
typedef status (*option_reader)(const option *o, const char *text);

struct option {
    const char *name;  /* long, without its dashes */
    char letter;       /* short; 0: none */
    const char *value; /* as the help names it, such as WxH; NULL: the option takes none */
    const char *help;
    /* Where the value goes, one of these: */
    bool *flag;        /* true if the option is given */
    const char **text; /* not empty */
    double *number;    /* from low to high */
    int64_t *whole;    /* from low to high */
    int *index;        /* of the word, shape (word_count) */
    void *out;         /* what `read` makes of it */
    option_reader read;
    double low, high;
    const char *const *word;
    int word_count;
    bool is_required;
    bool repeats;  /* may be given several times */
    bool is_given; /* set by option_table_read */
};

typedef struct option_table {
    const char *command; /* in full, such as `radsig render` */
    const char *operand; /* as the help names it, such as SCENE or MESH...; NULL: takes none */
    int least, most;     /* operands */
    const char *purpose; /* what the command does: whole lines */
    option *list;        /* shape (count) */
    size_t count;
} option_table;

enum { OPTION_TABLE_DONE = -1 };

/* Reads a command line: fills what the options point to and moves the operands to argv[1] and on.
 *   out_count   of operands; NULL: not asked for
 * Returns OPTION_TABLE_DONE, or the exit code of the program: 0 after it has printed the help,
 * EXIT_USAGE after it has said what is wrong. Names are written in full. */
int option_table_read(const option_table *t, int argc, char **argv, int *out_count);

/* Whether an option of the table was given. */
bool option_table_has(const option_table *t, const char *name);

#endif
