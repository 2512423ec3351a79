/* Legend: what the colours mean: a bar with ticks and unit, or the names of the materials; and how often
 * each value occurs. */
#ifndef LEGEND_H
#define LEGEND_H

#include "preview.h"

/* Draws it into a rectangle beside the picture. */
void legend_draw(const preview *p, preview_rectangle into);

#endif
