/* Overlay: what covers the picture for a while: the keys, the list of planes, an error. */
#ifndef OVERLAY_H
#define OVERLAY_H

#include "preview.h"

/* Draws the overlay that is open, if one is. */
void overlay_draw(const preview *p);

/* Draws a text of several lines, as an alarm, over the foot of the page. */
void overlay_message(const preview *p, const char *text);

/* Finds the plane of the list at a height of the page; false: there is none. */
bool overlay_find(const preview *p, double y, size_t *out_plane);

#endif
