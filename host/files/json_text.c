#include "files/json_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WHOLE_LIMIT 9007199254740992.0 /* 2^53: a double holds every whole number up to it */

enum { MOST_DIGITS = 17 };

/* Latin-1 as UTF-8; the caller frees it. */
static char *from_latin_1(const char *text)
{
    char *out = malloc(2 * strlen(text) + 1), *at = out;

    if (!out) return NULL;
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c >= 0x80) *at++ = (char)(0xc0 | c >> 6);
        *at++ = (char)(c >= 0x80 ? 0x80 | (c & 0x3f) : c);
    }
    *at = '\0';
    return out;
}

json_t *json_text(const char *text)
{
    if (!text) return json_null();
    json_t *value = json_string(text);
    if (value) return value;
    char *readable = from_latin_1(text);
    value = readable ? json_string(readable) : NULL;
    free(readable);
    return value;
}

json_t *json_text_number(double value, size_t *digits)
{
    char text[40];

    if (!isfinite(value)) return json_null();
    if (value == floor(value) && fabs(value) <= WHOLE_LIMIT) return json_integer((json_int_t)value);
    for (; digits && *digits < MOST_DIGITS; ++*digits) {
        snprintf(text, sizeof text, "%.*g", (int)*digits, value);
        if (strtod(text, NULL) == value) break;
    }
    return json_real(value);
}
