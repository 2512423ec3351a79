#include "files/json_text.h"

#include "base/utf8_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define WHOLE_LIMIT 9007199254740992.0 /* 2^53: a double holds every whole number up to it */

enum { MOST_DIGITS = 17 };

json_t *json_text(const char *text)
{
    if (!text) return json_null();
    char *readable = utf8_text_copy(text);
    json_t *value = readable ? json_string(readable) : NULL;
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
