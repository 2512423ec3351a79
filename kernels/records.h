/* Records that host and device share: the same bytes in C11, C++17, OpenCL C and numpy.
 * Scalars and arrays of scalars only; lengths m, angles rad, temperatures K unless a name says
 * more. Positions are in the scene's ENU frame (x east, y north, z up) minus the geometry's origin.
 */
#ifndef RECORDS_H
#define RECORDS_H

#include "kernels/dialect.h"

/* Index of "no facet" and "no material". */
#define RECORD_NONE 0xffffffffu

/* A node of the flattened tree; 64-byte aligned.
 *   low, high   boxes of the 8 children, axis by axis; an empty child has low 1e30, high -1e30
 *   child       bit 31: leaf, then block << 4 | how many of its first triangles are long << 1 | 1 where
 *               it has any; else the index of a node
 *   order       per octant of the ray direction (bit 0 x, 1 y, 2 z negative): children near to far,
 *               4 bits each, the nearest in the lowest */
typedef struct bvh_node {
    float low[3][8];
    float high[3][8];
    uint child[8];
    uint order[8];
} bvh_node;
RECORD_SIZE(bvh_node, 256);

#define BVH_LEAF 0x80000000u

/* Where it stops counting long triangles. */
#define BVH_LONG_LIMIT 7u

/* Entries that a ray's stack can need; the builder keeps to it. */
#define RAY_STACK_SIZE 256

/* Eight triangles of a leaf; 64-byte aligned. A quad is two triangles with the same facet.
 *   vertex   shape (vertex 0..2, axis, lane)
 *   facet    index of the facet, RECORD_NONE pads, the vertices of which are nan */
typedef struct bvh_block {
    float vertex[3][3][8];
    uint facet[8];
} bvh_block;
RECORD_SIZE(bvh_block, 320);

/* Points that a work-item looks at where rays go in packets: hemisphere.cl, sun_history.cl,
 * incident.cl. */
#define RAY_BUNDLE 64u

/* What a ray met. */
typedef struct hit_record {
    float point[3];  /* on the facet, from barycentrics */
    float range_m;   /* along the ray in lengths of its direction; INFINITY for a miss */
    uint facet;      /* index of the facet or RECORD_NONE */
    float normal[3]; /* unit, turned towards the ray's origin */
} hit_record;
RECORD_SIZE(hit_record, 32);

/* A facet as thermal and radiometry see it. */
typedef struct facet_record {
    float normal[3];   /* unit, outward */
    uint material;     /* index of the material */
    float slope_rad;   /* 0 level and facing up, pi facing down */
    float azimuth_rad; /* of the normal, clockwise from north, 0 .. 2 pi */
    float thickness_m;
    float power_w_m2;                     /* self-generated */
    float stated_temperature_k;           /* 0: to be computed */
    uint two_sided;                       /* 1: both sides are seen and lit */
    uint lateral_column, received_column; /* see layered.h */
} facet_record;
RECORD_SIZE(facet_record, 48);

/* What a facet conducts along its material to the facets beyond its edges; conduction.h. */
typedef struct conduction_record {
    uint neighbour[4]; /* RECORD_NONE: none */
    float link_w_k[4]; /* to each of them */
    float stated_w_k;  /* to neighbours that keep a temperature, */
    float stated_k;    /* and their mean temperature */
    float area_m2;
    uint unused;
} conduction_record;
RECORD_SIZE(conduction_record, 48);

/* What a facet sees, for the longwave that reaches it; irradiation.cl. */
typedef struct view_record {
    uint first, count; /* of the facets that it sees */
    float sky, below;  /* shares of the sky, and of what is neither sky nor facet */
} view_record;
RECORD_SIZE(view_record, 16);

/* A material as thermal and radiometry see it. */
typedef struct material_record {
    float density_kg_m3;
    float specific_heat_j_kg_k;
    float conductivity_w_m_k;
    float solar_absorptance;
    float thermal_emissivity;
    float exposed_area;     /* |A|: exposed fraction of both sides; negative: conductive slab */
    float specular_share;   /* 0 diffuse .. 1 specular */
    uint emissivity_first;  /* first row of the material in the emissivity table */
    uint emissivity_angles; /* rows: 91 (0..90 degrees) or 1 (the same at all angles) */
    uint number;            /* material code as written in planes */
    uint lobe_first; /* first row of its diffuse lobe in that table, RECORD_NONE: Lambertian */
    float roughness; /* of the specular fraction: 0 a mirror .. 1 */
    float melts_k;   /* its surface gets no warmer; 0: it does not melt */
    uint unused[3];
} material_record;
RECORD_SIZE(material_record, 64);

/* One step of the weather as the thermal model uses it. */
typedef struct forcing_record {
    float air_temperature_k;
    float sky_longwave_w_m2; /* downwelling on a level plane under an open sky */
    float convection_w_m2_k;
    float direct_w_m2;  /* sun, normal to the beam; 0 below the horizon */
    float diffuse_w_m2; /* sky, on a level plane */
    float sun[3];       /* unit vector towards the sun */
    float rain_w_m2_k;  /* rho_w c_w R: heat that rain brings per kelvin */
    float rain_temperature_k;
    float specific_humidity; /* of the air, kg of vapour per kg */
    float pressure_pa;
    uint convection_law; /* CONVECTION_..., see convection.h, as for the next three */
    float buoyancy, roughness, plate_w_m2_k;
    float wet_below_k; /* what is colder may get wet of the air's vapour; 0: nothing does */
    uint unused[3];
} forcing_record;
RECORD_SIZE(forcing_record, 80);

/* Which temperatures to compute: see thermal.cl. Row r holds the temperature at step first_step + r - 1 + weight, linear between
 * steps; at step 0 the weight is 1. */
typedef struct thermal_span {
    uint facet_count;
    uint first_step;
    uint row_count;
    uint sunlit_words; /* words per facet in the sunlit mask; 0: no mask, always lit */
    float weight;      /* above 0, at most 1 */
    float step_s;
    uint sunlit_period; /* steps after which the mask begins anew; 0: never */
    uint step_count;    /* of the weather */
} thermal_span;
RECORD_SIZE(thermal_span, 32);

/* Rays leave surfaces by the rounding of their scene's coordinates, or of this one where those are
 * larger. */
#define RAY_OFFSET_REACH_M 4096.0f

/* What rays need of a scene besides its triangles. */
typedef struct world_record {
    uint ground_facet; /* facet of the endless level plane, RECORD_NONE without one */
    float ground_z_m;
    float offset_m; /* rays that leave a surface start this far above it at least; ray_leaving */
    uint cull_back; /* 1: facets are met from the front alone, where they run counter-clockwise */
} world_record;
RECORD_SIZE(world_record, 16);

/* The hemisphere above a point: how much sky it sees, and what hides the rest. */
typedef struct background_record {
    float shape_factor;       /* 0 .. 1 = open sky */
    float mean_temperature_k; /* of the facets met, every ray counts the same; 0 without any */
    uint material;            /* index of the commonest material met or RECORD_NONE */
    uint facet;               /* the first facet met of that material or RECORD_NONE */
    float point[3];           /* where it was met */
    float normal[3];          /* of that facet, unit, turned towards the point */
    uint met_count;           /* rays that met a facet or the ground */
    uint unused;
} background_record;
RECORD_SIZE(background_record, 48);

/* Pinhole camera: ray of pixel (column, row) from its centre, row 0 on top:
 *   direction = corner + (column + 0.5) across + (row + 0.5) down, then normalised.
 * Orthographic: all directions are `corner`, and position + (column + 0.5) across + (row + 0.5) down is
 * the ray's origin. The picture may be a part of the frame: its pixel (0, 0) is the frame's
 * (first_column, first_row). With several samples_per_side a pixel is that many samples across and down, and
 * what is said of pixels holds for samples: those of a pixel stand together. */
typedef struct camera_record {
    float position[3];
    float corner[3];
    float across[3];
    float down[3];
    uint first_column, first_row;
    uint is_orthographic;
    uint samples_per_side; /* 0 or 1: one sample, in the middle of the pixel */
    uint seed;             /* of the samples' places in their samples_per_side */
    uint unused[3];
} camera_record;
RECORD_SIZE(camera_record, 80);

/* What all pixels of a frame share in the radiance equations. */
typedef struct radiometry_record {
    uint columns;     /* of the image */
    uint first_pixel; /* of the tile, counted along the rows; see camera_record on samples */
    uint pixel_count; /* of the tile */
    uint band_count;
    uint sample_count; /* of all bands together: length of a row of the spectra, a multiple of 16 */
    uint thesis;       /* 1: emissivity at the nearest degree, of diffuse targets at 0 */
    uint path_count;   /* zenith angles of paths */
    float path_zenith_first_deg;
    float path_zenith_step_deg;
    uint zenith_count, azimuth_count; /* directions of the sky */
    float zenith_step_deg, azimuth_step_deg;
    float sun[3];     /* unit vector towards the sun */
    uint wants;       /* planes of the bands, a bit each; see band_plane.h */
    uint first_group; /* of a launch over groups of PIXEL_GROUP pixels, counted in the tile */
    uint knot_count;  /* length of a row of what reaches surfaces: see knots.h of host/ */
    uint knot_span;   /* knots that a block of samples lies between; 0: every sample is a knot */
} radiometry_record;
RECORD_SIZE(radiometry_record, 80);

/* Paths through the air that end elsewhere than on the ground below the sensor. Rows of the spectra
 * from `first_row` on: for every altitude path_count optical depths up to the sensor, the same of
 * radiance; then for every range an optical depth, and the same of radiance. */
#define AIR_STEPS 20u
typedef struct air_record {
    uint first_row;
    uint altitude_count; /* 0: none; the first is the ground's, the last the sensor's */
    uint range_count;    /* of level paths at the ground, 0: none; the first is 0 */
    uint is_level;       /* 1: the sensor is below the scene's top */
    float ground_z_m;
    uint unused[3];
    float altitude_z_m[AIR_STEPS]; /* ascend */
    float range_m[AIR_STEPS];      /* ascend */
} air_record;
RECORD_SIZE(air_record, 192);

/* Rows of the spectra, each of sample_count floats; behind them stand path_count rows of tau2,
 * path_count rows of path radiance, zenith_count x azimuth_count rows of sky radiance, and those of
 * air_record. */
#define SPECTRA_WEIGHT 0u        /* response x quadrature, of all bands together, um */
#define SPECTRA_PLANCK_FIRST 1u  /* 2 h c^2 / l^5, W m-2 sr-1 um-1 */
#define SPECTRA_PLANCK_SECOND 2u /* h c / (k l), K */
#define SPECTRA_SUN 3u           /* E_S tau1, W m-2 um-1 */
#define SPECTRA_SKY 4u           /* L_DE + L_DS, integrated over the hemisphere */
#define SPECTRA_PATHS 5u

/* Samples side by side in the rows that are taken at once. */
#define SPECTRA_BLOCK 16u

/* Facets near a point that its hemisphere counts by their form factors, at most; see near_facets.cl. */
#define NEAR_FACETS 12u

/* Knots (host/radiance/spectral_grid.h) that have one value of the light between facets. */
#define LIGHT_BLOCK 4u

/* Directions of the sky, times rings of lobes, that one surface can count. */
#define INCIDENT_WEIGHTS 1024u

/* Rows of the sky's dome, points of a quadrature: direction (3), solid angle, sr; the four directions of
 * the table around each, and their shares. */
#define DOME_SOLID_ANGLE 3u
#define DOME_CORNERS 4u
#define DOME_ROWS 12u

/* Rows of a facet's light, see interreflection.cl: its lobe of the sun, radiance beyond the closure; and
 * what reaches it but for the sun, what the sun adds where it shines, a black body's radiance. */
#define LIGHT_LOBE 0u
#define LIGHT_EXTRA 1u
#define LIGHT_ARRIVING 2u
#define LIGHT_SUN 3u
#define LIGHT_BLACK 4u
#define LIGHT_ROWS 5u

/* What interreflection.cl does with what reached facets before: of the last five depths it keeps the first
 * and the third, to add what depths beyond the last would bring. */
#define INTERREFLECTION_KEEPS_NONE 0u
#define INTERREFLECTION_KEEPS_FIRST 1u
#define INTERREFLECTION_KEEPS_MIDDLE 2u
#define INTERREFLECTION_ADDS_TAIL 3u

/* How radiance that reaches surfaces is summed up, see incident.cl. */
typedef struct incident_record {
    uint cell_count;   /* of the hemisphere */
    uint dome_count;   /* points of the sky, a multiple of 16: those that pad have no solid angle */
    uint ring_count;   /* rings of diffuse lobes; divides the rings of cells */
    uint light_length; /* floats of a row of the facets' light */
    uint
        is_of_facets; /* 1: all surfaces are taken as diffuse, and light has a float a sample; 0: it
                          has one a LIGHT_BLOCK of samples */
    uint keeps_sky;   /* 1: what the sky brings is there already; of facets alone */
    uint unused[2];
} incident_record;
RECORD_SIZE(incident_record, 32);

/* A band of the sensor: a run of the samples that all bands share. */
typedef struct band_record {
    uint first_sample;
    uint sample_count;  /* those between that are not the band's have weight 0 */
    float gain, offset; /* counts = gain x radiance in band + offset */
    float width_um;     /* sum of the weights */
    uint is_mean;       /* 1: the radiance plane holds radiance in band / width */
    uint first_weight;  /* where the band's own weights begin */
    uint unused;
} band_record;
RECORD_SIZE(band_record, 32);

/* Band radiance of a black body: ln L at BAND_TEMPERATURES temperatures, evenly spaced in ln T. */
#define BAND_TEMPERATURES 1024u
#define BAND_LOWEST_K 1.0f
#define BAND_HIGHEST_K 20000.0f

/* Planes per band, and those that there are once. */
#define BAND_PLANES 12u
#define BAND_RADIANCE 0u
#define BAND_COUNTS 1u
#define BAND_APPARENT 2u
#define BAND_EMISSIVITY 3u
#define BAND_BACKGROUND_EMISSIVITY 4u
#define BAND_PARTS 5u     /* the first of the parts of the radiance */
#define BAND_TAU2 10u     /* the last of them */
#define RADIANCE_PARTS 6u /* emitted, of the sun, the sky, the background; path, tau2 */
#define BAND_STDERR 11u   /* of the radiance; written for pixels of several samples */
#define TRUTH_PLANES 11u
#define SUN_PLANES 2u /* behind those: of the sun's history */

/* Spectra of a pixel at the sensor: its RADIANCE_PARTS where they are wanted, then the radiance. */
#define SENSOR_TERMS (RADIANCE_PARTS + 1u)

/* Pixels that stand side by side in their spectra, and to which rows of the bands' planes are padded. */
#define PIXEL_GROUP 16u

/* Where an emissivity of a pixel stands: between two rows of the table. */
typedef struct emissivity_record {
    uint low, high; /* RECORD_NONE: there is none */
    float fraction; /* of the second, 0..1 */
    uint unused;
} emissivity_record;
RECORD_SIZE(emissivity_record, 16);

/* A band of the detectors; radiances in the unit of its plane. */
typedef struct detector_record {
    uint seed, frame, band; /* what random numbers are keyed by */
    uint columns, count;    /* detectors of a row, of the launch */
    uint last_count;        /* 2^bits - 1; 0: not quantised */
    float noise;            /* standard deviation */
    float shot;             /* variance per radiance */
    float fixed_gain;       /* standard deviations over the detectors: a fraction, a radiance */
    float fixed_offset;
    float periodic;                 /* amplitude */
    float waves_across, waves_down; /* per detector */
    float gain, offset;             /* count = gain x radiance + offset */
    uint first;                     /* detector, of all, that the launch begins with */
} detector_record;
RECORD_SIZE(detector_record, 64);

/* How the pixels of a picture fall on detectors, see blur.cl. */
typedef struct blur_record {
    uint columns, rows; /* detectors of the launch */
    uint step;          /* pixels of a detector, across and down */
    uint picture_columns, picture_rows;
    uint weight_columns, weight_rows;
    int first_column, first_row;
    uint first;  /* row of detectors, of all, that the launch begins with */
    int present; /* row of the picture that the buffer begins with */
    uint unused;
} blur_record;
RECORD_SIZE(blur_record, 48);

/* What stands in a plane where a pixel has no value. */
#define NO_VALUE (-9999.0f)

#endif
