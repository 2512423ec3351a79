/* Value check: whether temperatures and the values of planes can be what they say. */
#ifndef VALUE_CHECK_H
#define VALUE_CHECK_H

#include <stdbool.h>
#include <stddef.h>

/* What a surface may have; beyond that the model or its inputs are wrong. */
#define VALUE_CHECK_RANGE "1 to 6000 K"

/* Whether a surface may have a temperature. */
bool value_check_kelvin(float temperature_k);

/* The index of the first value that is not finite; count: none. */
size_t value_check_finite(const float *value, size_t count);

/* The index of the first temperature in C that no surface may have and that is not NO_VALUE; count:
 * none. */
size_t value_check_celsius(const float *value, size_t count);

#endif
