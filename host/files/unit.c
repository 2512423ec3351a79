#include "files/unit.h"

#include "kernels/constants.h"

#include <ctype.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#define KELVIN ((double)ZERO_CELSIUS_K)
#define HOUR_S 3600.0

enum { SPELT_SIZE = 32 };

/* Spellings are small letters, without what `spell` leaves out, between bars. */
static const struct {
    unit is;
    const char *spellings;
} units[] = {
    {{"C", "temperature", 1.0, KELVIN}, "|c|celsius|"},
    {{"K", "temperature", 1.0, 0.0}, "|k|kelvin|"},
    {{"F", "temperature", 5.0 / 9.0, KELVIN - 160.0 / 9.0}, "|f|fahrenheit|"},
    {{"Pa", "pressure", 1.0, 0.0}, "|pa|pascal|"},
    {{"hPa", "pressure", 100.0, 0.0}, "|hpa|"},
    {{"mbar", "pressure", 100.0, 0.0}, "|mbar|mb|millibar|millibars|"},
    {{"kPa", "pressure", 1000.0, 0.0}, "|kpa|"},
    {{"m/s", "speed", 1.0, 0.0}, "|m/s|ms-1|m/sec|mps|"},
    {{"km/h", "speed", 1.0 / 3.6, 0.0}, "|km/h|kmh-1|kmh|kph|"},
    {{"kn", "speed", 1852.0 / HOUR_S, 0.0}, "|kn|kt|kts|knot|knots|"},
    {{"%", "fraction", 0.01, 0.0}, "|%|percent|pct|"},
    {{"1", "fraction", 1.0, 0.0}, "|1|-|fraction|share|0-1|0..1|"},
    {{"tenths", "fraction", 0.1, 0.0}, "|tenths|tenth|"},
    {{"oktas", "fraction", 0.125, 0.0}, "|oktas|okta|eighths|"},
    {{"W/m2", "irradiance", 1.0, 0.0}, "|w/m2|wm-2|wm2|"},
    {{"Wh/m2", "irradiance", 1.0, 0.0}, "|wh/m2|whm-2|wh/m2/h|"},
    {{"kWh/m2", "irradiance", 1000.0, 0.0}, "|kwh/m2|kwhm-2|"},
    {{"J/m2", "irradiance", 1.0 / HOUR_S, 0.0}, "|j/m2|jm-2|"},
    {{"kJ/m2", "irradiance", 1000.0 / HOUR_S, 0.0}, "|kj/m2|kjm-2|"},
    {{"mm/h", "rain", 1e-3 / HOUR_S, 0.0}, "|mm/h|mmh-1|mm/hr|mm/hour|"},
    {{"mm", "rain", 1e-3 / HOUR_S, 0.0}, "|mm|kg/m2|kgm-2|"},
    {{"cm", "rain", 1e-2 / HOUR_S, 0.0}, "|cm|"},
    {{"m", "rain", 1.0 / HOUR_S, 0.0}, "|m|"},
    {{"m", "length", 1.0, 0.0}, "|m|gpm|metres|meters|"},
    {{"km", "length", 1000.0, 0.0}, "|km|gpkm|"},
    {{"ft", "length", 0.3048, 0.0}, "|ft|feet|"},
    {{"h", "time", 1.0, 0.0}, "|h|hr|hour|hours|"},
    {{"um", "wavelength", 1.0, 0.0},
     "|um|micron|microns|micrometer|micrometers|micrometre|micrometres|"},
    {{"nm", "wavelength", 1e-3, 0.0}, "|nm|nanometer|nanometers|nanometre|nanometres|"},
    {{"cm-1", "wavenumber", 1.0, 0.0}, "|cm-1|cm1|1/cm|"},
};

/* What has another spelling, or none. */
static const struct {
    const char *from, *to;
} rewritten[] = {
    {"\xc2\xb0", ""},      /* degree sign */
    {"\xc2\xba", ""},      /* masculine ordinal, where people mean it */
    {"\xcb\x9a", ""},      /* ring above */
    {"\xc2\xb2", "2"},     /* superscript two */
    {"\xc2\xb9", "1"},     /* superscript one */
    {"\xe2\x81\xbb", "-"}, /* superscript minus */
    {"\xe2\x88\x92", "-"}, /* minus */
    {"\xc2\xb7", ""},      /* middle dot */
    {"\xe2\x8b\x85", ""},  /* dot operator */
    {"\xc2\xb5", "u"},     /* micro */
    {"\xce\xbc", "u"},     /* mu */
    {"degrees", ""},
    {"degree", ""},
    {"deg", ""},
    {"per", "/"},
    {"^", ""},
    {"*", ""},
    {"_", ""},
    {".", ""},
    {" ", ""},
    {"\t", ""},
};

/* Writes |spelling|; false if it is too long for any. */
static bool spell(char out[SPELT_SIZE], const char *text)
{
    size_t n = 0;

    out[n++] = '|';
    while (*text) {
        const char *put = NULL;
        for (size_t i = 0; !put && i < sizeof rewritten / sizeof *rewritten; i++) {
            const size_t length = strlen(rewritten[i].from);
            /* "percent" is no "/cent" */
            if (strncmp(text, rewritten[i].from, length) || !strncmp(text, "percent", 7)) continue;
            put = rewritten[i].to;
            text += length;
        }
        if (n + 3 > SPELT_SIZE) return false;
        if (put)
            n += (size_t)(stpcpy(out + n, put) - (out + n));
        else
            out[n++] = (char)tolower((unsigned char)*text++);
    }
    out[n++] = '|';
    out[n] = '\0';
    return n > 2;
}

const unit *unit_find(const char *text, const char *quantity)
{
    char spelt[SPELT_SIZE];

    if (strchr(text, '|') || !spell(spelt, text)) return NULL;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (strstr(units[i].spellings, spelt) &&
            (!quantity || !strcmp(units[i].is.quantity, quantity)))
            return &units[i].is;
    return NULL;
}
