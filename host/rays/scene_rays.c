#include "rays/scene_rays.h"

#include "rays/media.h"
#include "tree/bvh_cache.h"

#include <stdlib.h>

/* Fills which facets are seen from both sides; false where none is. */
static bool find_two_sided(const scene *s, uint8_t *out)
{
    bool any = false;

    for (uint32_t i = 0; i < s->shape->facet_count; i++) {
        out[i] = s->materials[s->material_of[s->shape->material[i]]].two_sided;
        any |= out[i];
    }
    return any;
}

/* The tree of all that is opaque. */
static status build_tree(bvh **out, const scene *s)
{
    status rc = STATUS_OK;
    const geometry *g = s->shape;
    uint32_t(*corner)[4] = malloc(((size_t)g->facet_count + 1) * sizeof *corner);
    uint8_t *two_sided = malloc((size_t)g->facet_count + 1);

    NEED(corner && two_sided, STATUS_MEMORY, "no memory for %u facets", g->facet_count);
    media_leave_out(s, corner);
    const bvh_source source = {.facet_count = g->facet_count,
                               .vertex_count = g->vertex_count,
                               .corner = (const uint32_t(*)[4])corner,
                               .position = (const float(*)[3])g->position,
                               .two_sided = find_two_sided(s, two_sided) ? two_sided : NULL};
    TRY(bvh_cache_build(out, &source));
out:
    free(two_sided);
    free(corner);
    return rc;
}

status scene_rays_open(ray_scene **out, device *dev, const scene *s)
{
    status rc = STATUS_OK;
    const geometry *g = s->shape;
    bvh *tree = NULL;

    TRY(build_tree(&tree, s));
    TRY(ray_scene_open(out, dev, &tree));
    /* eq. 2.3.2-6; departs: in exact mode what is opaque stops rays from behind too, but those of the
     * camera. */
    ray_scene_set_cull(*out, true, s->thesis);
    if (s->ground_material != RECORD_NONE)
        ray_scene_set_ground(*out, g->facet_count, (float)(s->ground_z_m - g->origin_m[2]));
out:
    bvh_free(tree);
    return rc;
}
