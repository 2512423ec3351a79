#include "weather/cloud_sky.h"

#include <math.h>

#define GROUND_ALBEDO 0.2

enum { HIGH, MIDDLE, LOW, LAYERS };
enum { THIN_CIRRUS, THICK_CIRRUS, MIDDLE_CLOUD, STRATUS, CLOUDS };
enum {
    CIRRUS_TYPE = 1,
    CIRROSTRATUS_TYPE,
    ALTOCUMULUS_TYPE,
    ALTOSTRATUS_TYPE,
    NIMBOSTRATUS_TYPE = 7
};

/* Cubics in the cosine of the sun's zenith angle, constants first. */
typedef struct cubics {
    double reflected[4], passed[4];
} cubics;

static const cubics airs[LAYERS] = {
    [HIGH] = {{0.12395, -0.34765, 0.39478, -0.14627}, {0.76977, 0.49407, -0.44647, 0.11558}},
    [MIDDLE] = {{0.15325, -0.39620, 0.42095, -0.14200}, {0.69318, 0.68227, -0.64289, 0.17910}},
    [LOW] = {{0.15946, -0.42185, 0.48800, -0.18492}, {0.68679, 0.71012, -0.71463, 0.22339}},
};

static const cubics clouds[CLOUDS] = {
    [THIN_CIRRUS] = {{0.25674, -0.18077, -0.21961, 0.25272}, {0.63547, 0.35229, 0.08709, -0.22902}},
    [THICK_CIRRUS] = {{0.60540, -0.55142, -0.23389, 0.43648},
                      {0.26458, 0.66829, 0.24228, -0.49357}},
    [MIDDLE_CLOUD] = {{0.66152, -0.14863, -0.08193, 0.13442},
                      {0.19085, 0.32817, -0.08613, -0.08197}},
    [STRATUS] = {{0.71214, -0.15033, 0.00696, 0.03904}, {0.13610, 0.29964, -0.14041, 0.00952}},
};

/* Weight of a cover n under the cosine m: 1, m, n, n m, m m, n n. */
static const double weights[CLOUDS][6] = {
    [THIN_CIRRUS] = {0.675, -3.432, 1.929, 0.842, 2.693, -1.354},
    [THICK_CIRRUS] = {1.552, -1.957, -1.762, 2.067, 0.448, 0.932},
    [MIDDLE_CLOUD] = {1.429, -1.207, -2.008, 0.853, 0.324, 1.582},
    [STRATUS] = {0.858, -1.075, -0.536, 0.750, 0.322, 0.501},
};

typedef struct sky_layer {
    double reflected, passed;
} sky_layer;

static double cubic(const double c[4], double m)
{
    return c[0] + m * (c[1] + m * (c[2] + m * c[3]));
}

static sky_layer layer_of(const cubics *c, double m)
{
    return (sky_layer){cubic(c->reflected, m), cubic(c->passed, m)};
}

static sky_layer mixed(sky_layer clear, sky_layer clouded, double fraction)
{
    return (sky_layer){clear.reflected + fraction * (clouded.reflected - clear.reflected),
                       clear.passed + fraction * (clouded.passed - clear.passed)};
}

/* The fraction of the sky that a cover weighs as; all of it under an overcast. */
static double weighed_cover(int kind, double n, double m)
{
    const double *w = weights[kind];
    const double weight = w[0] + w[1] * m + w[2] * n + w[3] * n * m + w[4] * m * m + w[5] * n * n;

    return n >= 1.0 ? 1.0 : fmin(1.0, fmax(0.0, n * weight));
}

static void put_cloud(sky_layer *layer, int kind, double cover, double m)
{
    *layer = mixed(*layer, layer_of(&clouds[kind], m), weighed_cover(kind, cover, m));
}

static void set_layers(sky_layer layer[LAYERS], int type, double cover, double m)
{
    for (int i = 0; i < LAYERS; i++) layer[i] = layer_of(&airs[i], m);
    if (type == CIRRUS_TYPE) put_cloud(&layer[HIGH], THIN_CIRRUS, cover, m);
    if (type == CIRROSTRATUS_TYPE) put_cloud(&layer[HIGH], THICK_CIRRUS, cover, m);
    if (type == ALTOCUMULUS_TYPE || type == ALTOSTRATUS_TYPE || type == NIMBOSTRATUS_TYPE)
        put_cloud(&layer[MIDDLE], MIDDLE_CLOUD, cover, m);
    /* assumed: fog is stratus on the ground. */
    if (type > ALTOSTRATUS_TYPE) put_cloud(&layer[LOW], STRATUS, cover, m);
}

static double beam_through(const sky_layer layer[LAYERS])
{
    double beam = 1.0;

    for (int i = 0; i < LAYERS; i++) beam *= fmax(0.0, layer[i].passed - layer[i].reflected);
    return beam;
}

/* What reaches the ground of 1 on top, with all that goes to and fro: layer by layer from the
 * ground up, each with what lies below it as one reflector. */
static double level_through(const sky_layer layer[LAYERS])
{
    double below = GROUND_ALBEDO, passed = 1.0;

    for (int i = LAYERS - 1; i >= 0; i--) {
        const double again = 1.0 / (1.0 - layer[i].reflected * below);
        passed *= layer[i].passed * again;
        below = layer[i].reflected + layer[i].passed * layer[i].passed * below * again;
    }
    return passed;
}

void cloud_sky_shares(int cloud_type, double cover, double cos_zenith, double *out_beam,
                      double *out_level)
{
    sky_layer clear[LAYERS], clouded[LAYERS];

    set_layers(clear, 0, 0.0, cos_zenith);
    set_layers(clouded, cloud_type, cover, cos_zenith);
    *out_beam = fmin(1.0, beam_through(clouded) / beam_through(clear));
    *out_level = level_through(clouded) / level_through(clear);
}
