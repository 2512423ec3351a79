/* Emissivity: a material's, over view angle and wavelength: a table of both (.ems, Appendix A item 7), or a
 * measured spectrum with a law of angle. */
#ifndef EMISSIVITY_H
#define EMISSIVITY_H

#include "material/wavenumber_rows.h"
#include "spectrum/spectral_curve.h"

#include <stdint.h>

enum { EMISSIVITY_ANGLES = 91 /* 0, 1, .. 90 degrees from the normal, as the device has them */ };

/* How it changes with angle. */
typedef enum emissivity_law {
    EMISSIVITY_CONSTANT, /* not at all */
    EMISSIVITY_FRESNEL,  /* as that of a dielectric which has the normal value */
    EMISSIVITY_ROUGH,
    EMISSIVITY_THESIS,   /* flat to 60 degrees, 0 at 90 */
    EMISSIVITY_MEASURED, /* straight between the angles of the table, the last value beyond them */
    EMISSIVITY_OPTICAL   /* Fresnel's formulas of n and k */
} emissivity_law;

typedef struct emissivity {
    wavelength_grid grid;
    emissivity_law law;
    size_t angle_count; /* rows: 1 unless measured; of optical constants 2, n and k */
    double *angle_deg;  /* shape (angle_count), ascends; NULL unless measured */
    float *value;       /* shape (angle_count, grid.count): 0..1; n and k */
    double outside;     /* where nothing was measured; not-a-number: the nearest value */
} emissivity;

/* Reads an .ems file; leading lines that start with '#' are passed over. Values beyond 0
 * and 1 by 0.02 at most are cut there, with a warning. */
status emissivity_read(emissivity **out, const char *path);
void emissivity_free(emissivity *e);

/* Makes it of curves: of one for all angles, or of one an angle, which stand on the wavelengths of the first.
 *   angle_deg   shape (count), ascends; NULL: count is 1, and `law` is not EMISSIVITY_MEASURED
 * Fails with STATUS_MEMORY. */
status emissivity_make(emissivity **out, spectral_curve *const *curve, const double *angle_deg,
                       size_t count, emissivity_law law);

/* Rows of its table on the device: EMISSIVITY_ANGLES, or 1 where it does not depend on angle. */
uint32_t emissivity_rows(const emissivity *e);

/* Its value in one direction. */
double emissivity_at(const emissivity *e, double wavenumber_cm1, double angle_deg);

/* Its values at wavenumbers.
 *   out   shape (emissivity_rows, count) */
void emissivity_sample(const emissivity *e, const double *wavenumber_cm1, uint32_t count,
                       float *out);

/* Integrates the normal one over wavelength, um: exact where it is straight in wavelength. */
double emissivity_integral(const emissivity *e, double from_um, double to_um);

#endif
