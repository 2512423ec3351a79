#include "kernels/sensor/detector.h"

/* What the detectors make of the radiance that falls on them: pattern, noise, counts.
 * Launch: (detector.count). radiance, out: (count), in the plane's unit, may be the same buffer */
kernel void detector(const detector_record record, global const float *radiance, global float *out)
{
    const uint i = get_global_id(0);
    if (i >= record.count) return;
    const uint place = record.first + i;
    const float patterned = detector_pattern(&record, place, radiance[i]);
    out[i] = detector_quantise(&record, detector_noise(&record, place, patterned));
}
