#include "thermal/value_check.h"

#include "kernels/constants.h"
#include "kernels/records.h"

#include <math.h>

static const float least_k = 1.0f, most_k = 6000.0f, rounding_k = 1e-3f;

bool value_check_kelvin(float temperature_k)
{
    return temperature_k >= least_k - rounding_k && temperature_k <= most_k + rounding_k;
}

size_t value_check_finite(const float *value, size_t count)
{
    size_t i = 0;

    while (i < count && isfinite(value[i])) i++;
    return i;
}

size_t value_check_celsius(const float *value, size_t count)
{
    size_t i = 0;

    while (i < count && (value[i] == NO_VALUE || value_check_kelvin(value[i] + ZERO_CELSIUS_K)))
        i++;
    return i;
}
