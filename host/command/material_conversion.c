#include "command/material_conversion.h"

#include "base/number.h"
#include "files/file_name.h"
#include "files/output_file.h"
#include "material/heat_weight.h"
#include "options/option_table.h"
#include "options/program.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char command[] = "radsig material convert";

static const char purpose[] =
    "Converts a measured spectrum (ECOSTRESS, splib07, ENVI, SVC, CSV, refractiveindex.info) to a\n"
    "library of one [[material]] that names it, with its means for heat exchange, or to an .ems "
    "of\n"
    "91 angles every 100 cm-1, which loses what is narrower.\n";

static const char *const laws[] = {"constant", "fresnel", "rough", "thesis"};

typedef struct conversion {
    spectral_source source;
    const char *out;
    int law;
    double outside;
    bool holds;
    emissivity *made;
    bool is_directional;
} conversion;

static status read_source(conversion *c)
{
    status rc = STATUS_OK;
    spectral_curve *curve = NULL;

    TRY(spectral_curve_read(&curve, &c->source));
    NEED(curve->quantity != SPECTRAL_TRANSMITTANCE, STATUS_FORMAT,
         "%s: found transmittance, expected emissivity, reflectance or optical constants",
         c->source.path);
    if (curve->is_directional)
        status_warn("%s: its reflectance was measured between two directions (%s)", c->source.path,
                    curve->measurement);
    c->is_directional = curve->is_directional;
    spectral_curve_take_kirchhoff(curve);
    TRY(emissivity_make(&c->made, &curve, NULL, 1, (emissivity_law)c->law));
    c->made->outside = c->outside;
out:
    spectral_curve_free(curve);
    return rc;
}

/* A TOML string: quotes and backslashes escaped. */
static void print_string(FILE *to, const char *key, const char *text)
{
    fprintf(to, "%s = \"", key);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\') fputc('\\', to);
        fputc(*text, to);
    }
    fputs("\"\n", to);
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');

    return slash ? slash + 1 : path;
}

/* The spectrum's path as the library finds it: beside it, or from the root. The caller frees it. */
static char *path_from_library(const char *path, const char *out)
{
    const size_t folder = (size_t)(base_name(path) - path);

    if (folder == (size_t)(base_name(out) - out) && !strncmp(path, out, folder))
        return strdup(base_name(path));
    return realpath(path, NULL);
}

static void print_name(FILE *to, const char *path)
{
    char name[64];
    const char *base = base_name(path);

    snprintf(name, sizeof name, "%.*s", (int)strcspn(base, "."), base);
    print_string(to, "name", name);
}

/* A mean that heat exchange takes, unless too much is missing of it. */
static void print_mean(FILE *to, const char *key, const heat_mean *mean, const char *weight)
{
    if (mean->missing_share > HEAT_WEIGHT_MISSING)
        fprintf(to, "# %s: to be stated, the spectrum lacks %.0f %% of %s\n", key,
                100.0 * mean->missing_share, weight);
    else
        fprintf(to, "# %s is %.3f, by %.0f %% of %s\n", key, mean->value,
                100.0 * mean->measured_share, weight);
}

static status write_toml(const conversion *c, FILE *to)
{
    status rc = STATUS_OK;
    char ranges[512], *path = path_from_library(c->source.path, c->out);
    const heat_mean sun = heat_weight_sun(c->made), body = heat_weight_300k(c->made);

    NEED(path, STATUS_FILE, "%s: has no path", c->source.path);
    fprintf(to, "# %zu wavelengths, %s um\n", c->made->grid.count,
            wavelength_grid_text(&c->made->grid, ranges, sizeof ranges));
    fputs("[[material]]\n", to);
    print_name(to, c->source.record ? c->source.record : c->source.path);
    print_string(to, "spectrum_file", path);
    if (c->source.record) print_string(to, "record", c->source.record);
    if (c->source.wavelength_path) {
        free(path);
        path = path_from_library(c->source.wavelength_path, c->out);
        NEED(path, STATUS_FILE, "%s: has no path", c->source.wavelength_path);
        print_string(to, "wavelength_file", path);
    }
    if (c->made->law != EMISSIVITY_OPTICAL) print_string(to, "angular", laws[c->law]);
    if (c->is_directional) fputs("accept_geometry = true\n", to);
    if (c->holds) print_string(to, "outside", "hold");
    if (!isnan(c->outside)) fprintf(to, "outside = %.9g\n", c->outside);
    print_mean(to, "solar_absorptance", &sun, "sunlight");
    print_mean(to, "emissivity", &body, "what a body of 300 K emits");
out:
    free(path);
    return rc;
}

static status write_ems(const conversion *c, FILE *to)
{
    status rc = STATUS_OK;
    const double last_cm1 =
        WAVENUMBER_ROWS_FIRST_CM1 - WAVENUMBER_ROWS_STEP_CM1 * (WAVENUMBER_ROWS - 1);
    const double um =
        wavelength_grid_uncovered(&c->made->grid, 1e4 / WAVENUMBER_ROWS_FIRST_CM1, 1e4 / last_cm1);

    NEED(
        c->holds || !isnan(c->outside) || isnan(um), STATUS_ARGUMENT,
        "%s: found nothing near %.4g um, expected --outside hold or a number: an .ems reaches from "
        "0.25 to 29 um",
        c->source.path, um);
    for (int angle = 0; angle < EMISSIVITY_ANGLES; angle++) {
        fprintf(to, "%d\n", angle);
        for (int i = 0; i < WAVENUMBER_ROWS; i++) {
            const int cm1 = WAVENUMBER_ROWS_FIRST_CM1 - WAVENUMBER_ROWS_STEP_CM1 * i;
            fprintf(to, "%d %.6f\n", cm1, emissivity_at(c->made, cm1, angle));
        }
    }
out:
    return rc;
}

static status convert(conversion *c)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    NEED(file_name_ends(c->out, ".toml") || file_name_ends(c->out, ".ems"), STATUS_ARGUMENT,
         "%s: expected a name that ends with .toml or .ems", c->out);
    TRY(read_source(c));
    TRY(output_file_open(&file, c->out));
    TRY(file_name_ends(c->out, ".ems") ? write_ems(c, output_file_stream(file))
                                       : write_toml(c, output_file_stream(file)));
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

/* "hold" or a number from 0 to 1. */
static status read_outside(const option *o, const char *text)
{
    status rc = STATUS_OK;
    conversion *c = o->out;

    c->holds = !strcmp(text, "hold");
    if (c->holds) return STATUS_OK;
    NEED(number_read(text, &c->outside) && c->outside >= 0.0 && c->outside <= 1.0, STATUS_ARGUMENT,
         "found '%s', expected hold or a number from 0 to 1", text);
out:
    return rc;
}

int material_conversion_run(int argc, char **argv)
{
    conversion c = {.outside = NAN};
    option list[] = {
        {"output", 'o', "FILE", "FILE.toml or FILE.ems", .text = &c.out, .is_required = true},
        {"record", 0, "NAME", "the record of an ENVI spectral library", .text = &c.source.record},
        {"wavelength-file", 0, "FILE", "the wavelengths of a splib07 file",
         .text = &c.source.wavelength_path},
        {"angular", 0, "LAW", "constant (the default), fresnel, rough or thesis", .index = &c.law,
         .word = laws, .word_count = sizeof laws / sizeof *laws},
        {"outside", 0, "X", "hold, or a number: where nothing was measured", .out = &c,
         .read = read_outside}};
    const option_table table = {command, "FILE", 1, 1, purpose, list, sizeof list / sizeof *list};
    int code = option_table_read(&table, argc, argv, NULL);

    if (code == OPTION_TABLE_DONE) {
        c.source.path = argv[1];
        code = program_end(command, convert(&c));
    }
    emissivity_free(c.made);
    return code;
}
