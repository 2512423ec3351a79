/* Layered: what stands behind a surface, and the ladder of nodes that the layered thermal model
 * makes of it. Beyond the thesis; equations in kernels/thermal/layered.h. */
#ifndef LAYERED_H
#define LAYERED_H

#include "base/status.h"
#include "kernels/records.h"
#include "kernels/thermal/layered.h"

#include <stddef.h>

/* Layers behind the facet's own. */
enum { LAYERED_LAYERS_BEHIND = 3 };

/* To evaporation. */
#define LAYERED_RESISTANCE_MOST_S_M 1e6

typedef struct layered_layer {
    double thickness_m, conductivity_w_m_k, capacity_j_m3_k;
} layered_layer;

typedef enum layered_back {
    LAYERED_BACK_BY_AREA, /* air where both sides are exposed (|exposed area| above 0.75), else no
                             heat passes (assumed) */
    LAYERED_BACK_ADIABATIC,
    LAYERED_BACK_AIR,
    LAYERED_BACK_STATED, /* the back face keeps a temperature */
    LAYERED_BACK_GROUND  /* the same, the last layer reaching to 1 m below the surface */
} layered_back;

/* What a material has for this model, besides its record. */
typedef struct layered_matter {
    size_t layer_count;
    layered_layer layer[LAYERED_LAYERS_BEHIND]; /* from the front to the back */
    layered_back back;
    double back_k;                                   /* not a number: the weather's mean air */
    double resistance_day_s_m, resistance_night_s_m; /* not a number: dry */
} layered_matter;

/* Returns a matter of no further layer, dry, with its back by area. */
layered_matter layered_matter_default(void);

/* Fills the record of a facet but for its view: eight nodes, each half as thick again as the one
 * before it.
 *   mean_air_k   for backs that state no temperature
 * Thickness is above 0. Without conductivity a material has one temperature through and through. */
void layered_fill(layered_record *out, const facet_record *facet, const material_record *material,
                  const layered_matter *matter, double mean_air_k);

#endif
