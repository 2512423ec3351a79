/* Day plot: the last 24 hours of a point: when the sun reached it, and its temperature. */
#ifndef DAY_PLOT_H
#define DAY_PLOT_H

#include "preview.h"

/* Draws the preview's day into a rectangle, with a line of text below it. */
void day_plot_draw(const preview *p, preview_rectangle into);

#endif
