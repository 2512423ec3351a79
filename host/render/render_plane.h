/* Render planes: the planes that a render of a scene can write, by their names and units. */
#ifndef RENDER_PLANE_H
#define RENDER_PLANE_H

#include "image/image.h"
#include "scene/scene.h"

enum { RENDER_PLANE_NAME_SIZE = 160 };

typedef struct render_plane {
    char name[RENDER_PLANE_NAME_SIZE];
    image_plane plane; /* its name is the one above */
    bool is_radiance;  /* belongs to the cube; all others to the truth */
    bool is_of_band;
    bool is_surface_c; /* temperatures of surfaces in C, or NO_VALUE */
    bool is_part;      /* one of the parts of a band's radiance: computed only where it is wanted */
    uint32_t source;   /* of a band: band x BAND_PLANES + plane; else which of the others */
} render_plane;

/* Takes some values of a plane, from pixel `first` on. */
typedef struct render_store {
    status (*write)(void *self, size_t plane, uint32_t first, uint32_t count, const float *values);
    void *self;
} render_store;

/* Lists all planes of a scene: the radiances, the planes that do not depend on the band, and those
 * that do.
 *   centre_um, width_um   of the bands
 *   out                   the caller frees it; the names point into it */
status render_plane_list(render_plane **out, size_t *out_count, const scene *s,
                         const double *centre_um, const double *width_um);

/* Fails with STATUS_ARGUMENT unless the list has a plane of that name. */
status render_plane_check(const render_plane *list, size_t count, const char *name);

#endif
