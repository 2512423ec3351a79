/* View: where the camera stands and what it sees. Thesis 2.5.3, Appendix A item 1 (.adv). */
#ifndef VIEW_H
#define VIEW_H

#include "base/status.h"
#include "kernels/records.h"

#include <stdbool.h>
#include <stdint.h>

/* A frame of which the picture is the part from (column, row) on; columns 0: the picture is all. */
typedef struct view_crop {
    int column, row;
    int columns, rows; /* of the frame */
} view_crop;

/* Pixels of a picture, and of one of its sides, at most. */
#define VIEW_PIXELS INT32_MAX
enum { VIEW_SIDE = 1 << 20 };

typedef struct view {
    double position_m[3], target_m[3]; /* ENU; they differ */
    double twist_deg;       /* about the line of sight: the picture turns counterclockwise */
    double focal_length_mm; /* 35 mm equivalent: 36 mm of film lie across the columns */
    int columns, rows;
    view_crop crop; /* what the picture is a part of */
    double width_m; /* orthographic: across the frame's columns; 0: perspective */
} view;

/* Whether a picture, or the frame that it is a part of, has at most VIEW_PIXELS. */
bool view_fits(int columns, int rows);

/* Reads an .adv file and turns it from the axes of 1994 (+x north, +y west) to ENU. Its elevation
 * and azimuth repeat what target and position say: more than .1 degree apart is a warning. */
status view_read(view *out, const char *path);

/* Writes an .adv file that view_read reads back, to the axes' exchange of sign. Fails with STATUS_ARGUMENT
 * if the view is orthographic, which the format does not know. */
status view_write(const view *v, const char *path);

/* Writes the [camera] table of a scene file, every number to its last digit. */
status view_write_table(const view *v, const char *path);

/* Turns a view into the pinhole camera of eq. 2.5.3-2, or an orthographic one, positions minus
 * origin_m. Columns run to the
 * right, rows from the top, pixels are square, up is up; straight down or up, the top is north.
 * The view is one that was checked: position and target differ, sizes are above 0. */
camera_record view_camera(const view *v, const double origin_m[3]);

#endif
