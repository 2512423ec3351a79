/* Sensitivity: how far temperatures move when one input of the weather or of an object is off by
 * its measurement error. Thesis 3.1.1 and 3.1.2, Tables 3.1.1-1 and 3.1.2-1. */
#ifndef SENSITIVITY_H
#define SENSITIVITY_H

#include "thermal/thermal.h"

enum { SENSITIVITY_WEATHER = 8, SENSITIVITY_INPUTS = 18, SENSITIVITY_POWER = 14 };

/* A surface; its facet's normal follows from slope and azimuth. */
typedef struct sensitivity_object {
    material_record material;
    facet_record facet;
} sensitivity_object;

typedef struct sensitivity_study {
    const sensitivity_object *object; /* shape (count) */
    size_t count;
    bool is_layered;
    forcing_laws laws;
    const weather *history;
    site place;
    uint32_t runs; /* of each input */
    uint32_t seed;
} sensitivity_study;

/* What one input does. */
typedef struct sensitivity_row {
    const char *input, *unit;
    double error;      /* the thesis' measurement error, in the unit */
    double thesis_c;   /* the thesis' temperature error */
    double rmse_c;     /* root mean square over the last full day, mean over runs and objects */
    double sigma_c;    /* root mean square over runs, objects and that day */
    double *at_step_c; /* shape (weather's count): over runs and objects; belongs to the result */
} sensitivity_row;

typedef struct sensitivity {
    sensitivity_row row[SENSITIVITY_INPUTS]; /* the weather's SENSITIVITY_WEATHER first */
    double *at_step_c;
} sensitivity;

/* Runs the study: in each run one input is off by a constant, for all times and objects alike,
 * evenly distributed between minus and plus its error; run i draws from the i-th of `runs` equal
 * parts of that range (assumed: the thesis tells a bounded fluctuation; cloud types are drawn from
 * 0, 1, 7, 8). What leaves its physical range is held at its edge; the dew point follows air
 * temperature and humidity. */
status sensitivity_run(sensitivity *out, device *dev, const sensitivity_study *study);
void sensitivity_free(sensitivity *result);

/* Slope and azimuth in radians into the normal. */
void sensitivity_turn(facet_record *facet);

/* Root of the sum of squares of the rows first .. first + count - 1, of rmse_c, sigma_c and the
 * thesis' values; `without` is left out, or SENSITIVITY_INPUTS. */
sensitivity_row sensitivity_sum(const sensitivity *result, int first, int count, int without);

#endif
