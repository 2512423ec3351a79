#include "tool.h"

#include "atmosphere_container.h"
#include "output_file.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int tool_read(int argc, char **argv, int known, tool_options *out)
{
    static const struct option options[] = {
        {"output", required_argument, NULL, 'o'}, {"keep-decks", required_argument, NULL, 'k'},
        {"time", required_argument, NULL, 't'},   {"plot", required_argument, NULL, 'p'},
        {"help", no_argument, NULL, 'h'},         {0}};
    int option;

    *out = (tool_options){0};
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":o:h", options, NULL)) != -1) {
        if (option == 'h') return TOOL_HELP;
        if (option == 'o')
            out->output = optarg;
        else if (option == 'k' && (known & TOOL_KEEP_DECKS))
            out->keep_decks = optarg;
        else if (option == 't' && (known & TOOL_TIME))
            out->time = optarg;
        else if (option == 'p' && (known & TOOL_PLOT))
            out->plot = optarg;
        else
            return tool_misuse(argv[0], "'%s' %s", argv[optind - 1],
                               option == ':' ? "needs a value" : "is no option");
    }
    out->first = optind;
    out->count = argc - optind;
    return 0;
}

status tool_check_output(const char *path)
{
    output_file *file = NULL;
    const status rc = output_file_open(&file, path);

    output_file_free(file);
    return rc;
}

bool tool_is_container(const char *path)
{
    const char *dot = strrchr(path, '.');

    return dot && !strcmp(dot, ".radc");
}

status tool_write_database(const atmosphere *air, const char *path)
{
    return tool_is_container(path) ? atmosphere_container_write(air, path)
                                   : atmosphere_write(air, path);
}

static void print_lines(const char *command, const char *label, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (length)
            fprintf(stderr, "radsig-atmosphere %s: %s%.*s\n", command, label, (int)length, text);
        text += length + (text[length] == '\n');
    }
}

int tool_end(const char *command, status rc)
{
    print_lines(command, "warning: ", status_warnings());
    if (rc == STATUS_OK) return 0;
    print_lines(command, "", status_message());
    return rc == STATUS_INTERRUPTED ? TOOL_INTERRUPTED : 1;
}

int tool_misuse(const char *command, const char *format, ...)
{
    va_list arguments;

    fprintf(stderr, "radsig-atmosphere %s: ", command);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fprintf(stderr, " (radsig-atmosphere %s --help)\n", command);
    return TOOL_USAGE;
}
