#include "base/terminal_text.h"
#include "command/command.h"
#include "command/material_conversion.h"
#include "command/material_plot.h"
#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 4096 };

static const char list_purpose[] =
    "Lists the materials of libraries (.mat, .toml): number, name, solar absorptance and thermal\n"
    "emissivity that heat exchange takes, and what their spectra come to.\n";
static const char show_purpose[] =
    "Shows all about one material of libraries (.mat, .toml): heat, lobe, spectrum, its means.\n";

/* Whether radiance has a table to take it from. */
static bool has_spectrum(const scene_material *m)
{
    return m->table != NULL;
}

static void print_heat(const char *what, double used, const heat_mean *mean, const char *weight)
{
    printf("%s %.3f for heat", what, used);
    if (mean)
        printf("; the spectrum over %s %.3f, %+.3f, %.0f %% of it measured", weight, mean->value,
               mean->value - used, 100.0 * mean->measured_share);
    putchar('\n');
}

static void print_means(const emissivity *e)
{
    static const struct {
        const char *name;
        double low_um, high_um;
    } ranges[] = {{"0.4 to 0.7", .4, .7},
                  {"0.7 to 1", .7, 1.0},
                  {"1 to 2.5", 1.0, 2.5},
                  {"3 to 5", 3.0, 5.0},
                  {"8 to 14", 8.0, 14.0}};

    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const double low_um = ranges[i].low_um, high_um = ranges[i].high_um;
        printf("emissivity      %s um ", ranges[i].name);
        if (isnan(e->outside) && !isnan(wavelength_grid_uncovered(&e->grid, low_um, high_um)))
            puts("not measured");
        else
            printf("%.4f\n", emissivity_integral(e, low_um, high_um) / (high_um - low_um));
    }
    printf("emissivity      at 10 um, 0 30 60 75 85 degrees");
    for (int i = 0; i < 5; i++)
        printf(" %.4f", emissivity_at(e, 1000.0, (double[]){0.0, 30.0, 60.0, 75.0, 85.0}[i]));
    putchar('\n');
}

static void print_material(const scene_material *m)
{
    const material_record *r = &m->record;
    char name[NAME_SIZE];
    heat_mean sun, body;

    printf("material        %u %s\n", r->number, terminal_text_copy(name, sizeof name, m->name));
    if (has_spectrum(m)) {
        sun = heat_weight_sun(m->table);
        body = heat_weight_300k(m->table);
    }
    print_heat("solar           absorptance", (double)r->solar_absorptance,
               has_spectrum(m) ? &sun : NULL, "sunlight");
    print_heat("thermal         emissivity", (double)r->thermal_emissivity,
               has_spectrum(m) ? &body : NULL, "300 K");
    printf("heat            density %g kg/m3, specific heat %g J/kg/K, conductivity %g W/m/K\n",
           (double)r->density_kg_m3, (double)r->specific_heat_j_kg_k,
           (double)r->conductivity_w_m_k);
    printf("lobe            specular share %g, roughness %g\n", (double)r->specular_share,
           (double)r->roughness);
    if (m->spectrum) printf("spectrum        %s\n", m->spectrum);
    if (m->medium != RECORD_NONE)
        puts("emissivity      transmissive: what it takes from light it emits");
    else if (has_spectrum(m))
        print_means(m->table);
    else
        printf("emissivity      %.4f at all wavelengths and angles\n", m->grey_emissivity);
}

static int list(int argc, char **argv)
{
    static const char name[] = "radsig material list";
    const option_table table = {name, "LIBRARY...", 1, 64, list_purpose, NULL, 0};
    char text[NAME_SIZE];
    int count;
    scene *s = NULL;
    const int code = option_table_read(&table, argc, argv, &count);

    if (code != OPTION_TABLE_DONE) return code;
    const status rc = scene_read_libraries(&s, (const char *const *)argv + 1, (size_t)count, NULL,
                                           SCENE_THERMAL_FIXED);
    for (uint32_t i = 0; rc == STATUS_OK && i < s->material_count; i++) {
        const scene_material *m = &s->materials[i];
        printf("%5u %-24s solar %.3f thermal %.3f %s\n", m->record.number,
               terminal_text_copy(text, sizeof text, m->name), (double)m->record.solar_absorptance,
               (double)m->record.thermal_emissivity,
               m->spectrum                ? m->spectrum
               : m->medium != RECORD_NONE ? "transmissive"
               : has_spectrum(m)          ? "emissivity_file"
                                          : "grey");
    }
    scene_free(s);
    return program_end(name, rc);
}

static int show(int argc, char **argv)
{
    static const char name[] = "radsig material show";
    const char *plot = NULL, *angle_plot = NULL;
    option options[] = {
        {"plot", 0, "FILE.png", "draw emissivity over wavelength", .text = &plot},
        {"plot-angle", 0, "FILE.png", "draw emissivity over angle", .text = &angle_plot}};
    const option_table table = {
        name, "NAME LIBRARY...", 2, 65, show_purpose, options, sizeof options / sizeof *options};
    int count;
    scene *s = NULL;
    const int code = option_table_read(&table, argc, argv, &count);

    if (code != OPTION_TABLE_DONE) return code;
    status rc = scene_read_libraries(&s, (const char *const *)argv + 2, (size_t)count - 1, argv[1],
                                     SCENE_THERMAL_FIXED);
    if (rc == STATUS_OK) rc = material_plot_write(&s->materials[0], plot, angle_plot);
    if (rc == STATUS_OK) print_material(&s->materials[0]);
    scene_free(s);
    return program_end(name, rc);
}

int command_material(int argc, char **argv)
{
    static const struct {
        const char *name;
        int (*run)(int argc, char **argv);
    } parts[] = {{"list", list}, {"show", show}, {"convert", material_conversion_run}};

    for (size_t i = 0; argc > 1 && i < sizeof parts / sizeof *parts; i++)
        if (!strcmp(argv[1], parts[i].name)) return parts[i].run(argc - 1, argv + 1);
    if (argc > 1 && (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h"))) {
        puts("usage: radsig material list LIBRARY...\n"
             "       radsig material show NAME LIBRARY... [--plot FILE.png] [--plot-angle "
             "FILE.png]\n"
             "       radsig material convert FILE -o FILE.toml|FILE.ems\n"
             "Each tells more with --help.");
        return 0;
    }
    return program_misuse("radsig material", "found %s, expected list, show or convert",
                          argc > 1 ? argv[1] : "nothing");
}
