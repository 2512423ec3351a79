/* Window: a surface on the screen (GLFW). */
#ifndef WINDOW_H
#define WINDOW_H

#include "surface.h"

/* Opens a window whose picture has this size, or less on a small screen, and makes its context
 * current. Fails with STATUS_DEVICE where there is no display, or none with OpenGL 3.3. */
status window_open(surface **out, int width, int height);

#endif
