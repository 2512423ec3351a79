/* Cloud: what a transmissive body sends towards whoever looks through it. Where its material
 * scatters, the exact counterpart of [1 - tau2c] B(T) in eq. 2.4-1: a two-stream solution for sun,
 * sky, ground and its own emission in a level layer. assumed: it is as thick as the body is straight
 * up through the middle of the way in it, and lit as the ground is.
 *
 * Two streams after Zdunkowski et al. 1980 (Contrib. Atmos. Phys. 53, 147), whose coefficients are
 * Eddington's where nothing is absorbed and absorb alone where nothing is scattered; forward peak of
 * g^2 as in delta-Eddington (Joseph et al. 1976, J. Atmos. Sci. 33, 2452); solved as in Meador and
 * Weaver 1980 (J. Atmos. Sci. 37, 630), with hyperbolic functions in place of exponentials, so that
 * albedo 1 is no special case. */
#ifndef CLOUD_H
#define CLOUD_H

#include "kernels/media/transmission.h"
#include "kernels/tables.h"

/* First rows of the table of bodies, of sample_count floats each: of every material its extinction
 * per m, its single-scattering albedo and its asymmetry; and what clouds see below them. */
#define CLOUD_ALBEDO TRANSMISSION_MEDIA
#define CLOUD_ASYMMETRY (2u * TRANSMISSION_MEDIA)
#define CLOUD_GROUND (3u * TRANSMISSION_MEDIA) /* W m-2 sr-1 um-1, see cloud_ground.cl */

/* Fluxes of a level layer, of what arrives: diffuse light, and the sun on a level plane. */
typedef struct cloud_layer {
    spectrum diffuse_back, diffuse_through; /* the latter with what was not scattered */
    spectrum sun_back, sun_through;         /* sun_through without what exp(-depth / sun_up) lets */
} cloud_layer;

/* What lights a layer: E_S tau1; radiance from above and from below, the same from all sides. */
typedef struct cloud_light {
    spectrum sun, sky, ground;
} cloud_light;

#define CLOUD_LEAST_DEPTH 1e-3f /* below, sources do not change any more */
#define CLOUD_MOST_PATHS 30.0f  /* beyond, nothing is left */

/* The two streams in a layer that is scaled by its forward peak. */
typedef struct cloud_streams {
    spectrum depth, albedo, asymmetry; /* scaled */
    spectrum first, second;            /* coefficients */
    spectrum eigenvalue, even, odd;    /* of them; solutions cosh, and sinh over the eigenvalue */
} cloud_streams;

static inline cloud_streams cloud_streams_of(spectrum depth, spectrum albedo, spectrum asymmetry)
{
    const spectrum peak = asymmetry * asymmetry, kept = 1.0f - albedo * peak;
    const spectrum absorbed = 2.0f * (1.0f - albedo) / kept;
    cloud_streams s;

    s.depth = depth * kept;
    s.albedo = albedo * (1.0f - peak) / kept;
    s.asymmetry = asymmetry / (1.0f + asymmetry);
    s.second = 0.75f * s.albedo * (1.0f - s.asymmetry);
    s.first = s.second + absorbed;
    s.eigenvalue = fmax(sqrt(absorbed * (s.first + s.second)), (spectrum)1e-6f);
    const spectrum paths = fmin(s.eigenvalue * s.depth, (spectrum)CLOUD_MOST_PATHS);
    s.even = cosh(paths);
    s.odd = sinh(paths) / s.eigenvalue;
    return s;
}

/* The sun's part of a layer.
 *   sun_up   cosine of the sun's zenith angle, above 0 */
static inline void cloud_add_sun(cloud_layer *layer, const cloud_streams *s, float sun_up)
{
    /* Where the sun's own path is the eigenvalue's the formula is 0 / 0: look a little beside. */
    const spectrum near = fabs(s->eigenvalue * sun_up - 1.0f);
    const spectrum mu = near < (spectrum)1e-3f ? 0.999f / s->eigenvalue : (spectrum)sun_up;
    const spectrum back = 0.25f * (2.0f - 3.0f * s->asymmetry * mu), on = 1.0f - back;
    const spectrum with_on = s->first * on + s->second * back;
    const spectrum with_back = s->first * back + s->second * on;
    const spectrum square = s->eigenvalue * s->eigenvalue * mu, left = exp(-s->depth / mu);
    const spectrum factor = s->albedo * layer->diffuse_through / (1.0f - square * mu);

    layer->sun_back = factor * ((with_back - square * back) * s->odd +
                                (back - mu * with_back) * (s->even - left));
    layer->sun_through = factor * ((on + with_on * mu) * (1.0f - left * s->even) -
                                   left * (with_on + square * on) * s->odd) +
                         exp(-s->depth / sun_up);
}

/* Solves a layer.
 *   depth    vertical optical thickness
 *   sun_up   cosine of the sun's zenith angle; 0 or less: no sun */
static inline cloud_layer cloud_solve(spectrum depth, spectrum albedo, spectrum asymmetry,
                                      float sun_up)
{
    const cloud_streams s = cloud_streams_of(depth, albedo, asymmetry);
    cloud_layer layer;

    layer.diffuse_through = 1.0f / (s.even + s.first * s.odd);
    layer.diffuse_back = s.second * s.odd * layer.diffuse_through;
    layer.sun_back = layer.sun_through = (spectrum)0.0f;
    if (sun_up > 0.0f) {
        cloud_add_sun(&layer, &s, sun_up);
        layer.sun_through -= exp(-depth / sun_up);
    }
    return layer;
}

/* The mean source J of a layer seen from above or from below: with it L tau + (1 - tau) J is, over
 * all directions of view, the radiance that leaves the layer.
 *   depth        vertical optical thickness
 *   black_body   of the layer's temperature */
static inline spectrum cloud_source(spectrum depth, spectrum albedo, spectrum asymmetry,
                                    spectrum black_body, cloud_light light, float sun_up,
                                    uint from_above)
{
    const spectrum thick = fmax(depth, (spectrum)CLOUD_LEAST_DEPTH);
    const cloud_layer layer = cloud_solve(thick, albedo, asymmetry, sun_up);
    const spectrum unscattered = exp(-2.0f * thick); /* of diffuse light */
    const spectrum behind = from_above ? light.ground : light.sky;
    const spectrum before = from_above ? light.sky : light.ground;
    const spectrum sun = from_above ? layer.sun_back : layer.sun_through;
    const spectrum sent = (layer.diffuse_through - unscattered) * behind +
                          layer.diffuse_back * before +
                          (1.0f - layer.diffuse_back - layer.diffuse_through) * black_body +
                          sun * light.sun * (fmax(sun_up, 0.0f) / PI_F);

    return sent / (1.0f - unscattered);
}

#ifdef __OPENCL_C_VERSION__

/* What the i-th material on a way sends for every share of light that it takes. */
static inline spectrum cloud_of_way(const spectra_tables *t, radiometry_record frame,
                                    const transmission_path *path, uint i, uint from_above,
                                    uint block)
{
    global const float *rows = t->rows, *extinction = t->extinction;
    const uint row = frame.sample_count;
    const size_t medium = (size_t)path->medium[i] * row;
    const spectrum black_body = planck_radiance(
        spectrum_load(rows + SPECTRA_PLANCK_FIRST * row, block),
        spectrum_load(rows + SPECTRA_PLANCK_SECOND * row, block), path->temperature_k[i]);

    if (!(path->vertical_m[i] > 0.0f)) return black_body;
    const cloud_light light = {spectrum_load(rows + SPECTRA_SUN * row, block),
                               spectrum_load(rows + SPECTRA_SKY * row, block),
                               spectrum_load(extinction + (size_t)CLOUD_GROUND * row, block)};
    return cloud_source(path->vertical_m[i] * spectrum_load(extinction + medium, block),
                        spectrum_load(extinction + (size_t)CLOUD_ALBEDO * row + medium, block),
                        spectrum_load(extinction + (size_t)CLOUD_ASYMMETRY * row + medium, block),
                        black_body, light, frame.sun[2], from_above);
}

/* What comes through all bodies on a way, and from them; the nearest is the last that it meets. */
static inline spectrum cloud_seen(spectrum radiance, const spectra_tables *t,
                                  radiometry_record frame, const transmission_path *path,
                                  uint from_above, uint block)
{
    for (uint i = TRANSMISSION_MEDIA; i-- > 0;)
        if (path->length_m[i] > 0.0f)
            radiance = transmission_through(
                radiance, transmission_part(t->extinction, frame.sample_count, path, i, block),
                cloud_of_way(t, frame, path, i, from_above, block));
    return radiance;
}

#endif

#endif
