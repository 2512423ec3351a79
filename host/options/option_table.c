#include "options/option_table.h"

#include "base/number.h"
#include "base/spelling.h"
#include "options/program.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH = 100, HELP_COLUMN = 29, DEMAND_SIZE = 128 };

/* Writes a text that must not be broken behind a blank, or on a new line. */
static void put(const char *text, size_t length, size_t indent, size_t *column)
{
    if (*column > indent && *column + 1 + length > WIDTH) {
        printf("\n%*s", (int)indent, "");
        *column = indent;
    }
    *column += (size_t)printf("%s%.*s", *column > indent ? " " : "", (int)length, text);
}

/* As the usage and messages name a required option: `-o DIR`. */
static const char *write_demand(const option *o, char out[DEMAND_SIZE])
{
    char letter[] = {o->letter, '\0'};

    snprintf(out, DEMAND_SIZE, "%s%s %s", o->letter ? "-" : "--", o->letter ? letter : o->name,
             o->value);
    return out;
}

static void print_usage(const option_table *t)
{
    const size_t indent = (size_t)printf("usage: %s ", t->command);
    size_t column = indent;
    char item[DEMAND_SIZE];

    if (t->operand) put(t->operand, strlen(t->operand), indent, &column);
    for (size_t i = 0; i < t->count; i++) {
        if (!t->list[i].is_required) continue;
        write_demand(&t->list[i], item);
        put(item, strlen(item), indent, &column);
    }
    put("[OPTION ...]", strlen("[OPTION ...]"), indent, &column);
    printf("\n\n%s\n", t->purpose);
}

static void print_option(char letter, const char *name, const char *value, const char *help)
{
    char short_name[] = {'-', letter, ',', '\0'};
    size_t column = (size_t)printf("  %3s --%s%s%s", letter ? short_name : "", name,
                                   value ? " " : "", value ? value : "");

    if (column + 2 > HELP_COLUMN) column = (size_t)printf("\n") - 1;
    printf("%*s", (int)(HELP_COLUMN - column), "");
    column = HELP_COLUMN;
    while (*help) {
        const size_t length = strcspn(help, " ");
        put(help, length, HELP_COLUMN, &column);
        help += length + (help[length] == ' ');
    }
    putchar('\n');
}

static void print_help(const option_table *t)
{
    print_usage(t);
    for (size_t i = 0; i < t->count; i++)
        print_option(t->list[i].letter, t->list[i].name, t->list[i].value, t->list[i].help);
    print_option('h', "help", NULL, "print this");
}

static option *find(const option_table *t, const char *name, size_t length, char letter)
{
    for (size_t i = 0; i < t->count; i++) {
        option *o = &t->list[i];
        if (letter ? o->letter == letter
                   : strlen(o->name) == length && !strncmp(o->name, name, length))
            return o;
    }
    return NULL;
}

static int refuse(const option_table *t, const char *argument, size_t length)
{
    char name[128], hint[SPELLING_HINT_SIZE];

    snprintf(name, sizeof name, "%.*s", (int)length, argument);
    spelling near = spelling_of(name + strspn(name, "-"));
    for (size_t i = 0; i < t->count; i++) spelling_offer(&near, t->list[i].name);
    spelling_offer(&near, "help");
    return program_misuse(t->command, "unknown option '%s'%s", name,
                          spelling_hint(&near, "--", hint));
}

static status read_text(const option *o, const char *text)
{
    status rc = STATUS_OK;

    NEED(*text, STATUS_ARGUMENT, "found '', expected %s", o->value);
    *o->text = text;
out:
    return rc;
}

static status read_number(const option *o, const char *text)
{
    status rc = STATUS_OK;
    double value = 0.0;

    NEED(number_read(text, &value) && value >= o->low && value <= o->high, STATUS_ARGUMENT,
         "found '%s', expected a number from %g to %g", text, o->low, o->high);
    *o->number = value;
out:
    return rc;
}

static status read_whole(const option *o, const char *text)
{
    status rc = STATUS_OK;

    NEED(number_read_whole(text, (int64_t)o->low, (int64_t)o->high, o->whole), STATUS_ARGUMENT,
         "found '%s', expected a whole number from %.0f to %.0f", text, o->low, o->high);
out:
    return rc;
}

static status read_word(const option *o, const char *text)
{
    status rc = STATUS_OK;
    char expected[256] = "";

    for (int i = 0; i < o->word_count; i++) {
        const size_t length = strlen(expected);
        if (!strcmp(text, o->word[i])) {
            *o->index = i;
            goto out;
        }
        snprintf(expected + length, sizeof expected - length, "%s%s",
                 i == 0                  ? ""
                 : i + 1 < o->word_count ? ", "
                                         : " or ",
                 o->word[i]);
    }
    NEED(false, STATUS_ARGUMENT, "found '%s', expected %s", text, expected);
out:
    return rc;
}

static status read_value(const option *o, const char *text)
{
    return o->text     ? read_text(o, text)
           : o->number ? read_number(o, text)
           : o->whole  ? read_whole(o, text)
           : o->index  ? read_word(o, text)
                       : o->read(o, text);
}

/* Takes the option that argv[*at] is, and its value; returns OPTION_TABLE_DONE or an exit code. */
static int take(const option_table *t, int argc, char **argv, int *at)
{
    const char *argument = argv[*at], *name = argument + 2, *value = NULL;
    const bool is_long = argument[1] == '-';
    const size_t length = is_long ? strcspn(name, "=") : 0;
    option *o = find(t, name, length, is_long ? '\0' : argument[1]);

    if (!o || (!o->value && !is_long && *name))
        return refuse(t, argument, is_long ? length + 2 : strlen(argument));
    if (o->is_given && !o->repeats)
        return program_misuse(t->command, "--%s is given twice", o->name);
    o->is_given = true;
    if (is_long && name[length]) value = name + length + 1;
    if (!is_long && *name) value = name;
    if (!o->value) {
        if (value)
            return program_misuse(t->command, "--%s takes no value, found '%s'", o->name, value);
        *o->flag = true;
        return OPTION_TABLE_DONE;
    }
    if (!value && *at + 1 == argc) return program_misuse(t->command, "%s needs a value", argument);
    if (!value) value = argv[++*at];
    if (read_value(o, value) == STATUS_OK) return OPTION_TABLE_DONE;
    return program_misuse(t->command, "--%s: %s", o->name, status_message());
}

static int check(const option_table *t, char **argv, int count)
{
    char demand[DEMAND_SIZE];

    if (count > t->most)
        return program_misuse(t->command, "found '%s', expected %s%s", argv[t->most + 1],
                              t->most ? "one " : "options alone", t->most ? t->operand : "");
    if (count < t->least) return program_misuse(t->command, "needs %s", t->operand);
    for (size_t i = 0; i < t->count; i++)
        if (t->list[i].is_required && !t->list[i].is_given)
            return program_misuse(t->command, "needs %s", write_demand(&t->list[i], demand));
    return OPTION_TABLE_DONE;
}

int option_table_read(const option_table *t, int argc, char **argv, int *out_count)
{
    bool only_operands = false;
    int count = 0;

    for (int i = 1; i < argc; i++) {
        if (only_operands || argv[i][0] != '-' || !argv[i][1]) {
            argv[1 + count++] = argv[i];
        } else if (!strcmp(argv[i], "--")) {
            only_operands = true;
        } else if (!strcmp(argv[i], "-h") || !strcmp(argv[i], "--help")) {
            print_help(t);
            return 0;
        } else {
            const int code = take(t, argc, argv, &i);
            if (code != OPTION_TABLE_DONE) return code;
        }
    }
    if (out_count) *out_count = count;
    return check(t, argv, count);
}

bool option_table_has(const option_table *t, const char *name)
{
    const option *o = find(t, name, strlen(name), '\0');

    return o && o->is_given;
}
