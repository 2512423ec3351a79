#include "kernels/records.h"

/* Gives pixels the temperatures of the facets that they see.
 * Launch: (count). hit: per pixel; temperature_k: per facet; out_k: (count), 0 without a facet;
 * planes: shape (first_plane + SUN_PLANES, count), the last SUN_PLANES become NO_VALUE */
kernel void facet_temperature(const uint count, const uint first_plane,
                              global const hit_record *hit, global const float *temperature_k,
                              global float *out_k, global float *planes)
{
    const uint pixel = get_global_id(0);
    if (pixel >= count) return;

    const uint facet = hit[pixel].facet;
    out_k[pixel] = facet == RECORD_NONE ? 0.0f : temperature_k[facet];
    for (uint k = 0; k < SUN_PLANES; k++)
        planes[(size_t)(first_plane + k) * count + pixel] = NO_VALUE;
}
