#include "frame.h"

#include "render/render_output.h"

#include <stdlib.h>
#include <string.h>

static bool is_kept(const frame *f, size_t plane)
{
    const render_plane *p = &f->planes[plane];

    return p->is_radiance || !p->is_of_band || f->of->s->band_count <= RENDER_OUTPUT_BANDS;
}

static status allocate_values(frame *f)
{
    status rc = STATUS_OK;
    const size_t pixels = frame_pixels(f);
    size_t kept = 0;

    for (size_t i = 0; i < f->plane_count; i++) kept += is_kept(f, i);
    f->values = calloc(f->plane_count, sizeof *f->values);
    f->memory = malloc(kept * pixels * sizeof *f->memory);
    NEED(f->values && f->memory, STATUS_MEMORY, "no memory for a picture of %d x %d pixels",
         f->camera.columns, f->camera.rows);
    kept = 0;
    for (size_t i = 0; i < f->plane_count; i++)
        if (is_kept(f, i)) f->values[i] = f->memory + kept++ * pixels;
out:
    return rc;
}

status frame_create(frame **out, shared_scene *of, const view *camera, const render_plane *planes,
                    size_t plane_count)
{
    status rc = STATUS_OK;
    frame *f = calloc(1, sizeof *f);

    NEED(f, STATUS_MEMORY, "no memory for a picture");
    atomic_init(&f->holders, 1);
    f->of = shared_scene_hold(of);
    f->camera = *camera;
    f->plane_count = plane_count;
    f->planes = malloc(plane_count * sizeof *f->planes);
    NEED(f->planes, STATUS_MEMORY, "no memory for a picture");
    memcpy(f->planes, planes, plane_count * sizeof *f->planes);
    for (size_t i = 0; i < plane_count; i++) f->planes[i].plane.name = f->planes[i].name;
    TRY(allocate_values(f));
    *out = f;
    f = NULL;
out:
    frame_drop(f);
    return rc;
}

frame *frame_hold(frame *f)
{
    atomic_fetch_add(&f->holders, 1);
    return f;
}

void frame_drop(frame *f)
{
    if (!f || atomic_fetch_sub(&f->holders, 1) != 1) return;
    shared_scene_drop(f->of);
    free(f->planes);
    free(f->values);
    free(f->memory);
    free(f);
}

size_t frame_find(const frame *f, const char *name)
{
    size_t i = 0;

    while (i < f->plane_count && strcmp(f->planes[i].name, name)) i++;
    return i;
}
