/* Sonde layout: what the readers of soundings share. A layout lists the soundings of a file, and takes the
 * levels of the one that was chosen. */
#ifndef SONDE_LAYOUT_H
#define SONDE_LAYOUT_H

#include "files/record_file.h"
#include "sonde.h"

#include <stdbool.h>

enum { SONDE_NAME_SIZE = 64 };

/* A sounding of a file. */
typedef struct sonde_part {
    char station[SONDE_NAME_SIZE];      /* "": not stated */
    double time_s;                      /* UTC since 1970; NAN: not stated */
    double latitude_deg, longitude_deg; /* NAN: not stated */
    int line,
        end; /* its head or first level, and the first line that is not its own; 0: to the end */
} sonde_part;

typedef struct sonde_parts {
    size_t count;
    sonde_part *part; /* shape (count) */
} sonde_parts;

/* Appends a sounding of which nothing is known but its line; it is the last until the next call. */
status sonde_parts_add(sonde_parts *parts, int line);

/* Chooses the one sounding of a file, or of several that of the nearest station and hour, with a warning;
 * warns too where it is more than 12 h or 500 km away.
 * Fails with a list of them where no hour lies within 6 h, or stations and hours do not tell.
 *   where   place and time of the scene; NULL: not known */
status sonde_choose(const sonde_part **out, const sonde_parts *parts, const site *where,
                    const char *path);

/* UTC of a date and an hour; NAN where it is none. */
double sonde_time_s(int year, int month, int day, int hour, int minute);

typedef enum sonde_quantity {
    SONDE_PRESSURE,    /* hPa */
    SONDE_ALTITUDE,    /* m */
    SONDE_TEMPERATURE, /* K */
    SONDE_DEW_POINT,   /* K */
    SONDE_HUMIDITY,    /* share */
    SONDE_DEPRESSION,  /* K, of the dew point below the temperature */
    SONDE_QUANTITIES
} sonde_quantity;

/* A number as a file states it: scale * number + shift is in the quantity's unit. */
typedef struct sonde_unit {
    sonde_quantity quantity;
    double scale, shift;
} sonde_unit;

/* Levels of one sounding as they are read. */
typedef struct sonde_builder {
    sonde *s;
    const char *path;
    size_t flag_count;    /* numbers that stand for none */
    double most_humidity; /* relative, of those that dew points follow from */
    size_t noise_count;   /* levels that repeat one, or fall a little below it */
} sonde_builder;

/* Turns a number into its unit. Numbers of nines alone, -8888 and others far beyond all soundings stand
 * for none: NAN. */
double sonde_value(sonde_builder *builder, const sonde_unit *unit, double number);

/* Adds a level; NAN: not known. Without pressure or temperature it is passed over. Fails at the line of
 * the file that was taken last where a value is out of range, or the level does not rise.
 *   value   shape (SONDE_QUANTITIES) */
status sonde_add(sonde_builder *builder, const double *value, const record_file *file);

/* Ends a sounding: altitudes that are missing follow from pressure and temperature, dew points that are
 * missing over 2 km at most lie between their neighbours'. Fails with fewer than two levels. Warns of
 * what was left out or derived. */
status sonde_finish(sonde_builder *builder);

/* A layout. */
typedef struct sonde_layout {
    status (*list)(sonde_parts *parts, record_file *file); /* from the file's first line on */
    /* Takes the levels of a sounding, likewise from the file's first line on. */
    status (*read)(sonde_builder *builder, record_file *file, const sonde_part *part);
} sonde_layout;

extern const sonde_layout sonde_csv, sonde_wyoming, sonde_igra;

/* Whether a line is the head of the University of Wyoming's text, or of an IGRA sounding. */
bool sonde_wyoming_is_head(const char *line);
bool sonde_igra_is_head(const char *line);

#endif
