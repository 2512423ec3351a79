#include "render/render_probe.h"

#include "image/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 512, TAU2 = 5 };

/* As radiometry.cl writes them. */
static const struct probe_term {
    const char *name, *unit;
    uint8_t rgb[3];
} terms[SENSOR_TERMS] = {
    {"emitted", "_w_m2_sr_um", {215, 80, 30}},
    {"reflected_sun", "_w_m2_sr_um", {225, 170, 0}},
    {"reflected_sky", "_w_m2_sr_um", {40, 110, 200}},
    {"reflected_background", "_w_m2_sr_um", {60, 150, 60}},
    {"path", "_w_m2_sr_um", {150, 80, 170}},
    {"transmission", "", {120, 120, 120}},
    {"total", "_w_m2_sr_um", {0, 0, 0}},
};

typedef struct probe_sample {
    double wavelength_um, weight_um, band_end_um;
    uint32_t band, source; /* source: column of the spectra */
} probe_sample;

typedef struct probe {
    const scene *s;
    uint32_t row_length;
    double *value; /* shape (SENSOR_TERMS, row_length) */
    probe_sample *sample;
    size_t count;
} probe;

/* Lists the samples of each band: those that it gives a weight. */
static void list_samples(probe *p, const spectra *bands)
{
    for (uint32_t b = 0; b < bands->band_count; b++) {
        const double *nu = bands->wavenumber_cm1 + bands->bands[b].first_sample;
        const float *weight = bands->weight_um + bands->bands[b].first_weight;
        uint32_t last = bands->bands[b].sample_count - 1;
        while (weight[last] == 0.0f) last--;
        for (uint32_t i = 0; i <= last; i++) {
            const uint32_t source = bands->bands[b].first_sample + i;
            if (weight[i] == 0.0f) continue;
            p->sample[p->count++] = (probe_sample){.wavelength_um = 1e4 / nu[i],
                                                   .weight_um = (double)weight[i],
                                                   .band_end_um = 1e4 / nu[last],
                                                   .band = b,
                                                   .source = source};
        }
    }
}

static status open_probe(probe *p, const scene *s, render *r, uint32_t pixel)
{
    status rc = STATUS_OK;
    const spectra *bands = render_spectra(r);

    p->s = s;
    p->row_length = bands->sample_count;
    p->value = malloc((size_t)SENSOR_TERMS * bands->sample_count * sizeof *p->value);
    p->sample = malloc(bands->weight_count * sizeof *p->sample);
    NEED(p->value && p->sample, STATUS_MEMORY, "no memory for the spectra of a pixel");
    list_samples(p, bands);
    TRY(render_pixel_terms(r, pixel, p->value));
out:
    return rc;
}

static status write_table(const probe *p, output_folder *folder, const char *name)
{
    status rc = STATUS_OK;
    output_file *place;

    TRY(output_folder_add(folder, name, &place));
    FILE *file = output_file_stream(place);
    fputs("band,wavelength_um,weight_um", file);
    for (int k = 0; k < (int)SENSOR_TERMS; k++)
        fprintf(file, ",%s%s", terms[k].name, terms[k].unit);
    fputc('\n', file);
    for (size_t i = 0; i < p->count; i++) {
        const probe_sample *at = &p->sample[i];
        fprintf(file, "%s,%.9g,%.9g", p->s->bands[at->band].name, at->wavelength_um, at->weight_um);
        for (size_t k = 0; k < SENSOR_TERMS; k++)
            fprintf(file, ",%.9g", p->value[k * p->row_length + at->source]);
        fputc('\n', file);
    }
    TRY(output_file_close(place));
out:
    return rc;
}

static int by_wavelength(const void *a, const void *b)
{
    const probe_sample *first = a, *second = b;

    return (first->wavelength_um > second->wavelength_um) -
           (first->wavelength_um < second->wavelength_um);
}

/* Puts the samples of all bands in one order, with gaps where no band is.
 *   out   shape (1 + SENSOR_TERMS, 2 p->count): wavelengths, then values
 * Returns how many there are. */
static size_t lay_out(const probe *p, double *out)
{
    const size_t room = 2 * p->count;
    double end_um = 0.0;
    size_t count = 0;

    for (size_t i = 0; i < p->count; i++) {
        const probe_sample *at = &p->sample[i];
        const bool is_gap = i > 0 && at->wavelength_um > end_um;
        if (i > 0 && at->wavelength_um == out[count - 1]) continue;
        if (is_gap) {
            out[count] = 0.5 * (end_um + at->wavelength_um);
            for (size_t k = 0; k < SENSOR_TERMS; k++) out[(k + 1) * room + count] = (double)NAN;
            count++;
        }
        out[count] = at->wavelength_um;
        for (size_t k = 0; k < SENSOR_TERMS; k++)
            out[(k + 1) * room + count] = p->value[k * p->row_length + at->source];
        count++;
        end_um = fmax(end_um, at->band_end_um);
    }
    return count;
}

static status draw(const probe *p, output_folder *folder, const char *stem, const char *title)
{
    status rc = STATUS_OK;
    char name[NAME_SIZE + 32];
    double *values = malloc((1 + SENSOR_TERMS) * 2 * p->count * sizeof *values);
    curve_line lines[SENSOR_TERMS], tau2;
    curve c = {.title = title, .unit = "W m-2 sr-1 um-1", .x_unit = "um", .is_log = true};

    NEED(values, STATUS_MEMORY, "no memory for the spectra of a pixel");
    qsort(p->sample, p->count, sizeof *p->sample, by_wavelength);
    c.count = lay_out(p, values);
    c.x = values;
    c.line = lines;
    for (size_t k = 0; k < SENSOR_TERMS; k++) {
        const uint8_t *rgb = terms[k].rgb;
        curve_line *to = k == TAU2 ? &tau2 : &lines[c.line_count++];
        *to =
            (curve_line){terms[k].name, values + (k + 1) * 2 * p->count, {rgb[0], rgb[1], rgb[2]}};
    }
    snprintf(name, sizeof name, "%s.png", stem);
    TRY(curve_write_into(folder, name, &c));
    c.unit = "1";
    c.is_log = false;
    c.line = &tau2;
    c.line_count = 1;
    snprintf(name, sizeof name, "%s_transmission.png", stem);
    TRY(curve_write_into(folder, name, &c));
out:
    free(values);
    return rc;
}

status render_probe_write(output_folder *folder, const scene *s, render *r, uint32_t column,
                          uint32_t row)
{
    status rc = STATUS_OK;
    char stem[NAME_SIZE], name[NAME_SIZE + 32], title[NAME_SIZE];
    probe p = {0};

    TRY(open_probe(&p, s, r, row * (uint32_t)s->camera.columns + column));
    snprintf(stem, sizeof stem, "%s_probe_%u_%u", s->name, column, row);
    snprintf(title, sizeof title, "%s, column %u, row %u", s->name, column, row);
    snprintf(name, sizeof name, "%s.csv", stem);
    TRY(write_table(&p, folder, name));
    TRY(draw(&p, folder, stem, title));
out:
    free(p.sample);
    free(p.value);
    return rc;
}
