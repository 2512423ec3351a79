#include "sensor/detector_chain.h"

#include "launches.h"

#include "kernels/records.h"
#include "sky/planck.h"

#include <math.h>
#include <stdlib.h>

/* What rows of the picture, and of the detectors, take on the device at most. */
enum { STRIP_BYTES = 1 << 25 };

static const double weight_s = 1e-9; /* of one weight of a detector, on one core */

struct detector_chain {
    device *dev;
    const detector_settings *how;
    uint32_t picture_columns, picture_rows;
    psf *steady; /* what is the same in all bands: all parts up to diffraction, or all */
};

uint32_t detector_chain_columns(const detector_chain *d)
{
    return d->picture_columns / (uint32_t)d->how->step;
}

uint32_t detector_chain_rows(const detector_chain *d)
{
    return d->picture_rows / (uint32_t)d->how->step;
}

static status build_steady(psf **out, const detector_settings *how)
{
    status rc = STATUS_OK;
    psf *p = NULL;

    TRY(psf_detector(&p, how->step));
    if (how->gaussian_fwhm_px > 0.0) TRY(psf_add_gaussian(p, how->gaussian_fwhm_px));
    if (how->box_px > 0.0) TRY(psf_add_box(p, how->box_px));
    if (how->motion_px > 0.0) TRY(psf_add_motion(p, how->motion_px, how->motion_deg));
    if (how->table && !(how->airy_f_number > 0.0)) TRY(psf_add(p, how->table));
    *out = p;
    p = NULL;
out:
    psf_free(p);
    return rc;
}

status detector_chain_open(detector_chain **out, device *dev, const detector_settings *how,
                           uint32_t columns, uint32_t rows)
{
    status rc = STATUS_OK;
    detector_chain *d = calloc(1, sizeof *d);

    NEED(d, STATUS_MEMORY, "no memory for the sensor");
    *d = (detector_chain){.dev = dev, .how = how, .picture_columns = columns, .picture_rows = rows};
    TRY(build_steady(&d->steady, how));
    *out = d;
    d = NULL;
out:
    detector_chain_free(d);
    return rc;
}

void detector_chain_free(detector_chain *d)
{
    if (!d) return;
    psf_free(d->steady);
    free(d);
}

/* The spread at a wavelength, of which diffraction is a part.
 *   out   the caller frees it */
static status spread_at(psf **out, const detector_chain *d, double wavelength_um)
{
    status rc = STATUS_OK;
    const detector_settings *how = d->how;
    psf *p = NULL;

    TRY(psf_copy(&p, d->steady));
    if (how->airy_f_number > 0.0) {
        TRY(psf_add_airy(p, wavelength_um * how->airy_f_number / how->pixel_pitch_um));
        if (how->table) TRY(psf_add(p, how->table));
    }
    *out = p;
    p = NULL;
out:
    psf_free(p);
    return rc;
}

/* A band on its way through the device, some rows of detectors at a time. */
typedef struct strips {
    blur_record blur;
    detector_record detector;
    uint32_t rows; /* of detectors, of all strips but the last */
    float_buffer weight, picture, detectors;
} strips;

static void strips_free(strips *s)
{
    device_release(s->detectors);
    device_release(s->picture);
    device_release(s->weight);
}

/* Rows of the picture that some rows of detectors look at. */
static size_t rows_seen(const strips *s, uint32_t rows)
{
    return (size_t)(rows - 1) * s->blur.step + s->blur.weight_rows;
}

static status strips_open(strips *s, const detector_chain *d, const psf *p)
{
    status rc = STATUS_OK;
    const size_t count = (size_t)p->columns * (size_t)p->rows;
    const size_t row_bytes = d->picture_columns * sizeof(float);
    const uint32_t all = detector_chain_rows(d);
    float *weight = malloc(count * sizeof *weight);

    NEED(weight, STATUS_MEMORY, "no memory for a point spread function");
    for (size_t i = 0; i < count; i++) weight[i] = (float)p->weight[i];
    s->blur = (blur_record){.columns = detector_chain_columns(d),
                            .step = (uint32_t)d->how->step,
                            .picture_columns = d->picture_columns,
                            .picture_rows = d->picture_rows,
                            .weight_columns = (uint32_t)p->columns,
                            .weight_rows = (uint32_t)p->rows,
                            .first_column = p->first_column,
                            .first_row = p->first_row};
    for (s->rows = all; s->rows > 1 && rows_seen(s, s->rows) * row_bytes > STRIP_BYTES;)
        s->rows = (s->rows + 1) / 2;
    TRY(device_allocate(d->dev, &s->weight, count, weight));
    TRY(device_allocate(d->dev, &s->picture, rows_seen(s, s->rows) * d->picture_columns, NULL));
    TRY(device_allocate(d->dev, &s->detectors, (size_t)s->rows * s->blur.columns, NULL));
out:
    free(weight);
    return rc;
}

static int clamp_row(const strips *s, int64_t row)
{
    const int64_t last = s->blur.picture_rows - 1;

    return (int)(row < 0 ? 0 : row > last ? last : row);
}

/* Degrades the rows of detectors first .. first + rows - 1. */
static status run_strip(strips *s, const detector_chain *d, uint32_t first, uint32_t rows,
                        const float *radiance, float *out)
{
    status rc = STATUS_OK;
    const uint32_t columns = s->blur.columns, count = columns * rows;
    const int64_t top = (int64_t)first * s->blur.step + s->blur.first_row;
    const int low = clamp_row(s, top);
    const int high = clamp_row(s, top + (int64_t)rows_seen(s, rows) - 1);
    device_shape shape = shape2(columns, rows);

    shape.item_s = weight_s * rows * s->blur.weight_columns * s->blur.weight_rows;
    s->blur.rows = rows;
    s->blur.first = first;
    s->blur.present = low;
    s->detector.count = count;
    s->detector.first = first * columns;
    TRY(device_upload(d->dev, s->picture, (size_t)(high - low + 1) * d->picture_columns,
                      radiance + (size_t)low * d->picture_columns));
    TRY(blur_run(
        d->dev, shape,
        &(blur_args){
            .record = s->blur, .weight = s->weight, .picture = s->picture, .out = s->detectors}));
    TRY(detector_run(
        d->dev, shape1(count),
        &(detector_args){.record = s->detector, .radiance = s->detectors, .out = s->detectors}));
    TRY(device_download(d->dev, s->detectors, count, out + (size_t)first * columns));
out:
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
    const uint32_t rows = detector_chain_rows(d);
    band_samples samples = {0};
    psf *p = NULL;
    strips s = {0};

    TRY(band_sample(&samples, b, air, rule));
    TRY(spread_at(&p, d, samples.centre_um));
    TRY(strips_open(&s, d, p));
    s.detector = record_of(d, b, &samples, rule == BAND_DATABASE_POINTS);
    for (uint32_t first = 0; first < rows; first += s.rows)
        TRY(run_strip(&s, d, first, rows - first < s.rows ? rows - first : s.rows, radiance, out));
out:
    strips_free(&s);
    psf_free(p);
    band_samples_free(&samples);
    return rc;
}
