/* Emissivity: a material's table over view angle and wavenumber. Appendix A item 7 (.ems). */
#ifndef EMISSIVITY_H
#define EMISSIVITY_H

#include "status.h"

enum {
    EMISSIVITY_ANGLES = 91, /* 0, 1, .. 90 degrees from the normal */
    EMISSIVITY_WAVENUMBERS =
        396, /* 39850, 39750, .. 350 cm-1: .25 to 29 um, ascending wavelength */
    EMISSIVITY_FIRST_CM1 = 39850,
    EMISSIVITY_STEP_CM1 = 100
};

typedef struct emissivity {
    float value[EMISSIVITY_ANGLES][EMISSIVITY_WAVENUMBERS]; /* 0..1 */
} emissivity;

/* Reads an .ems file; leading lines that start with '#' are passed over. */
status emissivity_read(emissivity **out, const char *path);
void emissivity_free(emissivity *e);

#endif
