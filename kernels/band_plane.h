/* Band plane: where the planes of the bands stand. Those that are wanted follow each other, band by
 * band: shape (band_count, band_plane_count, band_plane_row). */
#ifndef BAND_PLANE_H
#define BAND_PLANE_H

#include "kernels/records.h"

/* The bits of the radiance's parts. */
#define BAND_PLANE_PARTS (((1u << RADIANCE_PARTS) - 1u) << BAND_PARTS)

/* How many planes a band has.
 *   wants   bit k: plane k of BAND_PLANES is there; the radiance always is */
static inline uint band_plane_count(uint wants)
{
    uint count = 0;

    for (uint k = 0; k < BAND_PLANES; k++) count += wants >> k & 1u;
    return count;
}

/* The place of a plane among those of its band. */
static inline uint band_plane_place(uint wants, uint plane)
{
    return band_plane_count(wants & ((1u << plane) - 1u));
}

/* Floats of a row: that many pixels in whole groups. */
static inline uint band_plane_row(uint pixel_count)
{
    return (pixel_count + PIXEL_GROUP - 1u) / PIXEL_GROUP * PIXEL_GROUP;
}

/* Spectra of a pixel that the wanted planes are integrals of. */
static inline uint band_plane_terms(uint wants)
{
    return wants & BAND_PLANE_PARTS ? SENSOR_TERMS : 1u;
}

#endif
