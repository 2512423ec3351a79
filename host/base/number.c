#include "base/number.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *number_take(const char *text, double *out)
{
    const char *digits = text + (*text == '+' || *text == '-');
    char *end;

    /* strtod alone would take blanks, "nan" and "0x1". */
    if (!isdigit((unsigned char)digits[*digits == '.'])) return NULL;
    if (digits[0] == '0' && tolower((unsigned char)digits[1]) == 'x') return NULL;
    const double value = strtod(text, &end);
    if (!isfinite(value)) return NULL;
    *out = value;
    return end;
}

const char *number_take_whole(const char *text, int64_t low, int64_t high, int64_t *out)
{
    const bool is_negative = *text == '-';
    int64_t value = 0;

    if (*text == '+' || *text == '-') text++;
    if (!isdigit((unsigned char)*text)) return NULL;
    for (; isdigit((unsigned char)*text); text++) {
        if (value > (INT64_MAX - 9) / 10) return NULL;
        value = 10 * value + (*text - '0');
    }
    if (is_negative) value = -value;
    if (value < low || value > high) return NULL;
    *out = value;
    return text;
}

bool number_read(const char *text, double *out)
{
    double value;
    const char *end = number_take(text, &value);

    if (!end || *end) return false;
    *out = value;
    return true;
}

bool number_read_whole(const char *text, int64_t low, int64_t high, int64_t *out)
{
    int64_t value;
    const char *end = number_take_whole(text, low, high, &value);

    if (!end || *end) return false;
    *out = value;
    return true;
}

bool number_read_list(const char *text, size_t count, double *out)
{
    for (size_t i = 0; i < count; i++) {
        text = number_take(text + strspn(text, " \t"), &out[i]);
        if (!text) return false;
        text += strspn(text, " \t");
        if (*text != (i + 1 < count ? ',' : '\0')) return false;
        text++;
    }
    return true;
}

bool number_read_size(const char *text, uint32_t *out_columns, uint32_t *out_rows)
{
    int64_t columns, rows;
    const char *end = number_take_whole(text, 0, INT32_MAX, &columns);

    if (!isdigit((unsigned char)*text) || !end || *end != 'x' || !isdigit((unsigned char)end[1]))
        return false;
    end = number_take_whole(end + 1, 0, INT32_MAX, &rows);
    if (!end || *end || columns * rows > INT32_MAX) return false;
    *out_columns = (uint32_t)columns;
    *out_rows = (uint32_t)rows;
    return true;
}
