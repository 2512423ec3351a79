/* Atmosphere: the radiance database of a scene. Thesis 2.4, Figure 2.4-3, 2.5.4, Appendix A
 * item 4 (.rad). */
#ifndef ATMOSPHERE_H
#define ATMOSPHERE_H

#include "base/status.h"
#include "files/output_file.h"

/* Spectra are in W m-2 sr-1 um-1 (the solar irradiance W m-2 um-1), n = point_count, and ascend in
 * wavelength. In shapes the last axis runs fastest. */
typedef struct atmosphere {
    char *header; /* the file's leading '#' lines, each with its line end; "" if there are none */
    double sensor_altitude_m;
    double wavelength_min_um, wavelength_max_um;
    double wavenumber_min_cm1, wavenumber_max_cm1, wavenumber_step_cm1;

    int point_count;
    double *wavelength_um, *wavenumber_cm1; /* shape (n) */
    double *solar_irradiance; /* E_S outside the atmosphere, normal to the beam: (n) */
    double *tau1;             /* sun to ground: (n) */

    int path_count;                                     /* paths from the ground to the sensor */
    double path_zenith_first_deg, path_zenith_step_deg; /* of the sensor, seen from the ground */
    double path_zenith_meaningful_deg;                  /* the largest to be used */
    double *path_range_m;                               /* (path_count) */
    double *tau2, *path_emitted, *path_scattered;       /* (path_count, n): tau2, L_uE, L_uS */

    double *sky_emitted,
        *sky_scattered; /* L_DE, L_DS integrated over the hemisphere, over pi: (n) */

    int zenith_count, azimuth_count; /* zenith 0..90; azimuth 0..360 inclusive, or 0 alone */
    double zenith_step_deg, azimuth_step_deg; /* azimuth clockwise from north; 0 if there is one */
    double *sky_emitted_direction, *sky_scattered_direction; /* (zenith_count, azimuth_count, n) */

    /* Of a container alone; counts are 0 where there are none. Targets between ground and sensor, on
     * the paths' zenith angles, which are then those at the target: (target_count, path_count, n) */
    int target_count;
    double *target_altitude_m; /* (target_count), ascend */
    double *target_range_m;    /* (target_count, path_count), to the sensor */
    double *target_tau, *target_emitted, *target_scattered;

    int range_count; /* level paths at the ground, as a camera there has: (range_count, n) */
    double *range_m; /* (range_count), ascend */
    double *range_tau, *range_emitted, *range_scattered;

    int level_count;
    double *level_altitude_m, *level_temperature_k; /* (level_count), altitudes ascend */
} atmosphere;

/* Reads a .rad file, or a container (atmosphere_container.h): W cm-2 sr-1 um-1 and km at its edge; the order of its lines stands in
 * docs/file-formats.md. Fails with STATUS_FORMAT if a transmission leaves 0..1, a radiance is
 * negative or above 1 W cm-2 sr-1 um-1, or a grid is uneven or incomplete. */
status atmosphere_read(atmosphere **out, const char *path);

/* Fails, with the reader's reason, if a file that is written and not committed yet is no database. */
status atmosphere_check_file(output_file *file);

/* Writes a .rad file, seven digits a number, without what a container alone has; the old file stays if writing fails, or if
 * atmosphere_read would refuse the new one. */
status atmosphere_write(const atmosphere *a, const char *path);

void atmosphere_free(atmosphere *a);

#endif
