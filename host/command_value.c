#include "command_value.h"

#include "record_file.h"

#include <math.h>
#include <string.h>

bool command_number(const char *text, double low, double high, double *out)
{
    return !strchr(text, ',') && record_numbers(text, 1, out) == 1 && *out >= low && *out <= high;
}

bool command_place(const char *text, double *latitude_deg, double *longitude_deg)
{
    const char *comma = strchr(text, ',');
    double value[2];

    if (!comma || strchr(comma + 1, ',') || record_numbers(text, 2, value) != 2) return false;
    *latitude_deg = value[0];
    *longitude_deg = value[1];
    return fabs(value[0]) <= 90.0 && fabs(value[1]) <= 180.0;
}
