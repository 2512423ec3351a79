/* Render: the image of a scene, tile by tile. The only room that knows the order of the stages:
 * tree, temperatures, spectra once; camera, sun, hemisphere, radiometry per tile. Thesis 2.5.5.
 *
 *   render_open(&r, scene, device);
 *   render_change_look(r, &look);  where it differs from what the scene says
 *   while (more) render_tile(r, first, count, values, NULL);
 *   render_free(r); */
#ifndef RENDER_H
#define RENDER_H

#include "device/device.h"
#include "radiance/spectra.h"
#include "render/render_plane.h"
#include "scene/scene.h"
#include "thermal/temperature.h"

#include <stdatomic.h>

typedef struct render render;

/* Builds the kernels that every render launches, which takes a while, until they are built or `is_vain`
 * is set. One that fails is built again, and told of, where it is launched. */
void render_prepare(device *dev, const atomic_bool *is_vain);

/* Does all that the pixels share. The scene and the device must outlive it. */
status render_open(render **out, const scene *s, device *dev);
void render_free(render *r);

/* Goes on with the same scene at another time of its local day: s differs from the scene that the
 * render was opened with by its time alone, and outlives it. Rays towards suns that the earlier
 * times had too are not cast again. */
status render_move(render *r, const scene *s);

/* The planes of the scene, radiances first; they belong to the render. */
const render_plane *render_planes(const render *r, size_t *out_count);

/* The most pixels that a tile should hold, at least 1: what they need on the device stays below 32 MiB,
 * whatever the number of their samples, unless one pixel needs more (scene_limits.h). */
uint32_t render_tile_limit(const render *r);

/* Computes pixels first_pixel .. first_pixel + pixel_count - 1, counted along the rows. The values
 * do not depend on how the image is cut into tiles.
 *   values   shape (plane count): the whole plane, shape (rows, columns), or NULL: not wanted
 *   store    what writes the values where they belong; NULL: they are copied
 * Fails with STATUS_MEMORY where the device has no room for the tile: try a smaller one. */
status render_tile(render *r, uint32_t first_pixel, uint32_t pixel_count, float *const *values,
                   const render_store *store);

/* How to look at the scene, where that differs from what the scene says. */
typedef struct render_look {
    view camera;
    double time_s;  /* of the sun; UTC, since 1970 */
    bool is_coarse; /* for pictures that move: few rays into the hemisphere, whose mean is the
                       background; temperatures of the facets, without planes of the sun's history */
} render_look;

/* What the scene says. */
render_look render_stated_look(const scene *s);

/* Looks in another way from the next tile on. Temperatures stay those of the scene's time. */
void render_change_look(render *r, const render_look *look);

/* The last 24 hours, up to the scene's time, of what the middle of a pixel of the present look
 * shows. Where it meets nothing the day has no steps. */
status render_pixel_day(render *r, uint32_t pixel, pixel_day *out);

/* The samples of all bands, see spectra.h; they belong to the render. */
const spectra *render_spectra(const render *r);

/* The spectra that a pixel's planes are integrals of, by the kernel that makes them; of several
 * samples the mean.
 *   out   shape (SENSOR_TERMS, sample_count), W m-2 sr-1 um-1, tau2 1; the caller allocates */
status render_pixel_terms(render *r, uint32_t pixel, double *out);

/* Seconds of the stages before the first tile, on the host. */
typedef struct render_stage {
    const char *name;
    double seconds;
} render_stage;
const render_stage *render_stages(const render *r, size_t *out_count);

#endif
