/* Camera: the ray of a pixel. Thesis 2.5.3. */
#ifndef CAMERA_H
#define CAMERA_H

#include "records.h"

/* Where the ray of a pixel starts.
 *   pixel   counted along the rows of the picture, which is `columns` wide */
static inline void camera_origin(camera_record camera, uint columns, uint pixel, float *out)
{
    const float column = (float)(pixel % columns + camera.first_column) + 0.5f;
    const float row = (float)(pixel / columns + camera.first_row) + 0.5f;

    for (int k = 0; k < 3; k++)
        out[k] = camera.is_orthographic
                     ? camera.position[k] + column * camera.across[k] + row * camera.down[k]
                     : camera.position[k];
}

/* Its direction, not of unit length. */
static inline void camera_direction(camera_record camera, uint columns, uint pixel, float *out)
{
    const float column = (float)(pixel % columns + camera.first_column) + 0.5f;
    const float row = (float)(pixel / columns + camera.first_row) + 0.5f;

    for (int k = 0; k < 3; k++)
        out[k] = camera.is_orthographic
                     ? camera.corner[k]
                     : camera.corner[k] + column * camera.across[k] + row * camera.down[k];
}

/* The direction in which the camera sees a point, not of unit length. */
static inline void camera_towards(camera_record camera, const float *point, float *out)
{
    for (int k = 0; k < 3; k++)
        out[k] = camera.is_orthographic ? camera.corner[k] : point[k] - camera.position[k];
}

#endif
