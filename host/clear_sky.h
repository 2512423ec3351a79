/* Clear sky: irradiance at the ground, broad band. Bird and Hulstrom, SERI/TR-642-761 (1981). */
#ifndef CLEAR_SKY_H
#define CLEAR_SKY_H

/* Computes the irradiance for .3 cm of ozone, a clear mid-latitude aerosol and a ground albedo of
 * .2; zero when the sun is below the horizon.
 *   water_cm          precipitable water
 *   out_direct_w_m2   normal to the beam
 *   out_diffuse_w_m2  on a level plane, with what goes to and fro between ground and sky */
void clear_sky_irradiance(double zenith_rad, double distance_au, double pressure_pa,
                          double water_cm, double *out_direct_w_m2, double *out_diffuse_w_m2);

#endif
