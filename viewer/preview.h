/* Preview: what the viewer shows and how: the state between the session, which renders, the page, which
 * draws, and the controls, which change it. */
#ifndef PREVIEW_H
#define PREVIEW_H

#include "canvas.h"
#include "full_render.h"
#include "painting.h"
#include "session.h"
#include "surface.h"

#include <stdio.h>

/* How the picture stands to the one that was pinned. */
typedef enum preview_compare {
    PREVIEW_ALONE,
    PREVIEW_BESIDE,
    PREVIEW_DIFFERENCE, /* the picture minus the pinned one */
    PREVIEW_COMPARES
} preview_compare;

typedef enum preview_overlay { PREVIEW_NOTHING, PREVIEW_HELP, PREVIEW_LIST } preview_overlay;

typedef struct preview_rectangle {
    double x, y, width, height;
} preview_rectangle;

typedef struct preview {
    surface *s;
    canvas *c;
    session *work;
    session_state state;
    full_render *full;   /* NULL: none was started */
    shared_scene *first; /* the scene as it was when the preview was opened */
    FILE *picks;         /* picked values go here, a line each */

    session_wish wish;
    unsigned wished;
    view camera;   /* the wish's, or the scene's */
    frame *live;   /* NULL before the first */
    frame *pinned; /* NULL: none */
    size_t plane;  /* of live */
    size_t pinned_plane;
    char plane_name[RENDER_PLANE_NAME_SIZE];

    painting_map map;
    value_range range; /* of the colours */
    bool has_fixed_range;
    preview_compare compare;
    bool shows_histogram, shows_outlines, shows_values;
    bool prints_values; /* of the picked pixel, once the picture is exact */
    preview_overlay overlay;
    size_t list_at;            /* plane under the list's mark */
    int pick_column, pick_row; /* of the wish's columns and rows */

    double pointer_x, pointer_y; /* on the page */
    bool is_held, has_dragged;   /* a button, and the pointer since then */
    event_button held;

    session_day day;  /* of the picked pixel, if its wish and pixel are those of live */
    size_t asked_day; /* pixel whose day was asked for; SIZE_MAX: none since live came */

    int width, height; /* of the page, pixels */
    double scale;
    preview_rectangle picture; /* where the picture stands on the page */
    char note[512];            /* what the last control did */
    float *difference;         /* shape of live: the picture minus the pinned one */
    painting_scale colours, pinned_colours;
    bool is_stale; /* to be drawn anew */
    bool quits;
} preview;

/* Opens a preview of a scene on a surface: its page gets the size that a picture of columns x rows
 * needs. The surface and the scene are the caller's.
 *   plane   NULL: the first radiance
 *   picks   picked values go there
 * Fails with STATUS_ARGUMENT where the scene has none of it. */
status preview_open(preview **out, surface *s, shared_scene *of, int columns, int rows,
                    const char *plane, FILE *picks);
void preview_free(preview *p);

/* Pixels of the page around a picture of columns x rows. */
void preview_page_size(int columns, int rows, double scale, int *out_width, int *out_height);

/* Fits the picture to the page's size, and asks for it. */
void preview_resize(preview *p, int width, int height);

/* Asks for a picture of the present wish and camera. */
void preview_ask(preview *p);

/* Takes what the session has made and draws the page if something changed. Returns whether it drew. */
status preview_step(preview *p, bool *out_drew);

/* Steps until the session is at rest, that is drawn, and what was to be printed is. */
status preview_rest(preview *p);

/* Shows a plane. */
void preview_show_plane(preview *p, size_t plane);

/* Keeps the picture as it is to compare others with it. */
void preview_pin(preview *p);

/* The values that are shown: of the plane or the difference; shape of live. NULL: none. */
const float *preview_values(const preview *p);

/* The scene that is shown; before the first frame, the one that will be. */
const scene *preview_scene(const preview *p);

/* Time and mode of the wish. */
double preview_time_s(const preview *p);
bool preview_thesis(const preview *p);

/* Whether the picked pixel's day is there. */
bool preview_has_day(const preview *p);

/* Index of a pixel of the wish in a frame. */
size_t preview_pixel(const preview *p, const frame *f, int column, int row);

__attribute__((format(printf, 2, 3))) void preview_note(preview *p, const char *format, ...);

#endif
