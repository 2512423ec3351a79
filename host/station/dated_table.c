#include "station/dated_table.h"

#include "base/number.h"
#include "station/date_text.h"
#include "station/dated_head.h"
#include "station/nearest_place.h"
#include "station/weather_year.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct table {
    const site *place;
    dated_head head;
    weather_series series;
    size_t room;
    record_file *file;
    csv_row row;
    column_gaps gaps;
    weather_year year;
    nearest_place nearest;
} table;

status dated_table_is(bool *out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    dated_head head = {0};

    TRY(record_file_open(&file, path));
    TRY(dated_head_read(&head, file));
    *out = head.kind != DATED_NONE;
out:
    record_file_free(file);
    return rc;
}

/* Sets a row's date by the clock of the file. */
static status take_date(table *t, weather_date *d)
{
    status rc = STATUS_OK;
    const dated_fields *f = &t->head.fields;
    const bool has_both = f->date >= 0 && f->time >= 0;
    double offset_h;

    if (f->year >= 0)
        return weather_date_take(
            d, &t->row, (const int[]){f->year, f->month, f->day, f->hour, f->minute}, t->file);
    const char *text = csv_row_field(&t->row, (size_t)(has_both ? f->date : f->stamp));
    if (!date_text_read(text, d, &offset_h) ||
        (has_both && !date_text_add_time(csv_row_field(&t->row, (size_t)f->time), d)))
        TRY(record_file_reject(
            t->file, "a date and a time such as 2019-01-31T12:30-07:00, not '%.40s'", text));
    if (!isnan(offset_h)) d->hour -= offset_h - t->year.utc_offset_h;
out:
    return rc;
}

/* Whether the row is of the place that is nearest to the site. */
static status take_place(table *t, bool *out_is_kept)
{
    status rc = STATUS_OK;
    const dated_fields *f = &t->head.fields;
    double where[2];

    *out_is_kept = true;
    if (f->latitude < 0 || f->longitude < 0) return STATUS_OK;
    if (!number_read(csv_row_field(&t->row, (size_t)f->latitude), &where[0]) ||
        !number_read(csv_row_field(&t->row, (size_t)f->longitude), &where[1]) ||
        fabs(where[0]) > 90.0 || fabs(where[1]) > 360.0)
        TRY(record_file_reject(t->file, "a latitude and a longitude"));
    *out_is_kept = nearest_place_take(&t->nearest, &t->series, where[0], where[1]);
out:
    return rc;
}

/* Pressure without a unit: hPa and Pa share no value that air has. */
static void settle_pressure(table *t)
{
    column_place *p = &t->head.place[WEATHER_SERIES_PRESSURE_PA];
    double number;

    if (!t->head.is_pressure_open || !number_read(csv_row_field(&t->row, p->field), &number))
        return;
    if (number > 2000.0) p->unit = unit_find("Pa", NULL);
    t->head.is_pressure_open = false;
}

static void derive(double v[DATED_COLUMNS])
{
    if (isnan(v[WEATHER_SERIES_WIND_M_S]))
        v[WEATHER_SERIES_WIND_M_S] = hypot(v[DATED_EAST], v[DATED_NORTH]);
    if (isnan(v[WEATHER_SERIES_DIFFUSE_W_M2]) && !isnan(v[DATED_BEAM_LEVEL]))
        v[WEATHER_SERIES_DIFFUSE_W_M2] =
            fmax(0.0, v[WEATHER_SERIES_GLOBAL_W_M2] - v[DATED_BEAM_LEVEL]);
    if (v[DATED_RAIN_HOURS] > 1.0) v[WEATHER_SERIES_RAIN_M_S] /= v[DATED_RAIN_HOURS];
}

static status read_values(table *t, weather_sample *out)
{
    status rc = STATUS_OK;
    double value[DATED_COLUMNS];

    settle_pressure(t);
    for (int c = 0; c < DATED_COLUMNS; c++)
        TRY(column_read(&value[c], &t->head.place[c],
                        csv_row_field(&t->row, t->head.place[c].field), t->file, &t->gaps));
    derive(value);
    memcpy(out->value, value, sizeof out->value);
out:
    return rc;
}

/* Text may stand behind PVGIS' rows. */
static bool is_behind_rows(const table *t)
{
    weather_date d;
    double offset_h;

    return t->head.kind == DATED_PVGIS && !date_text_read(csv_row_field(&t->row, 0), &d, &offset_h);
}

static status read_rows(table *t)
{
    status rc = STATUS_OK;
    weather_sample sample = {0};
    weather_date date;
    bool is_kept;

    while (!record_file_at_end(t->file)) {
        TRY(csv_row_take(&t->row, t->file, t->head.separator, "a row of weather"));
        if (is_behind_rows(t)) break;
        if (t->row.count == 0) continue;
        TRY(csv_row_check(&t->row, t->head.names, t->file));
        TRY(take_date(t, &date));
        TRY(take_place(t, &is_kept));
        if (!is_kept) continue;
        TRY(read_values(t, &sample));
        sample.year = date.year;
        if (weather_year_take(&t->year, &date, &sample.end_s))
            TRY(weather_series_add(&t->series, &t->room, &sample));
    }
out:
    return rc;
}

/* Whose clock the rows have. */
static double find_offset_h(const table *t)
{
    const dated_fields *f = &t->head.fields;
    const char *next = record_file_peek(t->file);
    const double local_h = t->place->utc_offset_min / 60.0;

    if (!isnan(t->head.utc_offset_h)) return t->head.utc_offset_h;
    if (t->head.kind == DATED_ERA5 || t->head.kind == DATED_PVGIS) return 0.0;
    if (f->stamp >= 0 && f->year < 0 && next) {
        csv_row row = {0};
        char line[4096];
        weather_date date;
        double offset_h = NAN;
        snprintf(line, sizeof line, "%.*s", (int)strcspn(next, "\n"), next);
        if (csv_row_split(&row, line, t->head.separator) == STATUS_OK)
            date_text_read(csv_row_field(&row, (size_t)f->stamp), &date, &offset_h);
        csv_row_free(&row);
        if (!isnan(offset_h)) return offset_h;
    }
    status_warn(
        "%s: its times state no offset from UTC: they are taken to be the scene's, UTC%+.4g",
        t->series.path, local_h);
    return local_h;
}

/* The shortest step, and times at the end of what they stand for. */
static status set_spans(table *t)
{
    status rc = STATUS_OK;
    weather_series *s = &t->series;
    double span_s = INFINITY;

    for (size_t i = 1; i < s->count; i++) {
        const double step_s = s->sample[i].end_s - s->sample[i - 1].end_s;
        if (step_s > 1.0) span_s = fmin(span_s, step_s);
    }
    NEED(isfinite(span_s), STATUS_FORMAT, "%s: has no weather of the scene's date", s->path);
    NEED(span_s <= 3.0 * 3600.0, STATUS_FORMAT, "%s: rows are %g h apart, expected 3 h at most",
         s->path, span_s / 3600.0);
    s->span_s = span_s;
    if (t->head.kind == DATED_TMY3 || t->head.kind == DATED_ERA5) goto out;
    s->air_before_s = 0.5 * span_s + 3600.0 * t->head.light_after_h;
    for (size_t i = 0; i < s->count; i++) s->sample[i].end_s += s->air_before_s;
out:
    return rc;
}

static void open_series(table *t)
{
    const dated_head *h = &t->head;
    const bool has_place = !isnan(h->latitude_deg) && !isnan(h->longitude_deg);
    const double offset_h = find_offset_h(t);

    snprintf(t->series.name, sizeof t->series.name, "%s", *h->name ? h->name : "a point");
    t->series.latitude_deg = has_place ? h->latitude_deg : t->place->latitude_deg;
    t->series.longitude_deg = has_place ? h->longitude_deg : t->place->longitude_deg;
    t->series.elevation_m = h->elevation_m;
    t->series.utc_offset_h = offset_h == 0.0 ? (double)NAN : offset_h;
    t->year = weather_year_around(t->place, offset_h);
    if (!has_place && h->fields.latitude < 0)
        status_warn("%s: names no place: it is taken to be the scene's", t->series.path);
}

status dated_table_read(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    table t = {.place = place, .series = {.path = path}, .nearest = nearest_place_of(place)};

    TRY(record_file_open(&t.file, path));
    TRY(dated_head_read(&t.head, t.file));
    open_series(&t);
    TRY(read_rows(&t));
    column_gaps_tell(&t.gaps, path);
    TRY(weather_year_fit(&t.year, &t.series, &t.room));
    TRY(set_spans(&t));
    nearest_place_tell(&t.nearest, &t.series);
    TRY(weather_series_history(out, &t.series, place));
out:
    weather_series_free(&t.series);
    csv_row_free(&t.row);
    record_file_free(t.file);
    return rc;
}
