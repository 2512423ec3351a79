#include "render/render_tables.h"

#include "material/lobe.h"

#include <math.h>
#include <stdlib.h>

status render_tables_take_facets(render_tables *t, device *dev, const scene *s)
{
    status rc = STATUS_OK;
    const size_t real = s->shape->facet_count;
    uint32_t *ids = malloc((t->facet_count + 1) * sizeof *ids);
    material_record *materials = malloc((s->material_count + 1) * sizeof *materials);

    t->facet = malloc((t->facet_count + 1) * sizeof *t->facet);
    NEED(t->facet && ids && materials, STATUS_MEMORY, "no memory for %zu facets", real);
    scene_facet_records(s, t->facet);
    for (size_t i = 0; i < t->facet_count; i++)
        ids[i] = i < real ? s->shape->facet_id[i] : RECORD_NONE;
    for (uint32_t i = 0; i < s->material_count; i++) materials[i] = s->materials[i].record;
    TRY(device_allocate(dev, &t->facets, t->facet_count, t->facet));
    TRY(device_allocate(dev, &t->facet_ids, t->facet_count, ids));
    TRY(device_allocate(dev, &t->materials, s->material_count, materials));
out:
    free(ids);
    free(materials);
    return rc;
}

/* The emissivity of all materials on the samples of spectra, and their diffuse lobes: shape
 * (scene_emissivity_rows, sample_count), to be freed. */
static status sample_emissivity(float **out, const scene *s, const spectra *at)
{
    status rc = STATUS_OK;
    const size_t samples = at->sample_count;
    float *rows = malloc((size_t)scene_emissivity_rows(s) * samples * sizeof *rows + 1);

    NEED(rows, STATUS_MEMORY, "no memory for the emissivity of %u materials", s->material_count);
    for (uint32_t i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->materials[i];
        float *first = rows + (size_t)m->record.emissivity_first * samples;
        if (m->table)
            emissivity_sample(m->table, at->wavenumber_cm1, at->sample_count, first);
        else
            for (size_t k = 0; k < samples; k++) first[k] = (float)m->grey_emissivity;
        if (m->record.lobe_first != RECORD_NONE)
            lobe_fill(first, at->sample_count, scene_lobe_rings(s),
                      rows + (size_t)m->record.lobe_first * samples);
    }
    *out = rows;
out:
    return rc;
}

static status upload_emissivity(float_buffer *out, device *dev, const scene *s, const float *rows,
                                const spectra *at)
{
    return device_allocate(dev, out, (size_t)scene_emissivity_rows(s) * at->sample_count, rows);
}

/* The most that a material reflects into the hemisphere at any wavelength. */
static float most_reflected(const material_record *m, const float *rows, const spectra *at)
{
    float most = 0.0f;

    for (size_t k = 0; k < at->sample_count; k++) {
        const float over = m->lobe_first == RECORD_NONE
                               ? 0.0f
                               : rows[(size_t)m->lobe_first * at->sample_count + k];
        const float even = 1.0f - rows[(size_t)m->emissivity_first * at->sample_count + k];
        most = fmaxf(most, over > 0.0f ? 1.0f / over : even);
    }
    return most;
}

status render_tables_take_blocks(render_tables *t, device *dev, const scene *s)
{
    status rc = STATUS_OK;
    spectra *blocks = NULL;
    float *rows = NULL;

    TRY(spectra_coarsen(&blocks, t->knots->spectra));
    TRY(sample_emissivity(&rows, s, blocks));
    t->blocks.sample_count = blocks->sample_count;
    TRY(device_allocate(dev, &t->blocks.tables.rows,
                        (size_t)blocks->row_count * blocks->sample_count, blocks->rows));
    TRY(upload_emissivity(&t->blocks.tables.emissivity, dev, s, rows, blocks));
    t->reflectance = calloc(t->facet_count + 1, sizeof *t->reflectance);
    NEED(t->reflectance, STATUS_MEMORY, "no memory for %zu facets", t->facet_count);
    for (size_t i = 0; i < t->facet_count; i++)
        t->reflectance[i] =
            most_reflected(&s->materials[t->facet[i].material].record, rows, blocks);
out:
    free(rows);
    spectra_free(blocks);
    return rc;
}

/* Takes what stands at knots to the device.
 *   emissivity_rows   shape (scene_emissivity_rows, sample_count of the bands) */
static status take_knots(render_tables *t, device *dev, const scene *s, const media *through,
                         const float *emissivity_rows)
{
    status rc = STATUS_OK;
    const uint32_t samples = t->bands->sample_count, rows = scene_emissivity_rows(s);
    float *picked = NULL;

    TRY(spectral_grid_find(&t->knots, t->bands, s->air, through != NULL));
    const spectral_grid *k = t->knots;
    if (k->span == 0) goto out;
    picked = malloc((size_t)rows * k->spectra->sample_count * sizeof *picked + 1);
    NEED(picked, STATUS_MEMORY, "no memory for the emissivity of %u materials", s->material_count);
    spectral_grid_pick(k, emissivity_rows, rows, samples, picked);
    TRY(upload_emissivity(&t->knot_spectra.emissivity, dev, s, picked, k->spectra));
    TRY(device_allocate(dev, &t->knot_spectra.rows,
                        (size_t)k->spectra->row_count * k->spectra->sample_count,
                        k->spectra->rows));
    const size_t blocks = samples / SPECTRA_BLOCK;
    TRY(device_allocate(dev, &t->spectra.knot_first, blocks, k->first));
    TRY(device_allocate(dev, &t->spectra.knot_fraction, blocks * k->span * SPECTRA_BLOCK,
                        k->fraction));
out:
    free(picked);
    return rc;
}

/* What planes of bands are looked up in. */
static status tabulate_bands(render_tables *t, device *dev, const scene *s)
{
    status rc = STATUS_OK;
    const uint32_t samples = t->bands->sample_count, rows = scene_emissivity_rows(s);
    const size_t bands = s->band_count;
    const device_shape temperatures = device_ray_shape(dev, BAND_TEMPERATURES, bands);

    TRY(device_allocate(dev, &t->ln_radiance, bands * BAND_TEMPERATURES, NULL));
    TRY(device_allocate(dev, &t->band_emissivity, bands * rows, NULL));
    TRY(band_temperature_run(dev, temperatures,
                             &(band_temperature_args){.sample_count = samples,
                                                      .spectra = t->spectra.rows,
                                                      .bands = t->band_records,
                                                      .weights = t->band_weights,
                                                      .ln_radiance = t->ln_radiance}));
    TRY(band_emissivity_run(dev, shape2(bands, rows),
                            &(band_emissivity_args){.sample_count = samples,
                                                    .band_count = s->band_count,
                                                    .bands = t->band_records,
                                                    .weights = t->band_weights,
                                                    .emissivity = t->spectra.emissivity,
                                                    .band_emissivity = t->band_emissivity}));
out:
    return rc;
}

status render_tables_take_spectra(render_tables *t, device *dev, const scene *s,
                                  const media *through)
{
    status rc = STATUS_OK;
    float *emissivity_rows = NULL;

    TRY(spectra_build(&t->bands, s->bands, s->band_count, s->air, scene_quadrature(s), s->thesis));
    TRY(device_allocate(dev, &t->spectra.rows, (size_t)t->bands->row_count * t->bands->sample_count,
                        t->bands->rows));
    TRY(device_allocate(dev, &t->band_records, s->band_count, t->bands->bands));
    TRY(device_allocate(dev, &t->band_weights, t->bands->weight_count, t->bands->weight_um));
    TRY(sample_emissivity(&emissivity_rows, s, t->bands));
    TRY(upload_emissivity(&t->spectra.emissivity, dev, s, emissivity_rows, t->bands));
    if (!s->thesis) TRY(take_knots(t, dev, s, through, emissivity_rows));
    if (through)
        TRY(media_sample(through, t->bands->wavenumber_cm1, t->bands->sample_count,
                         &t->spectra.extinction));
    TRY(tabulate_bands(t, dev, s));
out:
    free(emissivity_rows);
    return rc;
}

void render_tables_free(render_tables *t)
{
    free(t->reflectance);
    device_release(t->spectra.knot_fraction);
    device_release(t->spectra.knot_first);
    device_release(t->knot_spectra.emissivity);
    device_release(t->knot_spectra.rows);
    spectral_grid_free(t->knots);
    device_release(t->blocks.tables.emissivity);
    device_release(t->blocks.tables.rows);
    device_release(t->ln_radiance);
    device_release(t->band_emissivity);
    device_release(t->band_weights);
    device_release(t->band_records);
    device_release(t->spectra.extinction);
    device_release(t->spectra.emissivity);
    device_release(t->spectra.rows);
    spectra_free(t->bands);
    device_release(t->materials);
    device_release(t->facet_ids);
    device_release(t->facets);
    free(t->facet);
}
