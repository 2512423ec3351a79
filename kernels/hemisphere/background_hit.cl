#include "kernels/records.h"

/* Turns the background of every pixel into a point that the sun may reach.
 * Launch: (count). background: per pixel; hit: per pixel, facet RECORD_NONE without background */
kernel void background_hit(const uint count, global const background_record *background,
                           global hit_record *hit)
{
    const uint pixel = get_global_id(0);
    if (pixel >= count) return;

    const background_record from = background[pixel];
    hit_record to = {{0.0f, 0.0f, 0.0f}, INFINITY, from.facet, {0.0f, 0.0f, 0.0f}};
    for (int k = 0; k < 3; k++) {
        to.point[k] = from.point[k];
        to.normal[k] = from.normal[k];
    }
    hit[pixel] = to;
}
