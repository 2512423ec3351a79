#include "band_plane.h"
#include "band_temperature.h"

/* What a band's planes are made from, of one group of pixels. */
typedef struct band_source {
    global const float *weights;    /* of the band */
    global const float *terms;      /* shape (band_plane_terms, sample_count, PIXEL_GROUP) */
    global const float *emissivity; /* of the band: one every band_count */
    global const emissivity_record *emissivities; /* shape (pixels, 2) */
    global const float *ln_radiance;
} band_source;

/* Integral of one spectrum over a band, eq. 2.4-3. Sums of few samples are summed: nothing is lost
 * where there are hundreds. */
static lanes integrate(band_source from, radiometry_record frame, band_record band, uint term)
{
    global const float *sample =
        from.terms + ((size_t)term * frame.sample_count + band.first_sample) * PIXEL_GROUP;
    lanes sum = (lanes)0.0f;

    for (uint first = 0; first < band.sample_count; first += SPECTRA_BLOCK) {
        const uint end = min(first + SPECTRA_BLOCK, band.sample_count);
        lanes some = (lanes)0.0f;
        for (uint i = first; i < end; i++)
            some = fma((lanes)from.weights[i], vload16(i, sample), some);
        sum += some;
    }
    return sum;
}

static lanes apparent_celsius(global const float *ln_radiance, lanes radiance)
{
    const lanes kelvin = band_temperature_find(ln_radiance, radiance);

    return kelvin > 0.0f ? kelvin - ZERO_CELSIUS_K : (lanes)NO_VALUE;
}

/* Mean emissivities of a group over a band.
 *   which   0: of the targets, 1: of their backgrounds */
static lanes mean_emissivity(band_source from, radiometry_record frame, uint which, uint count)
{
    lanes out = (lanes)NO_VALUE;

    for (uint i = 0; i < count; i++) {
        const emissivity_record at = from.emissivities[2u * i + which];
        if (at.low == RECORD_NONE) continue;
        const float low = from.emissivity[(size_t)at.low * frame.band_count];
        const float high = from.emissivity[(size_t)at.high * frame.band_count];
        LANES_SET(out, i, low + (high - low) * at.share);
    }
    return out;
}

/* Writes the planes of one band and group.
 *   out   shape (band_plane_count, row), of this band, from the group's pixels on */
static void write_planes(band_source from, radiometry_record frame, band_record band, uint count,
                         uint row, global float *out)
{
    const float per_um = 1.0f / band.width_um, scale = band.is_mean ? per_um : 1.0f;
    const lanes radiance = integrate(from, frame, band, band_plane_terms(frame.wants) - 1u);

    for (uint k = 0; k < BAND_PLANES; k++) {
        lanes value = radiance * scale;
        if (!(frame.wants >> k & 1u)) continue;
        if (k == BAND_COUNTS)
            value = band.gain * radiance + band.offset;
        else if (k == BAND_APPARENT)
            value = apparent_celsius(from.ln_radiance, radiance);
        else if (k == BAND_EMISSIVITY || k == BAND_BACKGROUND_EMISSIVITY)
            value = mean_emissivity(from, frame, k - BAND_EMISSIVITY, count);
        else if (k >= BAND_PARTS)
            value =
                integrate(from, frame, band, k - BAND_PARTS) * (k == BAND_TAU2 ? per_um : scale);
        vstore16(value, 0, out);
        out += row;
    }
}

/* Planes of the bands from the spectra of groups of neighbouring pixels, eq. 2.4-3.
 * Launch: (groups of PIXEL_GROUP pixels), from frame.first_group on.
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
    const uint group = get_global_id(0), first = (frame.first_group + group) * PIXEL_GROUP;
    if (first >= frame.pixel_count) return;

    const uint count = min(PIXEL_GROUP, frame.pixel_count - first);
    const uint row = band_plane_row(frame.pixel_count);
    const size_t band_length = (size_t)band_plane_count(frame.wants) * row;
    band_source from = {.emissivities = emissivities + 2u * first};

    from.terms =
        terms + (size_t)group * band_plane_terms(frame.wants) * frame.sample_count * PIXEL_GROUP;
    for (uint b = 0; b < frame.band_count; b++) {
        const band_record band = bands[b];
        from.weights = weights + band.first_weight;
        from.emissivity = band_emissivity + b;
        from.ln_radiance = ln_radiance + (size_t)b * BAND_TEMPERATURES;
        write_planes(from, frame, band, count, row, planes + first + b * band_length);
    }
}
