#include "files/heading.h"

#include <ctype.h>
#include <string.h>

static void copy_part(char *out, const char *begin, const char *end)
{
    while (begin < end && isspace((unsigned char)*begin)) begin++;
    while (end > begin && isspace((unsigned char)end[-1])) end--;
    memcpy(out, begin, (size_t)(end - begin));
    out[end - begin] = '\0';
}

bool heading_split(const char *field, size_t size, char *out_name, char *out_unit)
{
    const char *open = strpbrk(field, "[("), *end = field + strlen(field);

    if (strlen(field) >= size) return false;
    *out_unit = '\0';
    if (open) {
        const char *close = strchr(open, *open == '[' ? ']' : ')');
        if (!close) return false;
        copy_part(out_unit, open + 1, close);
        end = open;
    }
    copy_part(out_name, field, end);
    return *out_name != '\0';
}

static bool is_filler(char c)
{
    return c == ' ' || c == '-' || c == '_';
}

/* Whether a name is what stands before the next bar. */
static bool is_same(const char *name, const char *known)
{
    for (;; name++, known++) {
        while (is_filler(*name)) name++;
        while (is_filler(*known)) known++;
        if (*known == '|') return !*name;
        if (tolower((unsigned char)*name) != tolower((unsigned char)*known)) return false;
    }
}

bool heading_is_named(const char *name, const char *names)
{
    for (const char *bar = strchr(names, '|'); bar && bar[1]; bar = strchr(bar + 1, '|'))
        if (is_same(name, bar + 1)) return true;
    return false;
}
