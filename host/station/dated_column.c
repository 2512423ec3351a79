#include "station/dated_column.h"

#include "files/heading.h"

#include <stdio.h>

enum { NAME_SIZE = 64 };

const column dated_columns[DATED_COLUMNS] = {
    [WEATHER_SERIES_AIR_K] = {"air temperature", "C", -1, -90, 60, false},
    [WEATHER_SERIES_DEW_POINT_K] = {"dew point", "C", -1, -90, 70, false},
    [WEATHER_SERIES_HUMIDITY] = {"relative humidity", "%", -1, 0, 110, false},
    [WEATHER_SERIES_PRESSURE_PA] = {"pressure", "hPa", -1, 300, 1100, false},
    [WEATHER_SERIES_WIND_M_S] = {"wind speed", "m/s", -1, 0, 100, false},
    [WEATHER_SERIES_GLOBAL_W_M2] = {"global irradiance", "W/m2", -1, -50, 1800, false},
    [WEATHER_SERIES_DIRECT_W_M2] = {"direct light", "W/m2", -1, -50, 1500, false},
    [WEATHER_SERIES_DIFFUSE_W_M2] = {"diffuse light", "W/m2", -1, -50, 1500, false},
    [WEATHER_SERIES_LONGWAVE_W_M2] = {"longwave", "W/m2", -1, 10, 1000, true},
    [WEATHER_SERIES_COVER] = {"cloud cover", "tenths", -1, 0, 10, false},
    [WEATHER_SERIES_RAIN_M_S] = {"rain", "mm", -1, 0, 500, false},
    [DATED_EAST] = {"wind to the east", "m/s", -1, -90, 90, false},
    [DATED_NORTH] = {"wind to the north", "m/s", -1, -90, 90, false},
    [DATED_BEAM_LEVEL] = {"direct light on a level plane", "W/m2", -1, -50, 1500, false},
    [DATED_RAIN_HOURS] = {"hours of rain", "h", -1, 0, 24, false},
};

typedef struct known_name {
    int column;
    const char *names, *unit; /* unless the header states another */
} known_name;

static const known_name era5_names[] = {
    {WEATHER_SERIES_AIR_K, "|t2m|2m_temperature|", "K"},
    {WEATHER_SERIES_DEW_POINT_K, "|d2m|2m_dewpoint_temperature|", "K"},
    {WEATHER_SERIES_PRESSURE_PA, "|sp|surface_pressure|", "Pa"},
    {WEATHER_SERIES_GLOBAL_W_M2, "|ssrd|surface_solar_radiation_downwards|", "J/m2"},
    {DATED_BEAM_LEVEL, "|fdir|total_sky_direct_solar_radiation_at_surface|", "J/m2"},
    {DATED_BEAM_LEVEL, "|bhi|", "W/m2"},
    {WEATHER_SERIES_LONGWAVE_W_M2, "|strd|surface_thermal_radiation_downwards|", "J/m2"},
    {WEATHER_SERIES_COVER, "|tcc|total_cloud_cover|", "1"},
    {WEATHER_SERIES_RAIN_M_S, "|tp|total_precipitation|", "m"},
    {WEATHER_SERIES_RAIN_M_S, "|precipitation|", "cm"},
    {DATED_EAST, "|u10|10m_u_component_of_wind|", "m/s"},
    {DATED_NORTH, "|v10|10m_v_component_of_wind|", "m/s"},
};

static const known_name common_names[] = {
    {WEATHER_SERIES_AIR_K,
     "|Dry-bulb|Temperature|Air Temperature|temp_air|T2m|drybulb|temperature_2m|", "C"},
    {WEATHER_SERIES_DEW_POINT_K, "|Dew-point|temp_dew|dewpoint_2m|dew_point_2m|", "C"},
    {WEATHER_SERIES_HUMIDITY, "|RHum|Relative Humidity|RH|relative_humidity_2m|", "%"},
    {WEATHER_SERIES_PRESSURE_PA, "|Pressure|SP|surface_pressure|", ""},
    {WEATHER_SERIES_WIND_M_S, "|Wspd|Wind Speed|WS10m|wind|", "m/s"},
    {WEATHER_SERIES_GLOBAL_W_M2, "|GHI|G(h)|global|", "W/m2"},
    {WEATHER_SERIES_DIRECT_W_M2, "|DNI|Gb(n)|direct|", "W/m2"},
    {WEATHER_SERIES_DIFFUSE_W_M2, "|DHI|Gd(h)|diffuse|", "W/m2"},
    {WEATHER_SERIES_LONGWAVE_W_M2, "|IR(h)|longwave_down|", "W/m2"},
    {WEATHER_SERIES_COVER, "|OpqCld|", "tenths"},
    {WEATHER_SERIES_RAIN_M_S, "|Lprecip depth|rain|precipitation|", "mm"},
    {DATED_RAIN_HOURS, "|Lprecip quantity|", "h"},
};

static const known_name *find(const known_name *list, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (heading_is_named(name, list[i].names)) return &list[i];
    return NULL;
}

static const known_name *find_any(const char *name, bool is_era5)
{
    const known_name *found =
        is_era5 ? find(era5_names, sizeof era5_names / sizeof *era5_names, name) : NULL;

    return found ? found : find(common_names, sizeof common_names / sizeof *common_names, name);
}

int dated_column_find(const char *field, bool is_era5, char out_unit[64])
{
    char name[NAME_SIZE];
    const known_name *found = find_any(field, is_era5); /* `G(h)` is a name as a whole */

    *out_unit = '\0';
    if (!found) {
        if (!heading_split(field, NAME_SIZE, name, out_unit)) return -1;
        found = find_any(name, is_era5);
    }
    if (!found) return -1;
    if (!*out_unit) snprintf(out_unit, NAME_SIZE, "%s", found->unit);
    return found->column;
}
