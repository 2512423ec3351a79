/* Camera: the ray of a pixel. Thesis 2.5.3. */
#ifndef CAMERA_H
#define CAMERA_H

#include "kernels/random.h"
#include "kernels/records.h"

/* Column and row in the frame where the ray of a pixel or sample passes: the middle of the pixel, or a
 * random place in the sample's stratum, which follows from the frame's pixel, sample and seed alone. */
static inline void camera_place(camera_record camera, uint columns, uint pixel, float *out)
{
    const uint samples_per_side = camera.samples_per_side > 1u ? camera.samples_per_side : 1u;
    const uint sample = pixel % (samples_per_side * samples_per_side),
               whole = pixel / (samples_per_side * samples_per_side);
    const uint column = whole % columns + camera.first_column;
    const uint row = whole / columns + camera.first_row;
    const uint key[2] = {camera.seed, RANDOM_PIXEL};
    uint word[4] = {column, row, sample, 0u};
    float across = 0.5f, down = 0.5f;

    if (samples_per_side > 1u) {
        random_words(key, word);
        across = ((float)(sample % samples_per_side) + random_uniform(word[0])) /
                 (float)samples_per_side;
        down = ((float)(sample / samples_per_side) + random_uniform(word[1])) /
               (float)samples_per_side;
    }
    out[0] = (float)column + across;
    out[1] = (float)row + down;
}

/* Where the ray of a pixel starts.
 *   pixel   counted along the rows of the picture, which is `columns` wide */
static inline void camera_origin(camera_record camera, uint columns, uint pixel, float *out)
{
    float at[2];

    camera_place(camera, columns, pixel, at);
    for (int k = 0; k < 3; k++)
        out[k] = camera.is_orthographic
                     ? camera.position[k] + at[0] * camera.across[k] + at[1] * camera.down[k]
                     : camera.position[k];
}

/* Its direction, not of unit length. */
static inline void camera_direction(camera_record camera, uint columns, uint pixel, float *out)
{
    float at[2];

    camera_place(camera, columns, pixel, at);
    for (int k = 0; k < 3; k++)
        out[k] = camera.is_orthographic
                     ? camera.corner[k]
                     : camera.corner[k] + at[0] * camera.across[k] + at[1] * camera.down[k];
}

/* The direction in which the camera sees a point, not of unit length. */
static inline void camera_towards(camera_record camera, const float *point, float *out)
{
    for (int k = 0; k < 3; k++)
        out[k] = camera.is_orthographic ? camera.corner[k] : point[k] - camera.position[k];
}

#endif
