/* Inspection: all that is known of one pixel: what it shows and the value of every plane. */
#ifndef INSPECTION_H
#define INSPECTION_H

#include "preview.h"

/* Draws the values of the picked pixel over the picture, and its spectrum where there are bands enough. */
void inspection_draw(const preview *p);

/* Writes a line per plane, `pixel COLUMN ROW PLANE VALUE UNIT`, and per step of the last 24 hours,
 * `day TIME LIT` and the temperature in C unless it is stated. */
void inspection_write(const preview *p, FILE *to);

#endif
