/* Clear sky: irradiance at the ground, broad band. Bird and Hulstrom, SERI/TR-642-761 (1981). */
#ifndef CLEAR_SKY_H
#define CLEAR_SKY_H

/* Broad-band optical depth of a clear mid-latitude aerosol: 0.15 at 0.38 um, 0.1 at 0.5 um. */
#define CLEAR_SKY_AEROSOL (0.27583 * 0.15 + 0.35 * 0.1)

typedef struct clear_sky_air {
    double pressure_pa;
    double water_cm; /* precipitable water */
    double aerosol;  /* broad-band optical depth */
} clear_sky_air;

/* Computes the irradiance for 0.3 cm of ozone and a ground albedo of 0.2; zero when the sun is below
 * the horizon.
 *   out_direct_w_m2   normal to the beam
 *   out_diffuse_w_m2  on a level plane, with what goes to and fro between ground and sky */
void clear_sky_irradiance(const clear_sky_air *air, double zenith_rad, double distance_au,
                          double *out_direct_w_m2, double *out_diffuse_w_m2);

#endif
