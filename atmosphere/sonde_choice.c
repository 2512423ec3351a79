#include "sonde_layout.h"

#include "base/array.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define NEAR_S (6 * 3600.0)
#define EARTH_KM 6371.0
#define FAR_H 12.0
#define FAR_KM 500.0

enum { LISTED = 8, LIST_SIZE = 1024 };

status sonde_parts_add(sonde_parts *parts, int line)
{
    status rc = STATUS_OK;

    NEED(array_add(&parts->part, parts->count, sizeof *parts->part), STATUS_MEMORY,
         "no memory for the soundings of a file");
    parts->part[parts->count++] = (sonde_part){"", (double)NAN, (double)NAN, (double)NAN, line, 0};
out:
    return rc;
}

double sonde_time_s(int year, int month, int day, int hour, int minute)
{
    char iso[80];
    double time_s;
    int offset_min;

    snprintf(iso, sizeof iso, "%04d-%02d-%02dT%02d:%02d:00Z", year, month, day, hour, minute);
    return site_parse_time(iso, &time_s, &offset_min) == STATUS_OK ? time_s : (double)NAN;
}

/* Station and hour of a sounding, for messages. */
static void describe(char *out, size_t size, const sonde_part *p)
{
    char time[SITE_TIME_SIZE] = "no time";

    if (!isnan(p->time_s)) site_format_time(p->time_s, 0, time);
    snprintf(out, size, "%s%s%s (line %d)", p->station, *p->station ? " " : "", time, p->line);
}

static void describe_all(char out[LIST_SIZE], const sonde_parts *parts)
{
    char one[SONDE_NAME_SIZE + 80];
    size_t used = 0;

    for (size_t i = 0; i < parts->count && i < LISTED; i++) {
        describe(one, sizeof one, &parts->part[i]);
        used += (size_t)snprintf(out + used, LIST_SIZE - used, "%s%s", i ? ", " : "", one);
    }
    if (parts->count > LISTED) snprintf(out + used, LIST_SIZE - used, " ...");
}

/* Kilometres from the scene to a sounding's station. */
static double distance_km(const sonde_part *p, const site *where)
{
    const double degree = M_PI / 180.0;
    const double a = p->latitude_deg * degree, b = where->latitude_deg * degree;
    const double across = cos((p->longitude_deg - where->longitude_deg) * degree);

    return EARTH_KM * acos(fmin(1.0, sin(a) * sin(b) + cos(a) * cos(b) * across));
}

static bool is_one_station(const sonde_parts *parts)
{
    for (size_t i = 1; i < parts->count; i++)
        if (strcmp(parts->part[i].station, parts->part[0].station) != 0) return false;
    return true;
}

/* The sounding of the nearest station whose hour is nearest. NULL where stations or hours do not tell. */
static const sonde_part *nearest(const sonde_parts *parts, const site *where)
{
    const bool is_one = is_one_station(parts);
    const sonde_part *best = NULL;
    double best_km = 0.0, best_s = 0.0;

    for (size_t i = 0; where && i < parts->count; i++) {
        const sonde_part *p = &parts->part[i];
        const double km = is_one ? 0.0 : distance_km(p, where);
        const double away_s = fabs(p->time_s - where->time_s);
        if (isnan(p->time_s) || (!is_one && isnan(p->latitude_deg + p->longitude_deg))) return NULL;
        if (away_s > NEAR_S || (best && (km > best_km || (km == best_km && away_s >= best_s))))
            continue;
        best = p;
        best_km = km;
        best_s = away_s;
    }
    return best;
}

static bool is_alone(const sonde_parts *parts, const sonde_part *best)
{
    for (size_t i = 0; i < parts->count; i++)
        if (&parts->part[i] != best && parts->part[i].time_s == best->time_s &&
            !strcmp(parts->part[i].station, best->station))
            return false;
    return true;
}

/* Warns of a sounding of another day or another country. */
static void warn_if_far(const sonde_part *p, const site *where, const char *path)
{
    char one[SONDE_NAME_SIZE + 80];
    const double away_h = fabs(p->time_s - where->time_s) / 3600.0;
    const bool has_place = !isnan(p->latitude_deg + p->longitude_deg);

    describe(one, sizeof one, p);
    if (away_h > FAR_H) status_warn("%s: %s is %.0f h from the scene's time", path, one, away_h);
    if (has_place && distance_km(p, where) > FAR_KM)
        status_warn("%s: %s is %.0f km from the scene's place", path, one, distance_km(p, where));
}

status sonde_choose(const sonde_part **out, const sonde_parts *parts, const site *where,
                    const char *path)
{
    status rc = STATUS_OK;
    char list[LIST_SIZE] = "", one[SONDE_NAME_SIZE + 80];
    const sonde_part *best = parts->count == 1 ? parts->part : nearest(parts, where);

    describe_all(list, parts);
    NEED(best && is_alone(parts, best), STATUS_FORMAT,
         "%s: holds %zu soundings, expected one, or one within 6 h of the scene's time: %s", path,
         parts->count, list);
    if (parts->count > 1) {
        describe(one, sizeof one, best);
        status_warn("%s: of %zu soundings %s is taken, the nearest", path, parts->count, one);
    }
    if (where) warn_if_far(best, where, path);
    *out = best;
out:
    return rc;
}
