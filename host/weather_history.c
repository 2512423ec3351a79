#include "weather_history.h"

#include "weather_epw.h"
#include "weather_surfrad.h"

#include <stdbool.h>
#include <string.h>

static bool ends_with(const char *path, const char *ending)
{
    const size_t length = strlen(path), tail = strlen(ending);

    return length > tail && !strcmp(path + length - tail, ending);
}

status weather_history_read(weather **out, const char *path, const site *place)
{
    if (ends_with(path, ".epw")) return weather_epw_read(out, path, place);
    if (ends_with(path, ".dat")) return weather_surfrad_read(out, path, place);
    return weather_read(out, path);
}
