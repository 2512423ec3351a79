#include "model_sonde.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { LEVELS = 50, MODELS = 6, GASES = 8, WATER = 0 };

/* lowtran7.f; the names of its common blocks are its own. */
extern struct {
    float altitude_km[LEVELS], pressure_mb[MODELS][LEVELS], temperature_k[MODELS][LEVELS];
    float ppmv[MODELS][GASES][LEVELS];
} mlatm_;

/* LOWTRAN's constants, subroutines WATVAP and ATMCON. */
#define STANDARD_K 273.15
#define STANDARD_HPA 1013.25
#define LOSCHMIDT_CM3 2.68675e19
#define WATER_PER_G (6.022045e23 / 18.015)

/* The inverse of LOWTRAN's saturation density, exp(c1 + c2 a + c3 a^2) g m-3 times a, a = 273.15 K
 * over the dew point. */
static double dew_point_k(double ppmv, double pressure_hpa)
{
    const double c1 = 18.9766, c2 = -14.9595, c3 = -2.43882;
    const double density_g_m3 = ppmv * LOSCHMIDT_CM3 * pressure_hpa / STANDARD_HPA / WATER_PER_G;
    const double rest = c1 - log(density_g_m3);

    return STANDARD_K * 2.0 * c3 / (-c2 - sqrt(c2 * c2 - 4.0 * c3 * rest));
}

status model_sonde_make(sonde **out, int model, double top_m)
{
    status rc = STATUS_OK;
    sonde *s = calloc(1, sizeof *s);
    bool is_below = true;

    NEED(s, STATUS_MEMORY, "no memory for a model atmosphere");
    s->level = malloc(LEVELS * sizeof *s->level);
    NEED(s->level, STATUS_MEMORY, "no memory for a model atmosphere");
    for (int i = 0; i < LEVELS && is_below; i++) {
        sonde_level *level = &s->level[s->count++];
        level->altitude_m = 1000.0 * (double)mlatm_.altitude_km[i];
        level->pressure_hpa = (double)mlatm_.pressure_mb[model - 1][i];
        level->temperature_k = (double)mlatm_.temperature_k[model - 1][i];
        level->dew_point_k =
            dew_point_k((double)mlatm_.ppmv[model - 1][WATER][i], level->pressure_hpa);
        is_below = level->altitude_m < top_m;
    }
    *out = s;
    s = NULL;
out:
    sonde_free(s);
    return rc;
}
