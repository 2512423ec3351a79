#include "station/date_text.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>

/* Takes from `least` to `most` digits; NULL where they do not stand there. */
static const char *take(const char *text, int least, int most, int *out)
{
    int n = 0;

    if (!text) return NULL;
    for (*out = 0; n < most && isdigit((unsigned char)text[n]); n++)
        *out = 10 * *out + (text[n] - '0');
    return n < least ? NULL : text + n;
}

static const char *pass(const char *text, const char *any)
{
    if (!text || !*text) return NULL;
    for (; *any; any++)
        if (*any == *text) return text + 1;
    return NULL;
}

static bool is_date(const weather_date *d)
{
    return d->year >= 1800 && d->year <= 2200 && d->month >= 1 && d->month <= 12 && d->day >= 1 &&
           d->day <= weather_month_days(d->month);
}

static const char *take_date(const char *text, weather_date *d)
{
    const char *at = take(pass(take(text, 4, 4, &d->year), "-/"), 1, 2, &d->month);

    at = take(pass(at, "-/"), 1, 2, &d->day);
    if (at) return at;
    at = take(pass(take(text, 1, 2, &d->month), "/"), 1, 2, &d->day);
    at = take(pass(at, "/"), 4, 4, &d->year);
    if (at) return at;
    return take(take(take(text, 4, 4, &d->year), 2, 2, &d->month), 2, 2, &d->day);
}

/* 12:30, 12:30:15, 12:30:15.5 or 1230. */
static const char *take_time(const char *text, weather_date *d)
{
    int hour, minute = 0, second = 0;
    const char *at = take(text, 1, 2, &hour);
    const char *colon = pass(at, ":");

    at = take(colon ? colon : at, 2, 2, &minute);
    if (colon && pass(at, ":")) at = take(at + 1, 2, 2, &second);
    if (at && *at == '.')
        for (at++; isdigit((unsigned char)*at);) at++;
    if (!at || hour > 24 || minute > 59 || second > 60 || (hour == 24 && minute + second > 0))
        return NULL;
    d->hour = hour + minute / 60.0 + second / 3600.0;
    return at;
}

static const char *take_offset(const char *text, double *out_h)
{
    int hours, minutes = 0;
    const double sign = *text == '-' ? -1.0 : 1.0;
    const char *at;

    if (*text == 'Z' || *text == 'z') {
        *out_h = 0.0;
        return text + 1;
    }
    at = take(pass(text, "+-"), 2, 2, &hours);
    if (at && *at) at = take(*at == ':' ? at + 1 : at, 2, 2, &minutes);
    if (at) *out_h = sign * (hours + minutes / 60.0);
    return at;
}

bool date_text_read(const char *text, weather_date *out, double *out_offset_h)
{
    const char *at = take_date(text, out);

    out->hour = 0.0;
    *out_offset_h = NAN;
    if (!at || !is_date(out)) return false;
    if (!*at) return true;
    at = take_time(pass(at, "T :"), out);
    while (at && *at == ' ') at++;
    if (at && *at) at = take_offset(at, out_offset_h);
    return at && !*at;
}

bool date_text_add_time(const char *text, weather_date *out)
{
    const char *at = take_time(text, out);

    return at && !*at;
}
