#include "station/weather_history.h"

#include "files/file_name.h"
#include "station/dated_table.h"
#include "station/table_light.h"
#include "station/weather_epw.h"
#include "station/weather_surfrad.h"

/* A table by hours of the history. */
static status read_table(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    weather_table table = {0};

    TRY(weather_table_read(&table, path));
    table_light_split(&table, place, path);
    *out = table.history;
    table.history = NULL;
out:
    weather_table_free(&table);
    return rc;
}

status weather_history_read(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    bool has_dates = false;

    if (file_name_ends(path, ".epw")) return weather_epw_read(out, path, place);
    if (file_name_ends(path, ".dat")) return weather_surfrad_read(out, path, place);
    if (file_name_ends(path, ".wth")) return weather_read(out, path);
    NEED(file_name_ends(path, ".csv"), STATUS_FORMAT,
         "%s: a name that tells no kind of weather, expected one that ends with .wth, .csv, .epw "
         "or .dat",
         path);
    TRY(dated_table_is(&has_dates, path));
    rc = has_dates ? dated_table_read(out, path, place) : read_table(out, path, place);
out:
    return rc;
}
