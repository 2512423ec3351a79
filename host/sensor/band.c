#include "sensor/band.h"

#include "sky/planck.h"

#include <math.h>
#include <stdlib.h>

double band_look_up(const atmosphere *air, const double *value, double wavenumber_cm1)
{
    const int last = air->point_count - 1;
    const double place = (air->wavenumber_cm1[0] - wavenumber_cm1) / air->wavenumber_step_cm1;

    if (place <= 0.0) return value[0];
    if (place >= last) return value[last];
    const int low = (int)place;
    return value[low] + (place - low) * (value[low + 1] - value[low]);
}

static double responds(const band *b, const atmosphere *air, double wavenumber_cm1)
{
    if (b->tabulated) return response_at(b->tabulated, 1e4 / wavenumber_cm1);
    return b->sensor ? band_look_up(air, b->sensor->response, wavenumber_cm1) : 1.0;
}

static status find_range(const band *b, const atmosphere *air, double *out_high, double *out_low)
{
    status rc = STATUS_OK;
    const double most = air->wavenumber_cm1[0], least = air->wavenumber_cm1[air->point_count - 1];
    const double slack = 1e-6 * most;

    *out_high = b->sensor ? most : 1e4 / b->low_um;
    *out_low = b->sensor ? least : 1e4 / b->high_um;
    NEED(!b->sensor || b->sensor->count == air->point_count, STATUS_ARGUMENT,
         "band %s: the sensor file has %d responses, the radiance database %d points", b->name,
         b->sensor->count, air->point_count);
    NEED(*out_high <= most + slack && *out_low >= least - slack, STATUS_ARGUMENT,
         "band %s: %.4g to %.4g um is not within the radiance database, %.4g to %.4g um", b->name,
         1e4 / *out_high, 1e4 / *out_low, 1e4 / most, 1e4 / least);
out:
    return rc;
}

/* Adds samples from the last one down to `to`, close enough; without room, counts. */
static void add_segment(band_samples *out, double from, double to, band_quadrature rule)
{
    const int steps = rule == BAND_FINE ? (int)ceil((from - to) / planck_step_cm1(to) - 1e-9) : 1;

    for (int i = 1; i <= steps; i++, out->count++)
        if (out->wavenumber_cm1) out->wavenumber_cm1[out->count] = from + (to - from) * i / steps;
}

/* Lists where samples are whatever their steps, from the longest wavenumber down: points of the database and,
 * where samples are fine, the band's own, neither at an edge then.
 *   out   shape (air->point_count + b->point_count); returns how many there are */
static size_t list_stops(double *out, const band *b, const atmosphere *air, double high, double low,
                         band_quadrature rule)
{
    const double nearly = 1e-6 * high, inset = rule == BAND_FINE ? nearly : -nearly;
    const size_t own_count = rule == BAND_FINE ? b->point_count : 0;
    size_t count = 0, own = 0;

    for (int i = 0; i <= air->point_count; i++) {
        const bool ended = i == air->point_count;
        const double point = ended ? low : air->wavenumber_cm1[i];
        for (; own < own_count && b->point_cm1[own] > point + nearly; own++) {
            const double last = count > 0 ? out[count - 1] : high;
            if (b->point_cm1[own] < fmin(last, high) - nearly && b->point_cm1[own] > low + nearly)
                out[count++] = b->point_cm1[own];
        }
        if (!ended && point <= high - inset && point >= low + inset) out[count++] = point;
    }
    return count;
}

/* Without room for them counts the samples. */
static void lay_samples(band_samples *out, const double *stop, size_t stop_count, double high,
                        double low, band_quadrature rule)
{
    double from = high;
    size_t first = 0;

    out->count = 0;
    if (rule == BAND_DATABASE_POINTS) {
        if (stop_count == 0) return;
        from = stop[first++];
    }
    if (out->wavenumber_cm1) out->wavenumber_cm1[0] = from;
    out->count = 1;
    for (size_t i = first; i < stop_count; i++) {
        add_segment(out, from, stop[i], rule);
        from = stop[i];
    }
    if (rule == BAND_FINE) add_segment(out, from, low, rule);
}

/* What sample i counts: the trapezoid rule, or the integral of the response times the roof that is 1
 * at the sample and 0 at its neighbours. */
static double weight_of(const band_samples *s, int i, const band *b, const atmosphere *air,
                        band_quadrature rule)
{
    const double at = 1e4 / s->wavenumber_cm1[i];
    const double before = 1e4 / s->wavenumber_cm1[i > 0 ? i - 1 : i];
    const double after = 1e4 / s->wavenumber_cm1[i + 1 < s->count ? i + 1 : i];

    if (rule == BAND_DATABASE_POINTS || !b->tabulated)
        return .5 * (after - before) * responds(b, air, s->wavenumber_cm1[i]);
    return (before < at ? response_integral(b->tabulated, at, before) : 0.0) +
           (after > at ? response_integral(b->tabulated, at, after) : 0.0);
}

static void weigh(band_samples *out, const band *b, const atmosphere *air, band_quadrature rule)
{
    const double *nu = out->wavenumber_cm1;
    double moment = 0.0;

    out->width_um = 0.0;
    for (int i = 0; i < out->count; i++) {
        out->weight_um[i] = weight_of(out, i, b, air, rule);
        out->width_um += out->weight_um[i];
        moment += out->weight_um[i] * 1e4 / nu[i];
    }
    out->centre_um = moment / out->width_um;
}

status band_sample(band_samples *out, const band *b, const atmosphere *air, band_quadrature rule)
{
    status rc = STATUS_OK;
    band_samples samples = {0};
    double high, low;
    double *stop = malloc(((size_t)air->point_count + b->point_count + 1) * sizeof *stop);

    NEED(stop, STATUS_MEMORY, "no memory for a band");
    TRY(find_range(b, air, &high, &low));
    const size_t stop_count = list_stops(stop, b, air, high, low, rule);
    lay_samples(&samples, stop, stop_count, high, low, rule);
    NEED(samples.count >= 2, STATUS_ARGUMENT,
         "band %s: %d points of the radiance database lie in it, expected 2 or more", b->name,
         samples.count);
    samples.wavenumber_cm1 = malloc((size_t)samples.count * sizeof(double));
    samples.weight_um = malloc((size_t)samples.count * sizeof(double));
    NEED(samples.wavenumber_cm1 && samples.weight_um, STATUS_MEMORY, "no memory for a band");
    lay_samples(&samples, stop, stop_count, high, low, rule);
    weigh(&samples, b, air, rule);
    NEED(samples.width_um > 0.0, STATUS_ARGUMENT, "band %s: its response is 0 everywhere", b->name);
    *out = samples;
    samples = (band_samples){0};
out:
    free(stop);
    band_samples_free(&samples);
    return rc;
}

void band_free(band *b)
{
    free(b->name);
    response_free(b->tabulated);
    response_file_free(b->sensor);
    free(b->point_cm1);
}

void band_samples_free(band_samples *samples)
{
    free(samples->wavenumber_cm1);
    free(samples->weight_um);
    *samples = (band_samples){0};
}
