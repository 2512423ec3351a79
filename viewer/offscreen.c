#include "offscreen.h"

#include <GL/osmesa.h>
#include <stdlib.h>
#include <time.h>

typedef struct offscreen {
    surface base;
    OSMesaContext context;
    unsigned char *pixels; /* OSMesa draws here; canvas_read reads it */
    int width, height;
    int most_width, most_height; /* shape of pixels; the page is its lower left part */
} offscreen;

static surface_function load(const char *name)
{
    return (surface_function)OSMesaGetProcAddress(name);
}

static void measure(surface *s, int *out_width, int *out_height, double *out_scale)
{
    const offscreen *o = (const offscreen *)s;

    *out_width = o->width;
    *out_height = o->height;
    *out_scale = 1.0;
}

static status grow(offscreen *o, int width, int height)
{
    status rc = STATUS_OK;
    unsigned char *pixels = malloc((size_t)width * (size_t)height * 4);

    NEED(pixels, STATUS_MEMORY, "no memory for a picture of %d x %d pixels", width, height);
    NEED(OSMesaMakeCurrent(o->context, pixels, GL_UNSIGNED_BYTE, width, height), STATUS_DEVICE,
         "OSMesa cannot draw %d x %d pixels", width, height);
    free(o->pixels);
    o->pixels = pixels;
    o->most_width = width;
    o->most_height = height;
    pixels = NULL;
out:
    free(pixels);
    return rc;
}

/* OSMesa keeps what it drew on until its context ends: only larger pages get a new one. */
static status resize(surface *s, int width, int height)
{
    status rc = STATUS_OK;
    offscreen *o = (offscreen *)s;

    if (width > o->most_width || height > o->most_height)
        TRY(grow(o, width > o->most_width ? width : o->most_width,
                 height > o->most_height ? height : o->most_height));
    o->width = width;
    o->height = height;
out:
    return rc;
}

static void show(surface *s)
{
    (void)s;
}

static bool take(surface *s, event *out, double wait_s)
{
    const struct timespec pause = {(time_t)wait_s, (long)((wait_s - (double)(time_t)wait_s) * 1e9)};

    (void)s;
    (void)out;
    nanosleep(&pause, NULL);
    return false;
}

static void name(surface *s, const char *title)
{
    (void)s;
    (void)title;
}

static void free_surface(surface *s)
{
    offscreen *o = (offscreen *)s;

    if (o->context) OSMesaDestroyContext(o->context);
    free(o->pixels);
    free(o);
}

status offscreen_open(surface **out, int width, int height)
{
    static const int attributes[] = {OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
    status rc = STATUS_OK;
    offscreen *o = calloc(1, sizeof *o);

    NEED(o, STATUS_MEMORY, "no memory for a surface");
    o->base = (surface){load, measure, resize, show, take, name, free_surface};
    o->context = OSMesaCreateContextAttribs(attributes, NULL);
    NEED(o->context, STATUS_DEVICE, "OSMesa offers no OpenGL 3.3 (package libosmesa6)");
    TRY(resize(&o->base, width, height));
    *out = &o->base;
    o = NULL;
out:
    if (o) free_surface(&o->base);
    return rc;
}
