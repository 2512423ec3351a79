#include "station/weather_history.h"

#include "files/file_name.h"
#include "station/weather_epw.h"
#include "station/weather_surfrad.h"

status weather_history_read(weather **out, const char *path, const site *place)
{
    if (file_name_ends(path, ".epw")) return weather_epw_read(out, path, place);
    if (file_name_ends(path, ".dat")) return weather_surfrad_read(out, path, place);
    return weather_read(out, path);
}
