/* Frame: the planes of one picture, coarse or exact, with all that is needed to explain it. Once it
 * is rendered it does not change; several can hold it. */
#ifndef FRAME_H
#define FRAME_H

#include "render/render.h"
#include "shared_scene.h"

typedef struct frame {
    atomic_int holders;
    shared_scene *of;
    view camera;    /* columns and rows are the frame's */
    double time_s;  /* of the sun; a coarse frame's temperatures may be of another time */
    bool is_exact;  /* every pixel as render writes it */
    unsigned wish;  /* number of the wish that it answers */
    double seconds; /* that it took */
    size_t plane_count;
    render_plane *planes; /* shape (plane_count) */
    float **values;       /* shape (plane_count): (rows, columns), or NULL: not computed */
    float *memory;
} frame;

/* Copies the list of planes. The radiances and the planes that do not depend on the band have values;
 * those that do have them up to RENDER_OUTPUT_BANDS bands. */
status frame_create(frame **out, shared_scene *of, const view *camera, const render_plane *planes,
                    size_t plane_count);

/* Returns it, held once more. */
frame *frame_hold(frame *f);
void frame_drop(frame *f);

/* Index of the plane of a name, or plane_count. */
size_t frame_find(const frame *f, const char *name);

static inline size_t frame_pixels(const frame *f)
{
    return (size_t)f->camera.columns * (size_t)f->camera.rows;
}

#endif
