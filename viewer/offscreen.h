/* Offscreen: a surface in memory, drawn by Mesa's software renderer (OSMesa); needs no display. */
#ifndef OFFSCREEN_H
#define OFFSCREEN_H

#include "surface.h"

/* Opens it and makes its context current. It has no events: take only waits. Fails with STATUS_DEVICE
 * where OSMesa offers no OpenGL 3.3. */
status offscreen_open(surface **out, int width, int height);

#endif
