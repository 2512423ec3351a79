/* Detector: what noise and quantisation make of a radiance. Thesis 4.0 item 9; Schott and
 * Salvaggio, 1987. */
#ifndef DETECTOR_H
#define DETECTOR_H

#include "kernels/random.h"
#include "kernels/records.h"

/* Kinds of random numbers, the third word of a counter. */
#define DETECTOR_NOISE 0u /* new in every frame */
#define DETECTOR_FIXED 1u /* of the detector, whatever the frame */

static inline void detector_normals(const detector_record *d, uint detector, uint frame, uint kind,
                                    float *out)
{
    const uint key[2] = {d->seed, d->band};
    uint word[4] = {detector, frame, kind, 0u};

    random_words(key, word);
    random_normals(word, out);
}

/* Gain and offset that differ from detector to detector, and a wave over the whole picture. */
static inline float detector_pattern(const detector_record *d, uint detector, float radiance)
{
    const float column = (float)(detector % d->columns), row = (float)(detector / d->columns);
    const float waves = column * d->waves_across + row * d->waves_down;
    float normal[2];

    detector_normals(d, detector, 0u, DETECTOR_FIXED, normal);
    return radiance * (1.0f + d->fixed_gain * normal[0]) + d->fixed_offset * normal[1] +
           d->periodic * sin(2.0f * PI_F * (waves - floor(waves)));
}

/* Noise of one variance, and shot noise whose variance goes with the radiance. */
static inline float detector_noise(const detector_record *d, uint detector, float radiance)
{
    const float shot = d->shot * (radiance > 0.0f ? radiance : 0.0f);
    float normal[2];

    detector_normals(d, detector, d->frame, DETECTOR_NOISE, normal);
    return radiance + sqrt(d->noise * d->noise + shot) * normal[0];
}

/* The radiance of the nearest count that there is. */
static inline float detector_quantise(const detector_record *d, float radiance)
{
    const float count = rint(d->gain * radiance + d->offset);
    const float most = (float)d->last_count;

    if (d->last_count == 0u) return radiance;
    return ((count < 0.0f ? 0.0f : count > most ? most : count) - d->offset) / d->gain;
}

#endif
