/* Page: where everything stands around the picture, and the drawing of it: title, picture, north arrow,
 * colour bar or legend, overlays, a line at the foot. */
#ifndef PAGE_H
#define PAGE_H

#include "preview.h"

/* Sets where the picture of the wish stands on the page. */
void page_place(preview *p);

/* Sets the size of the picture that fills the page; on a dense screen its pixels are larger. */
void page_fit(const preview *p, int *out_columns, int *out_rows);

status page_draw(preview *p);

/* Finds the pixel of the wish under a point of the page; false: there is none. */
bool page_find_pixel(const preview *p, double x, double y, int *out_column, int *out_row);

/* The middle of a pixel of the wish on the page. */
void page_find_point(const preview *p, int column, int row, double *out_x, double *out_y);

#endif
