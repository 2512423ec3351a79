/* What rays need to know of a scene's transmissive bodies, on host and device. */
#ifndef CROSSING_WORLD_H
#define CROSSING_WORLD_H

#include "kernels/media/transmission.h"

/* Besides the triangles. */
typedef struct medium_world {
    float low[3], high[3];              /* box of all */
    float altitude_m;                   /* of z 0, for the air's temperature */
    uint level_count;                   /* of the air */
    float stated_k[TRANSMISSION_MEDIA]; /* a material's temperature; 0: the air's at its middle */
    float broad_band_per_m[TRANSMISSION_MEDIA]; /* extinction of sunlight */
    uint scatters[TRANSMISSION_MEDIA];          /* 1: a material has a table of scattering */
} medium_world;
RECORD_SIZE(medium_world, 80);

#endif
