#include "kernels/band_plane.h"
#include "kernels/sensor/band_temperature.h"

/* Lanes from one sample of a group of pixels to the next. */
#define PIXEL_STEP (PIXEL_GROUP / LANES_WIDTH)

/* What the planes of LANES_WIDTH neighbouring pixels are made from. */
typedef struct band_source {
    global const band_record *band;
    global const float *weights; /* of the band */
    global const lanes
        *terms; /* of the lanes, shape (band_plane_terms, sample_count) by PIXEL_STEP */
    uint sample_count;
    global const float *emissivity; /* of the band, one every band_count */
    uint band_count;
    global const emissivity_record *emissivities; /* shape (count, 2) */
    uint count;                                   /* of pixels */
    global const float *ln_radiance;              /* of the band */
} band_source;

/* Integral of one spectrum over a band, eq. 2.4-3. Sums of few samples are summed: nothing is lost
 * where there are hundreds. */
static lanes integrate(const band_source *from, uint term)
{
    const uint count = from->band->sample_count;
    const size_t first = (size_t)term * from->sample_count + from->band->first_sample;
    global const lanes *sample = from->terms + first * PIXEL_STEP;
    global const float *weight = from->weights;
    lanes sum = (lanes)0.0f;

    for (uint i = 0; i < count;) {
        const uint end = min(i + SPECTRA_BLOCK, count);
        lanes some = (lanes)0.0f;
        for (; i < end; i++) some = fma((lanes)weight[i], sample[i * PIXEL_STEP], some);
        sum += some;
    }
    return sum;
}

static lanes apparent_celsius(global const float *ln_radiance, lanes radiance)
{
    const lanes kelvin = band_temperature_find(ln_radiance, radiance);

    return kelvin > 0.0f ? kelvin - ZERO_CELSIUS_K : (lanes)NO_VALUE;
}

/* Mean emissivities over a band.
 *   which   0: of the targets, 1: of their backgrounds */
static lanes mean_emissivity(const band_source *from, uint which)
{
    lanes out = (lanes)NO_VALUE;

    for (uint i = 0; i < from->count; i++) {
        const emissivity_record at = from->emissivities[2u * i + which];
        if (at.low == RECORD_NONE) continue;
        const float low = from->emissivity[(size_t)at.low * from->band_count];
        const float high = from->emissivity[(size_t)at.high * from->band_count];
        LANES_SET(out, i, low + (high - low) * at.fraction);
    }
    return out;
}

/* One plane of a band, other than the radiance.
 *   radiance   in band */
static lanes plane_of(const band_source *from, uint plane, lanes radiance)
{
    const float per_um = 1.0f / from->band->width_um;

    if (plane == BAND_COUNTS) return from->band->gain * radiance + from->band->offset;
    if (plane == BAND_APPARENT) return apparent_celsius(from->ln_radiance, radiance);
    if (plane < BAND_PARTS) return mean_emissivity(from, plane - BAND_EMISSIVITY);
    return integrate(from, plane - BAND_PARTS) *
           (plane == BAND_TAU2 || from->band->is_mean ? per_um : 1.0f);
}

/* Writes a plane's pixels past the caches: nobody reads them before many others are written. */
static void write_past(const lanes values, global lanes *out)
{
#if defined(__AVX__) && !defined(RAY_PORTABLE)
    __builtin_nontemporal_store(values, out);
#else
    *out = values;
#endif
}

/* Planes of the bands from the spectra of groups of neighbouring pixels, eq. 2.4-3.
 * Launch: (groups of PIXEL_GROUP pixels; one pixel of these where LANES_WIDTH is 1), from frame.first_group on.
 * bands: band_record; weights: of each its samples', um
 * band_emissivity: shape (rows, band_count), see band_emissivity.cl
 * ln_radiance: shape (band_count, BAND_TEMPERATURES)
 * emissivities, terms: see radiometry.cl
 * planes: those of frame.wants, see band_plane.h: radiance W m-2 sr-1 (or its mean per um), counts,
 *   apparent temperature C, mean emissivity, that of the background; what the radiance is the sum
 *   of, at the sensor, and mean tau2; NO_VALUE where there is none. No standard error */
kernel void band_planes(const radiometry_record frame, global const band_record *bands,
                        global const float *weights, global const float *band_emissivity,
                        global const float *ln_radiance,
                        global const emissivity_record *emissivities, global const float *terms,
                        global float *planes)
{
    const uint first = frame.first_group * PIXEL_GROUP + get_global_id(0) * LANES_WIDTH;
    if (first >= frame.pixel_count) return;

    const uint term_count = band_plane_terms(frame.wants);
    const uint row = band_plane_row(frame.pixel_count) / LANES_WIDTH;
    const uint group = first / PIXEL_GROUP - frame.first_group;
    band_source from = {.sample_count = frame.sample_count,
                        .band_count = frame.band_count,
                        .emissivities = emissivities + 2u * first,
                        .count = min((uint)LANES_WIDTH, frame.pixel_count - first)};
    global lanes *out = (global lanes *)planes + first / LANES_WIDTH;

    from.terms =
        (global const lanes *)(terms +
                               (size_t)group * term_count * frame.sample_count * PIXEL_GROUP +
                               first % PIXEL_GROUP);
    for (uint b = 0; b < frame.band_count; b++) {
        from.band = bands + b;
        from.weights = weights + bands[b].first_weight;
        from.emissivity = band_emissivity + b;
        from.ln_radiance = ln_radiance + (size_t)b * BAND_TEMPERATURES;
        const lanes radiance = integrate(&from, term_count - 1u);
        write_past(bands[b].is_mean ? radiance / bands[b].width_um : radiance, out);
        out += row;
        for (uint k = 1; frame.wants >> k; k++) {
            if (!(frame.wants >> k & 1u)) continue;
            write_past(plane_of(&from, k, radiance), out);
            out += row;
        }
    }
}
