/* Render summary: gathers for NAME.json what a render was made from and how long it took. */
#ifndef RENDER_SUMMARY_H
#define RENDER_SUMMARY_H

#include "render/render_pool.h"
#include "render/render_report.h"

typedef struct render_summary {
    const scene *s;
    const char *scene_path;
    const render_plane *planes;
    float *const *values; /* shape (plane_count): NULL: the plane was not written */
    size_t plane_count;
    const image *sensor;          /* NULL: none was written */
    const image_label *materials; /* shape (s->material_count) */
    render_pool *pool;
    double start_s; /* monotonic clock */
} render_summary;

/* Writes the report. The warnings so far stand in it and stay to be printed. */
status render_summary_write(output_folder *folder, const char *name, const render_summary *summary);

#endif
