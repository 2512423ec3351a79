/* Curve: values over the hours of some days, drawn for people as a PNG. */
#ifndef CURVE_H
#define CURVE_H

#include "status.h"

#include <stddef.h>
#include <stdint.h>

typedef struct curve_line {
    const char *name;
    const double *value; /* shape (count) */
    uint8_t rgb[3];
} curve_line;

typedef struct curve {
    const char *title, *unit;
    const double *time_h; /* shape (count), ascending */
    size_t count;         /* 2 or more */
    const curve_line *line;
    size_t line_count;
} curve;

/* Writes the picture; fails with STATUS_FILE where the file or the font cannot be opened. */
status curve_write(const char *path, const curve *c);

#endif
