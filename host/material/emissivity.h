/* Emissivity: a material's table over view angle and wavenumber. Appendix A item 7 (.ems). */
#ifndef EMISSIVITY_H
#define EMISSIVITY_H

#include "material/wavenumber_rows.h"

enum {
    EMISSIVITY_ANGLES = 91, /* 0, 1, .. 90 degrees from the normal */
    EMISSIVITY_WAVENUMBERS = WAVENUMBER_ROWS,
    EMISSIVITY_FIRST_CM1 = WAVENUMBER_ROWS_FIRST_CM1,
    EMISSIVITY_STEP_CM1 = WAVENUMBER_ROWS_STEP_CM1
};

typedef struct emissivity {
    float value[EMISSIVITY_ANGLES][EMISSIVITY_WAVENUMBERS]; /* 0..1 */
} emissivity;

/* Reads an .ems file; leading lines that start with '#' are passed over. Values beyond 0
 * and 1 by 0.02 at most are cut there, with a warning. */
status emissivity_read(emissivity **out, const char *path);
void emissivity_free(emissivity *e);

#endif
