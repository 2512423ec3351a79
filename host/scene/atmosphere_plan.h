/* Atmosphere plan: what a radiance database is made from, [atmosphere.generate] of scene.toml.
 * radsig checks it; radsig-atmosphere carries it out. Thesis 2.4, 2.4.4. */
#ifndef ATMOSPHERE_PLAN_H
#define ATMOSPHERE_PLAN_H

#include "scene/scene_table.h"

enum { ATMOSPHERE_PLAN_PIECES = 8, ATMOSPHERE_PLAN_STEPS = 16 };

/* LOWTRAN's own numbers. */
typedef enum atmosphere_phase {
    ATMOSPHERE_PHASE_HENYEY_GREENSTEIN, /* of one stated asymmetry */
    ATMOSPHERE_PHASE_TABLE,
    ATMOSPHERE_PHASE_LOWTRAN
} atmosphere_phase;

typedef struct atmosphere_plan {
    bool thesis; /* golden mode: the deck of Appendix A item 2 */
    int model;   /* LOWTRAN's MODEL, 1 to 6; with a radiosonde, what that does not reach */
    const char *radiosonde;      /* NULL: none; belongs to the scene, as all paths here do */
    double inversion_altitude_m; /* up to which the surface weather bends the profile; 0: it does
                                     not */
    int aerosol;                 /* LOWTRAN's IHAZE */
    double visibility_km;        /* 0: the aerosol's own */
    atmosphere_phase phase;      /* LOWTRAN's IPH */
    double asymmetry;            /* of Henyey-Greenstein */
    const char *phase_table;
    double ground_altitude_m, sensor_altitude_m;
    double sensor_azimuth_deg; /* seen from the target, clockwise from north */
    double path_zenith_first_deg, path_zenith_last_deg, path_zenith_step_deg;
    int target_count, range_count;
    double target_altitude_m[ATMOSPHERE_PLAN_STEPS]; /* (target_count), ground to sensor */
    double range_m[ATMOSPHERE_PLAN_STEPS];           /* (range_count), of level paths */
    double wavenumber_min_cm1, wavenumber_max_cm1, wavenumber_step_cm1;
    double sample_step_cm1; /* at which LOWTRAN computes; averaged over the steps above */
    int piece_count;        /* of the spectrum, each with its albedo, by ascending wavelength */
    double albedo[ATMOSPHERE_PLAN_PIECES];
    double edge_um[ATMOSPHERE_PLAN_PIECES]; /* between pieces: (piece_count - 1) */
    double sky_zenith_step_deg, sky_azimuth_step_deg;
} atmosphere_plan;

/* Reads the table; site and camera of the scene are read before. Failures are kept by the reader.
 * A [site] with a .snd node states altitude, angles and wavenumbers where the table does not. */
void atmosphere_plan_read(atmosphere_plan *out, scene_reader *reader, const toml_node *node);

#endif
