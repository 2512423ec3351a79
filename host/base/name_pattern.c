#include "base/name_pattern.h"

#include "base/utf8_text.h"

#include <string.h>

/* Takes a character; what is not UTF-8 byte by byte. Returns what follows. */
static const char *take(const char *text, uint32_t *out)
{
    const size_t length = utf8_text_character(text, out);

    if (length) return text + length;
    *out = (unsigned char)*text;
    return text + 1;
}

/* Whether a character is in a set that begins behind `[`. Returns what follows its `]`, NULL where nothing
 * closes it. */
static const char *look_in_set(const char *set, uint32_t c, bool *out)
{
    const bool is_inverse = *set == '!' || *set == '^';
    bool is_in = false, is_first = true;

    for (set += is_inverse; *set && (*set != ']' || is_first); is_first = false) {
        uint32_t low, high;
        if (*set == '\\' && set[1]) set++;
        set = take(set, &low);
        high = low;
        if (*set == '-' && set[1] && set[1] != ']') set = take(set + 1, &high);
        is_in = is_in || (c >= low && c <= high);
    }
    *out = is_in != is_inverse;
    return *set ? set + 1 : NULL;
}

/* What follows the pattern's next element if the character fits it, else NULL. */
static const char *fit_one(const char *pattern, uint32_t c)
{
    uint32_t wanted;
    bool is_in;

    if (*pattern == '?') return pattern + 1;
    if (*pattern == '[') {
        const char *behind = look_in_set(pattern + 1, c, &is_in);
        if (behind) return is_in ? behind : NULL;
    }
    if (*pattern == '\\' && pattern[1]) pattern++;
    if (!*pattern) return NULL;
    const char *behind = take(pattern, &wanted);
    return wanted == c ? behind : NULL;
}

bool name_pattern_fits(const char *pattern, const char *name)
{
    const char *star = NULL,
               *held = NULL; /* behind the last star, and from where it holds no more */
    uint32_t c;

    while (*name) {
        if (*pattern == '*') {
            star = ++pattern;
            held = name;
            continue;
        }
        const char *behind = take(name, &c), *next = fit_one(pattern, c);
        if (next) {
            pattern = next;
            name = behind;
        } else if (star) {
            pattern = star;
            name = held = take(held, &c);
        } else {
            return false;
        }
    }
    return pattern[strspn(pattern, "*")] == '\0';
}
