/* Curve: values over hours, wavelengths or the like, drawn for people as a PNG. */
#ifndef CURVE_H
#define CURVE_H

#include "files/output_folder.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct curve_line {
    const char *name;
    const double *value; /* shape (count); NAN: a gap */
    uint8_t rgb[3];
} curve_line;

typedef struct curve {
    const char *title, *unit;
    const char *x_unit; /* "h" is cut every 6 */
    const double *x;    /* shape (count), ascending */
    size_t count;       /* 2 or more */
    const curve_line *line;
    size_t line_count;
    bool is_log;   /* a logarithmic axis; what lies below the highest value's 1e-6 is left out */
    bool is_log_x; /* the same of x, all above 0 */
} curve;

/* Writes the picture; fails with STATUS_FILE where the file or the font cannot be opened. */
status curve_write(const char *path, const curve *c);

/* The same into a folder, which commits it. */
status curve_write_into(output_folder *folder, const char *name, const curve *c);

#endif
