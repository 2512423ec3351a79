/* Lobe: where a surface sends what it reflects, in exact mode. The counterpart of the one over pi of
 * eq. 2.4-1 and 2.4-2. Normals and directions are unit, in one frame. */
#ifndef LOBE_H
#define LOBE_H

#include "kernels/random.h"
#include "kernels/records.h"
#include "kernels/spectrum.h"

/* Rows of the diffuse lobe of a material whose emissivity changes with angle: 1 / (1 - e_hemi), then
 * one per ring of the hemisphere, see host/material/lobe.h. */
#define LOBE_ROWS 1u

/* The most such rings; a finer hemisphere's are joined. */
#define LOBE_RINGS 9u

/* Below this roughness a lobe is a mirror's. */
#define LOBE_SMOOTH 1e-4f

/* Rays that sample the specular lobe of a rough surface. */
#define LOBE_RAYS 32u

/* The diffuse lobe without its 1/pi and (1 - e) at the sensor's angle: (1 - e_i) / (1 - e_hemi). The
 * whole, (1 - e_i) (1 - e_o) / (pi (1 - e_hemi)), is reciprocal and conserves energy.
 *   arriving          emissivity at the angle that light comes from
 *   over_reflectance  1 / (1 - e_hemi); 0 for a black surface */
static inline spectrum lobe_diffuse(spectrum arriving, spectrum over_reflectance)
{
    return (1.0f - arriving) * over_reflectance;
}

static inline float lobe_dot(const float *a, const float *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A direction mirrored on the plane of a surface. */
static inline void lobe_turn(const float *normal, const float *from, float *out)
{
    const float up = lobe_dot(from, normal);

    for (int k = 0; k < 3; k++) out[k] = from[k] - 2.0f * up * normal[k];
}

/* The specular lobe, per sr over the whole sphere of directions: facets of random slope as Walter and
 * others have them (EGSR 2007: GGX), those that face the sensor alone, each a mirror. Integral 1.
 *   to_sensor, from   towards the sensor, and to where light comes from */
static inline float lobe_of_slopes(float roughness, const float *normal, const float *to_sensor,
                                   const float *from)
{
    const float a2 = roughness * roughness, seen = lobe_dot(normal, to_sensor);
    const float up = seen + lobe_dot(normal, from);
    float across = 0.0f;

    if (!(up > 0.0f)) return 0.0f;
    for (int k = 0; k < 3; k++) {
        const float level = to_sensor[k] + from[k] - up * normal[k];
        across += level * level;
    }
    const float spread = (across + a2 * up * up) / (across + up * up);
    return a2 / (PI_F * spread * spread) / (2.0f * (seen + sqrt(a2 + (1.0f - a2) * seen * seen)));
}

/* The specular lobe, per sr over the hemisphere: what would go below the surface is turned up, so
 * that nothing is lost. Integral 1. */
static inline float lobe_specular(float roughness, const float *normal, const float *to_sensor,
                                  const float *from)
{
    float below[3];

    if (!(lobe_dot(normal, from) > 0.0f)) return 0.0f;
    lobe_turn(normal, from, below);
    return lobe_of_slopes(roughness, normal, to_sensor, from) +
           lobe_of_slopes(roughness, normal, to_sensor, below);
}

/* The specular lobe convolved with the solar disc, per sr. A smooth surface shows the disc itself; a
 * rough one's lobe is widened to sqrt(roughness^2 + (radius / 2)^2), whose peak is the disc's where
 * the roughness is 0. */
static inline float lobe_of_sun(float roughness, const float *normal, const float *to_sensor,
                                const float *sun)
{
    const float half_radius = 0.5f * SUN_RADIUS_RAD;
    float mirrored[3], apart = 0.0f;

    if (!(lobe_dot(normal, sun) > 0.0f)) return 0.0f;
    if (roughness >= LOBE_SMOOTH)
        return lobe_specular(sqrt(roughness * roughness + half_radius * half_radius), normal,
                             to_sensor, sun);
    lobe_turn(normal, to_sensor, mirrored);
    for (int k = 0; k < 3; k++) apart += (sun[k] + mirrored[k]) * (sun[k] + mirrored[k]);
    return apart < SUN_RADIUS_RAD * SUN_RADIUS_RAD ? 1.0f / (PI_F * SUN_RADIUS_RAD * SUN_RADIUS_RAD)
                                                   : 0.0f;
}

/* Two directions in a surface's plane: along what the sensor sees of it, and across. */
static inline void lobe_axes(const float *normal, const float *to_sensor, float *along,
                             float *across)
{
    const float up = lobe_dot(normal, to_sensor);
    float length;

    for (int k = 0; k < 3; k++) along[k] = to_sensor[k] - up * normal[k];
    length = sqrt(lobe_dot(along, along));
    if (length < 1e-6f) { /* seen along the normal, any will do */
        const uint steep = fabs(normal[2]) > 0.5f;
        along[0] = steep ? normal[2] : -normal[1];
        along[1] = steep ? 0.0f : normal[0];
        along[2] = steep ? -normal[0] : 0.0f;
        length = sqrt(lobe_dot(along, along));
    }
    for (int k = 0; k < 3; k++) along[k] /= length;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        across[k] = normal[a] * along[b] - normal[b] * along[a];
    }
}

/* A direction that light comes from, with the density of lobe_specular, from two numbers in 0..1: a
 * slope among those that face the sensor (Heitz, JCGT 7, 2018), which mirrors. */
static inline void lobe_sample(float roughness, const float *normal, const float *to_sensor,
                               float u, float v, float *out)
{
    const float up = lobe_dot(normal, to_sensor), level = sqrt(fmax(1.0f - up * up, 0.0f));
    const float length = sqrt(roughness * roughness * level * level + up * up);
    const float x = roughness * level / length, z = up / length; /* of the stretched sensor */
    const float radius = sqrt(u), turn = 2.0f * PI_F * v;
    const float a = radius * cos(turn), fraction = 0.5f * (1.0f + z);
    const float b = (1.0f - fraction) * sqrt(1.0f - a * a) + fraction * radius * sin(turn);
    const float c = sqrt(fmax(1.0f - a * a - b * b, 0.0f));
    const float steep = fmax(b * x + c * z, 0.0f);
    const float slope[3] = {roughness * (c * x - b * z), roughness * a, steep};
    const float size = lobe_dot(slope, slope);
    const float towards = 2.0f * (slope[0] * level + slope[2] * up) / size;
    const float above = fabs(towards * slope[2] - up);
    const float turned[3] = {towards * slope[0] - level, towards * slope[1], above};
    float along[3], across[3];

    lobe_axes(normal, to_sensor, along, across);
    for (int k = 0; k < 3; k++)
        out[k] = turned[0] * along[k] + turned[1] * across[k] + turned[2] * normal[k];
}

/* Ray `ray` of `count` of a pixel's specular lobe: points of a lattice, two numbers that the golden
 * ratio spreads evenly, moved together by what the pixel draws (Cranley and Patterson, 1976).
 *   pixel   its number in the picture, samples counted */
static inline void lobe_ray(float roughness, const float *normal, const float *to_sensor, uint seed,
                            uint pixel, uint ray, uint count, float *out)
{
    const uint key[2] = {seed, RANDOM_LOBE};
    uint word[4] = {pixel, 0u, 0u, 0u};

    random_words(key, word);
    /* Words of 32 bits turn over by themselves. */
    const uint first = word[0] + (uint)(((float)ray + 0.5f) / (float)count * 4294967040.0f);
    lobe_sample(roughness, normal, to_sensor, random_uniform(first),
                random_uniform(word[1] + ray * 0x9e3779b9u), out);
}

#endif
