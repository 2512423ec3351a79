#include "command/command.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Prints each line of a text behind "radsig COMMAND: " and a label. */
static void print_lines(const char *command, const char *label, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (length) fprintf(stderr, "radsig %s: %s%.*s\n", command, label, (int)length, text);
        text += length + (text[length] == '\n');
    }
}

int command_end(const char *command, status rc)
{
    print_lines(command, "warning: ", status_warnings());
    if (rc == STATUS_OK) return 0;
    print_lines(command, "", status_message());
    return rc == STATUS_INTERRUPTED ? EXIT_INTERRUPTED : 1;
}

int command_misuse(const char *command, const char *format, ...)
{
    va_list arguments;

    fprintf(stderr, "radsig %s: ", command);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fprintf(stderr, " (radsig %s --help)\n", command);
    return EXIT_USAGE;
}
