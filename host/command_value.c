#include "command_value.h"

#include "command.h"
#include "record_file.h"

#include <math.h>
#include <string.h>

bool command_number(const char *text, double low, double high, double *out)
{
    return !strchr(text, ',') && record_numbers(text, 1, out) == 1 && *out >= low && *out <= high;
}

bool command_device_numbers(const char *text, int most, int *out, size_t *out_count)
{
    size_t count = 0;

    for (const char *at = text;; at++) {
        int index = 0, digits = 0;
        for (; *at >= '0' && *at <= '9' && digits < 3; digits++) index = 10 * index + *at++ - '0';
        if (digits == 0 || index > 63 || count == (size_t)most) return false;
        for (size_t i = 0; i < count; i++)
            if (out[i] == index) return false;
        out[count++] = index;
        if (*at == ',') continue;
        *out_count = count;
        return *at == '\0';
    }
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

bool command_word(const char *text, const char *const *words, int count, int *out)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(text, words[i])) continue;
        *out = i;
        return true;
    }
    return false;
}

int command_laws(const char *command, const command_law_texts *text, forcing_laws *out)
{
    int sky = 0, air = -1, light = 0;

    *out = (forcing_laws){0};
    if (text->sky_longwave &&
        !command_word(text->sky_longwave, forcing_sky_names, FORCING_SKIES, &sky))
        return command_misuse(command,
                              "--sky-longwave '%s': expected brunt, berdahl-martin or brutsaert",
                              text->sky_longwave);
    if (text->convection && !command_word(text->convection, forcing_convection_names + 1,
                                          FORCING_CONVECTIONS - 1, &air))
        return command_misuse(command,
                              "--convection '%s': expected therm, mcadams, tarp or similarity",
                              text->convection);
    if (text->diffuse &&
        !command_word(text->diffuse, forcing_diffuse_names, FORCING_DIFFUSES, &light))
        return command_misuse(command, "--diffuse '%s': expected isotropic or hay-davies",
                              text->diffuse);
    out->sky = (forcing_sky)sky;
    out->convection = (forcing_convection)(air + 1);
    out->diffuse = (forcing_diffuse)light;
    if (text->roughness_length_m &&
        !command_number(text->roughness_length_m, FORCING_ROUGHNESS_LOW_M, FORCING_ROUGHNESS_HIGH_M,
                        &out->roughness_length_m))
        return command_misuse(command, "--roughness-length-m '%s': expected a number from %g to %g",
                              text->roughness_length_m, FORCING_ROUGHNESS_LOW_M,
                              FORCING_ROUGHNESS_HIGH_M);
    if (text->wind_height_m && !command_number(text->wind_height_m, FORCING_HEIGHT_LOW_M,
                                               FORCING_HEIGHT_HIGH_M, &out->wind_height_m))
        return command_misuse(command, "--wind-height-m '%s': expected a number from %g to %g",
                              text->wind_height_m, FORCING_HEIGHT_LOW_M, FORCING_HEIGHT_HIGH_M);
    return 0;
}
