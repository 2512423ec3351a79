/* Thermal model: weather and matter on the device, as `thermal` and `exchange` work with them. */
#ifndef THERMAL_MODEL_H
#define THERMAL_MODEL_H

#include "thermal/thermal.h"

struct thermal {
    device *dev;
    material_record *material;
    layered_matter *layered; /* NULL: as THERM does it */
    double mean_air_k;
    bool thesis; /* THERM as it is reconstructed */
    material_record_buffer materials;
    forcing_record_buffer forcing;
    float_buffer power;       /* shape (steps, power_materials) */
    uint32_t power_materials; /* 0: no material's power changes */
    size_t step_count;
    double step_s, time_h;    /* of the image, since the first step */
    exchange_tables exchange; /* heat along facets, and longwave that reaches them */
    float *sky_fraction;      /* shape (received_columns): of the views */
};

/* What acts on facets.
 *   lit   as lit.h has it; NULL: always lit */
load_tables thermal_loads(const thermal *t, uint_buffer lit);

/* Launches of facets that go through the weather, by lanes. */
device_shape thermal_shape(const thermal *t, size_t facet_count);

/* Puts the ladders of facets on the device. */
status thermal_upload_layered(const thermal *t, const facet_record *facet, size_t count,
                              layered_record_buffer *out);

#endif
