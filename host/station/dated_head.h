/* Dated head: what stands above the rows of a table with dates: its kind, place and columns. */
#ifndef DATED_HEAD_H
#define DATED_HEAD_H

#include "files/column.h"
#include "files/csv_row.h"
#include "station/dated_column.h"

#include <stdbool.h>

typedef enum dated_kind {
    DATED_NONE,  /* no table with dates */
    DATED_TMY3,  /* hours end at their times, 01:00 to 24:00 */
    DATED_NSRDB, /* values are those of their times, as of all below but ERA5 */
    DATED_ERA5,  /* hours end at their times, UTC */
    DATED_PVGIS, /* UTC; text stands behind the rows */
    DATED_OTHER
} dated_kind;

/* Fields of a row that tell its time and place; -1: none. */
typedef struct dated_fields {
    int year, month, day, hour, minute; /* numbers */
    int date, time;                     /* 01/31/1988 and 24:00 */
    int stamp;                          /* both in one */
    int latitude, longitude;
} dated_fields;

typedef struct dated_head {
    dated_kind kind;
    char separator;
    size_t names;                       /* in the line above the rows */
    char name[64];                      /* of the place; "" */
    double latitude_deg, longitude_deg; /* not-a-number where they are not stated */
    double elevation_m, utc_offset_h;   /* the same */
    dated_fields fields;
    column_place place[DATED_COLUMNS];
    bool is_pressure_open; /* in hPa or Pa: by size */
    double light_after_h;  /* light is that of so long after a row's time */
} dated_head;

/* Reads up to the first row; `kind` is DATED_NONE where the file is no such table, whatever stands in it.
 * Fails with STATUS_FORMAT where it is one and its place or a unit cannot be read. */
status dated_head_read(dated_head *out, record_file *file);

#endif
