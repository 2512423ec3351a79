#include "sonde_layout.h"

#include "base/array.h"
#include "weather/weather.h"

#include <math.h>
#include <stdint.h>

#define SUPERSATURATED_K 1.0 /* soundings report some percent more than 100 */
#define NOISE_M 50.0         /* what a balloon that rises may seem to fall */
#define NOISE_HPA 5.0
#define LEAST_HUMIDITY 1e-4
#define DRIEST 0.0101 /* relative humidity that no whole sounding is below */
#define MISFIT 2.0    /* of heights to the hypsometric equation: a factor */
#define FILL 1e5      /* numbers beyond are none */
#define GRAVITY_M_S2 9.80665
#define DRY_AIR_J_KG_K 287.05
#define BRIDGED_M 2000.0 /* a dew point that is missing over so much lies between its neighbours */

/* What a quantity of the air can be. */
static const struct {
    double low, high;
} range[SONDE_QUANTITIES] = {{1e-3, 1100.0}, {-500.0, 60000.0}, {150.0, 350.0},
                             {150.0, 350.0}, {0.0, 1.5},        {-1.0, 98.0}};

static bool is_inside(sonde_quantity q, double value)
{
    return value >= range[q].low && value <= range[q].high;
}

/* 99, 99.9, 99.99, 999 and so on, of either sign; -8888, -32768. */
static bool is_flag(double number)
{
    for (double power = 100.0; power <= FILL; power *= 10.0)
        for (double last = 1.0; last > .005; last *= .1)
            if (fabs(fabs(number) - (power - last)) < 1e-6) return true;
    return number == -8888.0 || number == -32768.0 || fabs(number) > FILL;
}

double sonde_value(sonde_builder *builder, const sonde_unit *unit, double number)
{
    const sonde_quantity q = unit->quantity;
    const double value = unit->scale * number + unit->shift;
    const bool is_celsius = unit->shift != 0.0;

    /* In degrees Celsius -99 is within the range, and colder than air. */
    if (!is_flag(number) || (is_inside(q, value) && !(is_celsius && number < 0.0))) return value;
    builder->flag_count++;
    return (double)NAN;
}

static double dew_point_of(sonde_builder *builder, const double *value)
{
    if (!isnan(value[SONDE_DEW_POINT])) return value[SONDE_DEW_POINT];
    if (!isnan(value[SONDE_DEPRESSION])) return value[SONDE_TEMPERATURE] - value[SONDE_DEPRESSION];
    if (isnan(value[SONDE_HUMIDITY])) return (double)NAN;
    builder->most_humidity = fmax(builder->most_humidity, value[SONDE_HUMIDITY]);
    return weather_dew_point_k(value[SONDE_TEMPERATURE],
                               fmax(LEAST_HUMIDITY, value[SONDE_HUMIDITY]));
}

/* How a level lies to the one below it. */
static bool rises(const sonde_level *last, const sonde_level *level)
{
    const bool has_altitudes = !isnan(last->altitude_m) && !isnan(level->altitude_m);

    return level->pressure_hpa < last->pressure_hpa &&
           (!has_altitudes || level->altitude_m > last->altitude_m);
}

static bool is_noise(const sonde_level *last, const sonde_level *level)
{
    const bool has_altitudes = !isnan(last->altitude_m) && !isnan(level->altitude_m);

    return fabs(level->pressure_hpa - last->pressure_hpa) <= NOISE_HPA &&
           (!has_altitudes || fabs(level->altitude_m - last->altitude_m) <= NOISE_M);
}

static status check_ranges(const double *value, const record_file *file)
{
    for (int q = 0; q <= SONDE_TEMPERATURE; q++)
        if (!isnan(value[q]) && !is_inside((sonde_quantity)q, value[q]))
            return record_file_reject(file, "a level within -500 to 60000 m, up to 1100 hPa and "
                                            "150 to 350 K");
    if (!isnan(value[SONDE_DEW_POINT]) && value[SONDE_DEW_POINT] < range[SONDE_DEW_POINT].low)
        return record_file_reject(file, "a dew point from -123 C");
    if (value[SONDE_HUMIDITY] < 0.0 || value[SONDE_DEPRESSION] < range[SONDE_DEPRESSION].low ||
        value[SONDE_DEPRESSION] > range[SONDE_DEPRESSION].high)
        return record_file_reject(file, "a relative humidity from 0 to 100, a dew point's "
                                        "depression from 0 to 98 K");
    return STATUS_OK;
}

status sonde_add(sonde_builder *builder, const double *value, const record_file *file)
{
    status rc = STATUS_OK;
    sonde *s = builder->s;
    const sonde_level *last = s->count ? &s->level[s->count - 1] : NULL;

    TRY(check_ranges(value, file));
    if (isnan(value[SONDE_PRESSURE]) || isnan(value[SONDE_TEMPERATURE])) goto out;
    const sonde_level level = {value[SONDE_ALTITUDE], value[SONDE_PRESSURE],
                               value[SONDE_TEMPERATURE], dew_point_of(builder, value)};
    if (level.dew_point_k > level.temperature_k + SUPERSATURATED_K) {
        rc = record_file_reject(file, "a dew point up to the temperature, a relative humidity up "
                                      "to 100");
        goto out;
    }
    if (last && !rises(last, &level)) {
        builder->noise_count++;
        if (!is_noise(last, &level))
            rc = record_file_reject(file, "a level above the one before, with less pressure");
        goto out;
    }
    NEED(array_add(&s->level, s->count, sizeof *s->level), STATUS_MEMORY,
         "no memory for a radiosonde's levels");
    s->level[s->count++] = level;
out:
    return rc;
}

/* Metres that the air between two levels is thick, by the hypsometric equation for dry air. */
static double thickness_m(const sonde_level *low, const sonde_level *high)
{
    return DRY_AIR_J_KG_K / GRAVITY_M_S2 * .5 * (low->temperature_k + high->temperature_k) *
           log(low->pressure_hpa / high->pressure_hpa);
}

/* Sets altitudes that are missing between two levels; `high` may be behind the last. */
static void fill_between(sonde *s, size_t low, size_t high)
{
    const double sum_low = s->level[low].altitude_m;
    double sum = 0.0, scale = 1.0;

    for (size_t i = low; high < s->count && i < high; i++)
        sum += thickness_m(&s->level[i], &s->level[i + 1]);
    if (high < s->count) scale = (s->level[high].altitude_m - sum_low) / sum;
    for (size_t i = low + 1; i < high; i++)
        s->level[i].altitude_m =
            s->level[i - 1].altitude_m + scale * thickness_m(&s->level[i - 1], &s->level[i]);
}

/* Returns how many altitudes it set; SIZE_MAX where there is none to begin with. */
static size_t fill_altitudes(sonde *s)
{
    size_t first = 0, missing = 0, known;

    for (size_t i = 0; i < s->count; i++) missing += isnan(s->level[i].altitude_m);
    while (first < s->count && isnan(s->level[first].altitude_m)) first++;
    if (first == s->count) return SIZE_MAX;
    for (size_t i = first; i > 0; i--)
        s->level[i - 1].altitude_m =
            s->level[i].altitude_m - thickness_m(&s->level[i - 1], &s->level[i]);
    known = first;
    for (size_t i = first + 1; i <= s->count; i++) {
        if (i < s->count && isnan(s->level[i].altitude_m)) continue;
        fill_between(s, known, i);
        known = i;
    }
    return missing;
}

static void bridge_dew_points(sonde *s)
{
    size_t known = s->count;

    for (size_t i = 0; i < s->count; i++) {
        if (isnan(s->level[i].dew_point_k)) continue;
        const sonde_level *a = known < i ? &s->level[known] : NULL, *b = &s->level[i];
        const double width_m = a ? b->altitude_m - a->altitude_m : 0.0;
        for (size_t k = known + 1; a && width_m <= BRIDGED_M && k < i; k++)
            s->level[k].dew_point_k =
                a->dew_point_k + (b->dew_point_k - a->dew_point_k) *
                                     (s->level[k].altitude_m - a->altitude_m) / width_m;
        known = i;
    }
}

/* Refuses what is in other units than its names say: fractions for per cent, feet for metres. */
static status check_units(const sonde_builder *builder)
{
    status rc = STATUS_OK;
    const sonde *s = builder->s;
    const sonde_level *low = &s->level[0], *high = &s->level[s->count - 1];
    double thick_m = 0.0;

    NEED(!(builder->most_humidity > 0.0 && builder->most_humidity < DRIEST), STATUS_FORMAT,
         "%s: its relative humidity is at most %.3g %%: expected per cent, not fractions",
         builder->path, 100.0 * builder->most_humidity);
    for (size_t i = 1; i < s->count; i++) thick_m += thickness_m(&s->level[i - 1], &s->level[i]);
    const double ratio = (high->altitude_m - low->altitude_m) / thick_m;
    NEED(ratio < MISFIT && ratio > 1.0 / MISFIT, STATUS_FORMAT,
         "%s: its heights rise by %.4g m, which is %.3g times what pressure and temperature give: "
         "expected metres above sea level",
         builder->path, high->altitude_m - low->altitude_m, ratio);
out:
    return rc;
}

status sonde_finish(sonde_builder *builder)
{
    status rc = STATUS_OK;
    sonde *s = builder->s;
    const char *path = builder->path;

    NEED(s->count >= 2, STATUS_FORMAT,
         "%s: expected at least two levels with pressure and temperature", path);
    const size_t filled = fill_altitudes(s);
    NEED(filled < SIZE_MAX, STATUS_FORMAT, "%s: no level has a height", path);
    for (size_t i = 1; i < s->count; i++)
        NEED(s->level[i].altitude_m > s->level[i - 1].altitude_m, STATUS_FORMAT,
             "%s: heights do not rise from %g to %g hPa", path, s->level[i - 1].pressure_hpa,
             s->level[i].pressure_hpa);
    TRY(check_units(builder));
    bridge_dew_points(s);
    if (filled)
        status_warn("%s: %zu heights are missing, and follow from pressure and temperature", path,
                    filled);
    if (builder->flag_count)
        status_warn("%s: %zu numbers such as -999 stand for missing values", path,
                    builder->flag_count);
    if (builder->noise_count)
        status_warn("%s: %zu levels repeat one or fall a little below it, and are passed over",
                    path, builder->noise_count);
out:
    return rc;
}
