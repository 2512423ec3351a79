#include "base/terminal_text.h"
#include "command/command.h"
#include "command/command_scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 4096, BANDS_SHOWN = 16 };

static const char command[] = "radsig check";

static const char purpose[] =
    "Reads everything that a render of the scene would read, reports every error it can find on\n"
    "stderr with file and line, and prints a summary of the scene with units.\n";

static void print_place(const scene *s)
{
    char name[NAME_SIZE];
    char time[SITE_TIME_SIZE];

    site_format_time(s->place.time_s, s->place.utc_offset_min, time);
    printf("scene       %s\n", s->name);
    printf("site        latitude %.6f deg, longitude %.6f deg (east-positive), %s\n",
           s->place.latitude_deg, s->place.longitude_deg, time);
    if (s->time_count > 1) {
        site_format_time(s->time_s[s->time_count - 1], s->place.utc_offset_min, time);
        printf("times       %zu, the last %s\n", s->time_count, time);
    }
    if (s->ground_material != RECORD_NONE)
        printf("ground      %s, z = %.3f m, endless\n",
               terminal_text_copy(name, sizeof name, s->materials[s->ground_material].name),
               s->ground_z_m);
}

static void print_weather(const scene *s)
{
    double coldest = INFINITY, warmest = -INFINITY, sunniest = 0.0;
    const weather *w = s->history;

    if (!w) {
        puts("weather     none");
        return;
    }
    for (size_t i = 0; i < w->count; i++) {
        coldest = fmin(coldest, w->record[i].air_temperature_k);
        warmest = fmax(warmest, w->record[i].air_temperature_k);
        sunniest = fmax(sunniest, w->record[i].direct_w_m2);
    }
    printf("weather     %zu records every %g min, air %.1f to %.1f C, direct sun up to %.0f W/m2\n",
           w->count, w->interval_s / 60.0, coldest - 273.15, warmest - 273.15, sunniest);
}

static void print_atmosphere(const scene *s)
{
    const atmosphere *air = s->air;

    if (s->is_uniform) {
        puts("atmosphere  uniform");
        return;
    }
    printf("atmosphere  %d points, %.4g to %.4g um; %d paths, zenith %g to %g deg, sensor at %g m; "
           "sky %d x %d directions\n",
           air->point_count, air->wavelength_um[0], air->wavelength_um[air->point_count - 1],
           air->path_count, air->path_zenith_first_deg,
           air->path_zenith_first_deg + (air->path_count - 1) * air->path_zenith_step_deg,
           air->sensor_altitude_m, air->zenith_count, air->azimuth_count);
}

static void print_geometry(const scene *s)
{
    const geometry *g = s->shape;
    double area = 0.0;

    for (uint32_t i = 0; i < g->facet_count; i++) area += (double)g->area_m2[i];
    printf("geometry    %u objects, %u parts, %u facets, %.6g m2\n", g->object_count, g->part_count,
           g->facet_count, area);
    printf("box         x %.6g to %.6g m, y %.6g to %.6g m, z %.6g to %.6g m\n",
           (double)g->low[0] + g->origin_m[0], (double)g->high[0] + g->origin_m[0],
           (double)g->low[1] + g->origin_m[1], (double)g->high[1] + g->origin_m[1],
           (double)g->low[2] + g->origin_m[2], (double)g->high[2] + g->origin_m[2]);
    printf("oddities    %u facets not finite, %u without area, %u repeated, %u non-manifold\n",
           g->non_finite_count, g->degenerate_count, g->duplicate_count, g->non_manifold_count);
}

/* What a spectrum covers, what it comes to for heat exchange, and its mean in the first bands. */
static void print_spectrum(const scene *s, const scene_material *m)
{
    const double share = 100.0;

    printf("spectrum        %s\n", m->spectrum);
    printf("spectrum        sunlight absorbed %.3f (%.0f %% of it measured, %.0f %% unknown), "
           "emitted at 300 K %.3f (%.0f %%, %.0f %%)\n",
           m->sun.value, share * m->sun.measured_share, share * m->sun.missing_share, m->body.value,
           share * m->body.measured_share, share * m->body.missing_share);
    for (uint32_t i = 0; i < s->band_count && i < BANDS_SHOWN; i++) {
        const band *b = &s->bands[i];
        if (b->sensor) continue;
        printf("spectrum        mean emissivity in %s %.4f\n", b->name,
               emissivity_integral(m->table, b->low_um, b->high_um) / (b->high_um - b->low_um));
    }
}

static void print_materials(const scene *s)
{
    char name[NAME_SIZE];

    for (uint32_t i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->materials[i];
        uint32_t facets = 0;
        for (uint32_t f = 0; f < s->shape->facet_count; f++)
            facets += s->material_of[s->shape->material[f]] == i;
        printf("material    %3u %-24s %7u facets, solar absorptance %.2f, thermal emissivity %.2f, "
               "%s\n",
               m->record.number, terminal_text_copy(name, sizeof name, m->name), facets,
               (double)m->record.solar_absorptance, (double)m->record.thermal_emissivity,
               m->medium != RECORD_NONE          ? "transmissive"
               : m->record.specular_share > 0.0f ? "specular"
                                                 : "diffuse");
        if (m->spectrum) print_spectrum(s, m);
    }
}

/* Names of meshes that are called otherwise in the scene. */
static void print_aliases(const scene *s)
{
    char from[NAME_SIZE], to[NAME_SIZE];

    for (uint32_t i = 0; i < s->shape->material_count; i++) {
        const char *name = s->shape->materials[i].name;
        const char *own = s->materials[s->material_of[i]].name;
        if (strcmp(name, own) != 0)
            printf("alias       %s is %s\n", terminal_text_copy(from, sizeof from, name),
                   terminal_text_copy(to, sizeof to, own));
    }
}

static void print_sensor(const scene *s)
{
    const view *v = &s->camera;
    double d[3], range = 0.0;

    for (int k = 0; k < 3; k++) {
        d[k] = v->position_m[k] - v->target_m[k];
        range += d[k] * d[k];
    }
    range = sqrt(range);
    const double width_m = v->width_m > 0.0 ? v->width_m : 36.0 / v->focal_length_mm * range;
    printf("camera      %d x %d pixels, ", v->columns, v->rows);
    if (v->crop.columns)
        printf("from column %d, row %d of %d x %d, ", v->crop.column, v->crop.row, v->crop.columns,
               v->crop.rows);
    if (v->width_m > 0.0)
        printf("orthographic, %g m wide, ", v->width_m);
    else
        printf("lens %g mm, ", v->focal_length_mm);
    printf("%.6g m from its target, %.3f deg above it, pixel %.4g m there\n", range,
           asin(d[2] / range) * 180.0 / M_PI,
           width_m / (v->crop.columns ? v->crop.columns : v->columns));
    for (uint32_t i = 0; i < s->band_count; i++) {
        const band *b = &s->bands[i];
        printf("band        %s, ", b->name);
        if (b->sensor)
            printf("response of %d database points", b->sensor->count);
        else
            printf("%g to %g um", b->low_um, b->high_um);
        printf(", gain %g per W m-2 sr-1, offset %g\n", b->gain, b->offset);
    }
    printf("render      %s mode, thermal %s, hemisphere every %g x %g deg\n",
           s->thesis ? "thesis" : "exact", scene_thermal_name(s->thermal),
           s->hemisphere_zenith_step_deg, s->hemisphere_azimuth_step_deg);
}

static void print_summary(const scene *s)
{
    char name[NAME_SIZE];

    print_place(s);
    print_weather(s);
    print_atmosphere(s);
    print_geometry(s);
    print_materials(s);
    print_aliases(s);
    print_sensor(s);
    for (size_t i = 0; i < s->input_count; i++)
        printf("input       %s\n", terminal_text_copy(name, sizeof name, s->inputs[i].name));
}

int command_check(int argc, char **argv)
{
    command_settings settings = {0};
    option list[] = {command_set_option(&settings)};
    const option_table table = {command, "SCENE", 1, 1, purpose, list, sizeof list / sizeof *list};
    scene *s = NULL;
    int code = option_table_read(&table, argc, argv, NULL);

    if (code == OPTION_TABLE_DONE) {
        const status rc = command_scene_read(&s, argv[1], &settings);
        if (rc == STATUS_OK) print_summary(s);
        code = program_end(command, rc);
    }
    scene_free(s);
    command_settings_free(&settings);
    return code;
}
