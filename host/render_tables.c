#include "render_tables.h"

#include "lobe.h"

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
    TRY(device_allocate(dev, &t->facets, t->facet_count * sizeof *t->facet, t->facet));
    TRY(device_allocate(dev, &t->facet_ids, t->facet_count * sizeof *ids, ids));
    TRY(device_allocate(dev, &t->materials, s->material_count * sizeof *materials, materials));
out:
    free(ids);
    free(materials);
    return rc;
}

/* The emissivity of all materials on the samples of the bands, and their diffuse lobes. */
static status upload_emissivity(render_tables *t, device *dev, const scene *s)
{
    status rc = STATUS_OK;
    const size_t samples = t->bands->sample_count;
    const size_t bytes = (size_t)scene_emissivity_rows(s) * samples * sizeof(float);
    float *rows = malloc(bytes + 1);

    NEED(rows, STATUS_MEMORY, "no memory for the emissivity of %u materials", s->material_count);
    for (uint32_t i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->materials[i];
        float *first = rows + (size_t)m->record.emissivity_first * samples;
        if (m->table)
            spectra_sample_emissivity(t->bands, m->table, first);
        else
            for (size_t k = 0; k < samples; k++) first[k] = (float)m->grey_emissivity;
        if (m->record.lobe_first != RECORD_NONE)
            lobe_fill(first, t->bands->sample_count, scene_lobe_rings(s),
                      rows + (size_t)m->record.lobe_first * samples);
    }
    TRY(device_allocate(dev, &t->emissivity_rows, bytes, rows));
out:
    free(rows);
    return rc;
}

status render_tables_take_spectra(render_tables *t, device *dev, const scene *s,
                                  const bodies *through)
{
    status rc = STATUS_OK;

    TRY(spectra_build(&t->bands, s->bands, s->band_count, s->air, scene_sums_points(s), s->thesis));
    TRY(device_allocate(dev, &t->spectrum_rows,
                        (size_t)t->bands->row_count * t->bands->sample_count * sizeof(float),
                        t->bands->rows));
    TRY(device_allocate(dev, &t->band_records, s->band_count * sizeof(band_record),
                        t->bands->bands));
    TRY(device_allocate(dev, &t->ln_radiance,
                        (size_t)s->band_count * BAND_TEMPERATURES * sizeof(float), NULL));
    TRY(upload_emissivity(t, dev, s));
    if (through)
        TRY(bodies_sample(through, t->bands->wavenumber_cm1, t->bands->sample_count,
                          &t->extinction_rows));
    TRY(device_run(dev, "band_temperature", shape2(BAND_TEMPERATURES, s->band_count),
                   ARG(t->bands->sample_count), ARG(t->spectrum_rows), ARG(t->band_records),
                   ARG(t->ln_radiance)));
out:
    return rc;
}

void render_tables_free(render_tables *t)
{
    device_release(t->ln_radiance);
    device_release(t->band_records);
    device_release(t->extinction_rows);
    device_release(t->emissivity_rows);
    device_release(t->spectrum_rows);
    spectra_free(t->bands);
    device_release(t->materials);
    device_release(t->facet_ids);
    device_release(t->facets);
    free(t->facet);
}
