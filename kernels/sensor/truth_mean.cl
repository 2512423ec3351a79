#include "kernels/sensor/samples.h"

/* Planes of pixels from those of their samples: the commonest number of things, the mean of all else.
 * Launch: (pixel_count, plane count).
 * categorical: bit k for plane k; samples: shape (plane count, pixel_count, sample_count)
 * planes: shape (plane count, pixel_count) */
kernel void truth_mean(const uint pixel_count, const uint sample_count, const uint categorical,
                       global const float *samples, global float *planes)
{
    const uint pixel = get_global_id(0), plane = get_global_id(1);
    if (pixel >= pixel_count) return;

    const size_t at = (size_t)plane * pixel_count + pixel;
    global const float *own = samples + at * sample_count;
    planes[at] = categorical >> plane & 1u ? samples_mode(own, sample_count)
                                           : samples_mean(own, sample_count);
}
