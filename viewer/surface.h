/* Surface: what the preview draws on, with OpenGL 3.3: a window or a picture in memory. Functions of
 * OpenGL come through its loader alone, since two libraries that offer them can be in one process. */
#ifndef SURFACE_H
#define SURFACE_H

#include "base/status.h"
#include "event.h"

typedef void (*surface_function)(void);

typedef struct surface surface;
struct surface {
    surface_function (*load)(const char *name);
    /* Pixels of the picture, and how many of them a point of text takes. */
    void (*measure)(surface *s, int *out_width, int *out_height, double *out_scale);
    status (*resize)(surface *s, int width, int height);
    void (*show)(surface *s); /* what was drawn */
    /* Takes the next event, waiting up to wait_s for it; false: there is none. */
    bool (*take)(surface *s, event *out, double wait_s);
    void (*name)(surface *s, const char *title);
    void (*free)(surface *s);
};

#endif
