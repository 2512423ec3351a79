/* Cloud sky: what clouds leave of the sun. Three layers that reflect and let through by type, cover
 * and height of the sun: R. Shapiro, Solar radiative flux calculations from standard surface
 * meteorological observations, AFGL-TR-82-0039 (1982); its coefficients as later programs print
 * them (FASST of ERDC, AGRMET and others). The beam is what is let through less what is reflected,
 * as FASST has it. */
#ifndef CLOUD_SKY_H
#define CLOUD_SKY_H

/* Sets the shares of the clear sky's irradiance that are left, above a ground of albedo 0.2.
 *   cloud_type   as weather_record has it, above 0. High clouds: cirrus thin, cirrostratus thick;
 *                nimbostratus in two layers, as altostratus above stratus; fog as stratus, for
 *                Shapiro's own lets 0.8 of the beam through (assumed)
 *   cover        0..1
 *   out_beam     of the direct beam
 *   out_level    of all that falls on a level plane */
void cloud_sky_shares(int cloud_type, double cover, double cos_zenith, double *out_beam,
                      double *out_level);

#endif
