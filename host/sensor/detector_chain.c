#include "sensor/detector_chain.h"

#include "launches.h"

#include "kernels/records.h"
#include "sky/planck.h"

#include <math.h>
#include <stdlib.h>

struct detector_chain {
    device *dev;
    const detector_settings *how;
    uint32_t picture_columns, picture_rows;
    float_buffer picture, detectors;
};

uint32_t detector_chain_columns(const detector_chain *d)
{
    return d->picture_columns / (uint32_t)d->how->step;
}

uint32_t detector_chain_rows(const detector_chain *d)
{
    return d->picture_rows / (uint32_t)d->how->step;
}

status detector_chain_open(detector_chain **out, device *dev, const detector_settings *how,
                           uint32_t columns, uint32_t rows)
{
    status rc = STATUS_OK;
    detector_chain *d = calloc(1, sizeof *d);

    NEED(d, STATUS_MEMORY, "no memory for the sensor");
    *d = (detector_chain){.dev = dev, .how = how, .picture_columns = columns, .picture_rows = rows};
    TRY(device_allocate(dev, &d->picture, (size_t)columns * rows, NULL));
    TRY(device_allocate(dev, &d->detectors,
                        (size_t)detector_chain_columns(d) * detector_chain_rows(d), NULL));
    *out = d;
    d = NULL;
out:
    detector_chain_free(d);
    return rc;
}

void detector_chain_free(detector_chain *d)
{
    if (!d) return;
    device_release(d->detectors);
    device_release(d->picture);
    free(d);
}

static status build_psf(psf **out, const detector_settings *how, double wavelength_um)
{
    status rc = STATUS_OK;
    psf *p = NULL;

    TRY(psf_detector(&p, how->step));
    if (how->gaussian_fwhm_px > 0.0) TRY(psf_add_gaussian(p, how->gaussian_fwhm_px));
    if (how->box_px > 0.0) TRY(psf_add_box(p, how->box_px));
    if (how->motion_px > 0.0) TRY(psf_add_motion(p, how->motion_px, how->motion_deg));
    if (how->airy_f_number > 0.0)
        TRY(psf_add_airy(p, wavelength_um * how->airy_f_number / how->pixel_pitch_um));
    if (how->table) TRY(psf_add(p, how->table));
    *out = p;
    p = NULL;
out:
    psf_free(p);
    return rc;
}

static status run_blur(const detector_chain *d, const psf *p)
{
    status rc = STATUS_OK;
    const size_t count = (size_t)p->columns * (size_t)p->rows;
    float *weight = malloc(count * sizeof *weight);
    float_buffer weights = {0};
    const blur_record record = {.columns = detector_chain_columns(d),
                                .rows = detector_chain_rows(d),
                                .step = (uint32_t)d->how->step,
                                .picture_columns = d->picture_columns,
                                .picture_rows = d->picture_rows,
                                .weight_columns = (uint32_t)p->columns,
                                .weight_rows = (uint32_t)p->rows,
                                .first_column = p->first_column,
                                .first_row = p->first_row};

    NEED(weight, STATUS_MEMORY, "no memory for a point spread function");
    for (size_t i = 0; i < count; i++) weight[i] = (float)p->weight[i];
    TRY(device_allocate(d->dev, &weights, count, weight));
    TRY(blur_run(
        d->dev, shape2(record.columns, record.rows),
        &(blur_args){
            .record = record, .weight = weights, .picture = d->picture, .out = d->detectors}));
out:
    device_release(weights);
    free(weight);
    return rc;
}

static double band_radiance(const band_samples *s, double temperature_k, bool thesis)
{
    double sum = 0.0;

    for (int i = 0; i < s->count; i++)
        sum += s->weight_um[i] *
               planck_spectral(planck_at(1e4 / s->wavenumber_cm1[i], thesis), temperature_k);
    return sum;
}

/* Standard deviation of the noise that does not depend on the radiance, W m-2 sr-1 in band. */
static double steady_noise(const detector_settings *how, const band_samples *s, bool thesis)
{
    const double half_k = 0.01; /* errs by 1e-9 */
    const double slope = (band_radiance(s, how->netd_at_k + half_k, thesis) -
                          band_radiance(s, how->netd_at_k - half_k, thesis)) /
                         (2.0 * half_k);
    const double read = how->electrons > 0.0 ? how->read_electrons / how->electrons : 0.0;

    return hypot(hypot(how->netd_k * slope, how->nesr * s->width_um), read);
}

/* The same whichever other bands there are (Fowler, Noll and Vo's hash,
 * FNV-1a): the noise of an image depends on it. */
static uint32_t key_of(const char *name)
{
    uint32_t key = 2166136261u;

    for (; *name; name++) key = (key ^ (unsigned char)*name) * 16777619u;
    return key;
}

/* All in the unit of the plane: radiance in band over `unit`. */
static detector_record record_of(const detector_chain *d, const band *b, const band_samples *s,
                                 bool thesis)
{
    const detector_settings *how = d->how;
    const double unit = b->is_mean ? s->width_um : 1.0;
    const double angle = how->periodic_deg * M_PI / 180.0;
    const double waves = how->periodic > 0.0 ? how->step / how->periodic_px : 0.0;

    return (detector_record){
        .seed = how->seed,
        .frame = how->frame,
        .band = key_of(b->name),
        .columns = detector_chain_columns(d),
        .count = detector_chain_columns(d) * detector_chain_rows(d),
        .last_count = how->bits > 0 ? (1u << how->bits) - 1u : 0u,
        .noise = (float)(steady_noise(how, s, thesis) / unit),
        .shot = (float)(how->electrons > 0.0 ? 1.0 / how->electrons / unit : 0.0),
        .fixed_gain = (float)how->fixed_gain,
        .fixed_offset = (float)(how->fixed_offset * s->width_um / unit),
        .periodic = (float)(how->periodic * s->width_um / unit),
        .waves_across = (float)(waves * cos(angle)),
        .waves_down = (float)(-waves * sin(angle)),
        .gain = (float)(b->gain * unit),
        .offset = (float)b->offset,
    };
}

status detector_chain_band(detector_chain *d, const band *b, const atmosphere *air,
                           band_quadrature rule, const float *radiance, float *out)
{
    status rc = STATUS_OK;
    const size_t pixels = (size_t)d->picture_columns * d->picture_rows;
    band_samples samples = {0};
    psf *p = NULL;

    TRY(band_sample(&samples, b, air, rule));
    TRY(build_psf(&p, d->how, samples.centre_um));
    TRY(device_upload(d->dev, d->picture, pixels, radiance));
    TRY(run_blur(d, p));
    const detector_record record = record_of(d, b, &samples, rule == BAND_DATABASE_POINTS);
    TRY(detector_run(
        d->dev, shape1(record.count),
        &(detector_args){.record = record, .radiance = d->detectors, .out = d->detectors}));
    TRY(device_download(d->dev, d->detectors, record.count, out));
out:
    psf_free(p);
    band_samples_free(&samples);
    return rc;
}
