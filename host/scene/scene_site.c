#include "scene/atmosphere_plan.h"
#include "scene/scene_parts.h"
#include "sky/uniform_atmosphere.h"
#include "station/weather_history.h"
#include "weather/weather_place.h"
#include "weather/weather_synthesis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool read_one_time(scene_table *t, const toml_node *node, site *out)
{
    char message[512];
    const char *iso;

    if (toml_node_time(&iso, node, message, sizeof message) != 0)
        return scene_took(t->reader, status_set(STATUS_FORMAT, "%s", message));
    if (site_parse_time(iso, &out->time_s, &out->utc_offset_min) == STATUS_OK) return true;
    scene_fail(t->reader, node, "%s: %s", toml_node_name(node), status_last());
    return false;
}

/* Several times: of one local day, in its order, so that one history of weather holds for all. */
static void read_times(scene_table *t, const toml_node *list, site *place)
{
    scene *s = t->reader->s;
    const size_t count = toml_node_count(list);

    if (count == 0 || count > SCENE_TIMES) {
        scene_fail(t->reader, list, "site.time: %zu times, expected 1 to %d", count, SCENE_TIMES);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const toml_node *node = toml_node_at(list, i);
        site at = *place;
        if (!read_one_time(t, node, &at)) return;
        if (i == 0) *place = at;
        if (at.utc_offset_min != place->utc_offset_min ||
            site_midnight_s(&at) != site_midnight_s(place))
            scene_fail(t->reader, node,
                       "site.time: expected times of one local day with one offset");
        if (i > 0 && at.time_s <= s->time_s[i - 1])
            scene_fail(t->reader, node, "site.time: expected a time after the one before");
        s->time_s[i] = at.time_s;
    }
    s->time_count = count;
}

static void read_time(scene_table *t, site *place)
{
    const toml_node *node = scene_table_node(t, "time");

    if (!node) return;
    if (toml_node_kind(node) == TOML_ARRAY)
        read_times(t, node, place);
    else
        read_one_time(t, node, place);
}

static void read_node(scene_table *t, site *place)
{
    site_node node;
    const char *path;

    if (scene_table_file(t, "node", &path) && scene_took(t->reader, site_read_node(&node, path)))
        *place = node.where;
}

void scene_read_site(scene_reader *reader, const char **out_ground_material)
{
    scene_table t = scene_table_open(reader, toml_node_get(reader->root, "site"), "site");
    site *place = &reader->s->place;

    if (scene_table_has(&t, "node")) {
        read_node(&t, place);
    } else {
        scene_table_require(&t, "latitude_deg", "a number from -90 to 90, or node = a .snd file");
        scene_table_require(&t, "longitude_deg", "a number from -180 to 180, east-positive");
        scene_table_require(&t, "time", "a time with offset, as 1987-06-24T10:00:00-05:00");
    }
    scene_table_number(&t, "latitude_deg", -90.0, 90.0, &place->latitude_deg);
    scene_table_number(&t, "longitude_deg", -180.0, 180.0, &place->longitude_deg);
    reader->s->time_s = calloc(SCENE_TIMES, sizeof *reader->s->time_s);
    reader->s->time_count = 1;
    if (!reader->s->time_s)
        scene_took(reader, status_set(STATUS_MEMORY, "no memory for the scene's times"));
    else
        read_time(&t, place);
    if (reader->s->time_s) reader->s->time_s[0] = place->time_s;
    scene_table_string(&t, "ground_material", out_ground_material);
    scene_table_close(&t);
}

static void read_celsius(scene_table *t, const char *key, double *out_k)
{
    double celsius;

    if (scene_table_number(t, key, WEATHER_LEAST_C, WEATHER_MOST_C, &celsius))
        *out_k = celsius + 273.15;
}

static void read_summary(scene_table *t, weather_summary *summary)
{
    double cloud, pressure_hpa, rain_mm_h;

    scene_table_require(t, "air_temperature_sunrise_c", "degrees C, or history = a .wth file");
    scene_table_require(t, "air_temperature_peak_c", "degrees C");
    scene_table_require(t, "peak_time_h", "local time from 0 to 24");
    scene_table_require(t, "relative_humidity_sunrise", "a share from 0 to 1");
    scene_table_require(t, "wind_m_s", "m/s");
    read_celsius(t, "air_temperature_sunrise_c", &summary->air_temperature_sunrise_k);
    read_celsius(t, "air_temperature_peak_c", &summary->air_temperature_peak_k);
    scene_table_number(t, "peak_time_h", 0.0, 24.0, &summary->peak_time_h);
    scene_table_number(t, "relative_humidity_sunrise", 0.0, 1.0,
                       &summary->relative_humidity_sunrise);
    scene_table_number(t, "wind_m_s", 0.0, 100.0, &summary->wind_m_s);
    if (scene_table_number(t, "pressure_hpa", 300.0, 1100.0, &pressure_hpa))
        summary->pressure_pa = 100.0 * pressure_hpa;
    scene_table_number(t, "sky_exposure", 0.0, 1.0, &summary->sky_exposure);
    if (scene_table_whole(t, "cloud_type", 0.0, WEATHER_CLOUD_TYPES - 1, &cloud))
        summary->cloud_type = (int)cloud;
    scene_table_number(t, "sunrise_h", 0.0, 24.0, &summary->sunrise_h);
    scene_table_number(t, "sunset_h", 0.0, 24.0, &summary->sunset_h);
    scene_table_number(t, "high_noon_transmission", 0.0, 1.0, &summary->high_noon_transmission);
    if (scene_table_number(t, "rain_mm_h", 0.0, 1000.0, &rain_mm_h))
        summary->rain_m_s = rain_mm_h / 3.6e6;
    read_celsius(t, "rain_temperature_c", &summary->rain_temperature_k);
}

static void read_history(scene_reader *reader, const char *path)
{
    scene *s = reader->s;

    if (scene_took(reader, weather_history_read(&s->history, path, &s->place)))
        weather_place_check(s->history, &s->place, path);
}

static void read_laws(scene_table *t, forcing_laws *out)
{
    int sky = out->sky, diffuse = out->diffuse, convection = 0;

    scene_table_word(t, "sky_longwave", forcing_sky_names, FORCING_SKIES, &sky);
    scene_table_word(t, "diffuse", forcing_diffuse_names, FORCING_DIFFUSES, &diffuse);
    if (scene_table_word(t, "convection", forcing_convection_names + 1, FORCING_CONVECTIONS - 1,
                         &convection))
        out->convection = (forcing_convection)(convection + 1);
    scene_table_number(t, "roughness_length_m", FORCING_ROUGHNESS_LOW_M, FORCING_ROUGHNESS_HIGH_M,
                       &out->roughness_length_m);
    scene_table_number(t, "wind_height_m", FORCING_HEIGHT_LOW_M, FORCING_HEIGHT_HIGH_M,
                       &out->wind_height_m);
    out->sky = (forcing_sky)sky;
    out->diffuse = (forcing_diffuse)diffuse;
}

void scene_read_weather(scene_reader *reader)
{
    const toml_node *node = toml_node_get(reader->root, "weather");
    scene_table t = scene_table_open(reader, node, "weather");
    weather_summary summary = weather_summary_default();
    const int failures = reader->failure_count;
    const char *path;

    if (!t.node) return;
    read_laws(&t, &reader->s->laws);
    if (scene_table_has(&t, "history")) {
        if (scene_table_file(&t, "history", &path)) read_history(reader, path);
        scene_table_close(&t);
        return;
    }
    read_summary(&t, &summary);
    scene_table_close(&t);
    if (reader->failure_count == failures)
        scene_took_at(reader, node,
                      weather_synthesise(&reader->s->history, &summary, &reader->s->place));
}

static void read_uniform(scene_reader *reader, const toml_node *node)
{
    scene *s = reader->s;
    scene_table t = scene_table_open(reader, node, "atmosphere.uniform");
    uniform_sky sky = {0};
    const int failures = reader->failure_count;
    double low = INFINITY, high = 0.0;

    s->is_uniform = true;
    scene_table_require(&t, "sky_temperature_k", "K");
    scene_table_require(&t, "sky_radiance_w_m2_sr_um", "W m-2 sr-1 um-1");
    scene_table_require(&t, "sun_irradiance_w_m2_um", "W m-2 um-1");
    scene_table_require(&t, "transmission", "a share from 0 to 1");
    scene_table_require(&t, "path_temperature_k", "K");
    scene_table_number(&t, "sky_temperature_k", 1.0, 6000.0, &sky.sky_temperature_k);
    scene_table_number(&t, "sky_radiance_w_m2_sr_um", 0.0, 1e9, &sky.sky_radiance_w_m2_sr_um);
    scene_table_number(&t, "sun_irradiance_w_m2_um", 0.0, 1e9, &sky.sun_irradiance_w_m2_um);
    scene_table_number(&t, "transmission", 0.0, 1.0, &sky.transmission);
    scene_table_number(&t, "path_temperature_k", 1.0, 6000.0, &sky.path_temperature_k);
    scene_table_close(&t);
    for (uint32_t i = 0; i < s->band_count; i++) {
        low = fmin(low, s->bands[i].low_um);
        high = fmax(high, s->bands[i].high_um);
        if (s->bands[i].sensor)
            scene_fail(reader, node, "a sensor file's responses belong to a radiance database");
    }
    if (reader->failure_count == failures && high > low)
        scene_took(reader, uniform_atmosphere_make(&s->air, &sky, low, high, s->thesis));
}

void scene_read_atmosphere(scene_reader *reader)
{
    scene_table t =
        scene_table_open(reader, toml_node_get(reader->root, "atmosphere"), "atmosphere");
    const toml_node *uniform = scene_table_node(&t, "uniform");
    const toml_node *generate = scene_table_node(&t, "generate");
    const bool stated = scene_table_has(&t, "database");
    const char *path;
    atmosphere_plan plan;

    if (generate) atmosphere_plan_read(&plan, reader, generate);
    if (uniform && stated)
        scene_fail(reader, uniform, "atmosphere: states both database and uniform, expected one");
    else if (uniform)
        read_uniform(reader, uniform);
    else if (!stated)
        scene_table_require(&t, "database", "a .rad file, or uniform = { ... }");
    else if (scene_table_file(&t, "database", &path))
        scene_took(reader, atmosphere_read(&reader->s->air, path));
    scene_table_close(&t);
}
