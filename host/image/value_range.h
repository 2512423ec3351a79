/* Value range: what span of values a colour bar shows, and where its ticks stand. */
#ifndef VALUE_RANGE_H
#define VALUE_RANGE_H

#include "base/status.h"

#include <stddef.h>

enum { VALUE_RANGE_TICKS = 64 };

typedef struct value_range {
    double min, max; /* max above min */
    size_t valid_count, missing_count;
} value_range;

/* The 0.5 to 99.5 percentile (nearest rank) of the values that are finite and not no_data; if they
 * are all but equal, 1 % about them (0.5 about 0). Without any: 0 to 1. */
status value_range_find(value_range *out, const float *value, size_t count, float no_data);

/* The smallest of 1, 2, 5 times a power of ten that is not below `least`, which is positive. */
double value_range_step(double least);

/* Finds the multiples of `step` in a range, in ascending order; returns how many, up to VALUE_RANGE_TICKS.
 *   out   shape (VALUE_RANGE_TICKS) */
size_t value_range_ticks(const value_range *range, double step, double *out);

/* Writes a tick's value with the digits that its step needs. */
void value_range_label(char *out, size_t size, double value, double step);

#endif
