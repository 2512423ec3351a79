/* Cloud: extinction, single-scattering albedo and asymmetry of LOWTRAN's five water clouds. Thesis
 * 2.4.3, Table 2.4.3-1, eq. 2.4.3-1..4, Appendix B, Appendix A item 8. */
#ifndef CLOUD_H
#define CLOUD_H

#include "material/wavenumber_rows.h"

enum { CLOUD_COUNT = 5 };

typedef struct cloud_model {
    const char *name;
    int icld;               /* LOWTRAN's number */
    double base_km, top_km; /* Table 2.4.3-1 */
} cloud_model;

/* cumulus, altostratus, stratus, stratocumulus, nimbostratus */
extern const cloud_model cloud_models[CLOUD_COUNT];

/* Means over the layer at the wavenumbers of an .ext file. */
typedef struct cloud {
    double broad_band_per_m; /* extinction, weighted by the sun outside the atmosphere */
    double per_m[WAVENUMBER_ROWS];
    double albedo[WAVENUMBER_ROWS];    /* single-scattering, 0..1 */
    double asymmetry[WAVENUMBER_ROWS]; /* -1..1 */
} cloud;

/* Runs LOWTRAN along level paths of 20 m through the cloud and through the same air without it
 * (mid-latitude summer, rural aerosol), every 2 % of the layer: short enough that no wavenumber is
 * opaque, where the thesis' vertical paths lose the cloud. LOWTRAN saturates the air in a cloud, so
 * in the bands of water vapour that vapour is part of the extinction. */
status cloud_compute(cloud **out, const cloud_model *model);
void cloud_free(cloud *c);

/* Writes an .ext file. */
status cloud_write_extinction(const cloud *c, const cloud_model *model, const char *path);

/* Writes wavenumber_cm1,single_scattering_albedo,asymmetry. */
status cloud_write_scattering(const cloud *c, const cloud_model *model, const char *path);

#endif
