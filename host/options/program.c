#include "options/program.h"

#include "base/interrupt.h"
#include "base/spelling.h"
#include "options/standard_output.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#ifndef RADSIG_VERSION
#error "the Makefile defines RADSIG_VERSION"
#endif

static void print_help(const program *p, FILE *stream)
{
    fprintf(stream, "usage: %s COMMAND [ARGUMENT ...]\n\n", p->name);
    for (size_t i = 0; i < p->count; i++)
        fprintf(stream, "  %-13s %s\n", p->command[i].name, p->command[i].purpose);
    fprintf(stream,
            "\n%s help COMMAND tells more; %s --version prints the version.\n"
            "Exit code: 0 done, 1 failed, 2 wrong usage, 130 interrupted.\n",
            p->name, p->name);
}

static const program_command *find(const program *p, const char *name)
{
    for (size_t i = 0; i < p->count; i++)
        if (!strcmp(name, p->command[i].name)) return &p->command[i];
    return NULL;
}

static int refuse(const program *p, const char *name)
{
    spelling near = spelling_of(name);
    char hint[SPELLING_HINT_SIZE];

    for (size_t i = 0; i < p->count; i++) spelling_offer(&near, p->command[i].name);
    spelling_offer(&near, "help");
    return program_misuse(p->name, "unknown command '%s'%s", name, spelling_hint(&near, "", hint));
}

/* Answers what is asked of the program itself. */
static int answer(const program *p, int argc, char **argv)
{
    char help[] = "--help";
    const bool is_about_command = !strcmp(argv[1], "help") && argc == 3;

    if (is_about_command) {
        const program_command *c = find(p, argv[2]);
        char *arguments[] = {argv[2], help, NULL};
        return c ? c->run(2, arguments) : refuse(p, argv[2]);
    }
    if (argc > 2)
        return program_misuse(p->name, "%s takes no argument, found '%s'", argv[1], argv[argc - 1]);
    if (!strcmp(argv[1], "--version"))
        printf("%s " RADSIG_VERSION "\n", p->name);
    else
        print_help(p, stdout);
    return 0;
}

static int run(const program *p, int argc, char **argv)
{
    static const char *const own[] = {"--help", "-h", "help", "--version"};

    if (argc < 2) {
        print_help(p, stderr);
        return EXIT_USAGE;
    }
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (!strcmp(argv[1], own[i])) return answer(p, argc, argv);
    const program_command *c = find(p, argv[1]);
    return c ? c->run(argc - 1, argv + 1) : refuse(p, argv[1]);
}

/* Prints each line of a text behind the command and a label. */
static void print_lines(const char *command, const char *label, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (length) fprintf(stderr, "%s: %s%.*s\n", command, label, (int)length, text);
        text += length + (text[length] == '\n');
    }
}

void program_warn(const char *command)
{
    print_lines(command, "warning: ", status_warnings());
}

int program_end(const char *command, status rc)
{
    program_warn(command);
    rc = interrupt_status(rc);
    if (rc == STATUS_OK) return 0;
    print_lines(command, "", status_message());
    return rc == STATUS_INTERRUPTED ? EXIT_INTERRUPTED : 1;
}

int program_close(const char *command, int code)
{
    const int lost = program_end(command, standard_output_close());

    return code ? code : lost;
}

int program_run(const program *p, int argc, char **argv)
{
    standard_output_open();
    return program_close(p->name, run(p, argc, argv));
}

int program_misuse(const char *command, const char *format, ...)
{
    va_list arguments;

    fprintf(stderr, "%s: ", command);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fprintf(stderr, "; %s --help tells more\n", command);
    return EXIT_USAGE;
}
