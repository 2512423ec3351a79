/* LOWTRAN: runs card decks through LOWTRAN 7, each in a fresh process, several side by side.
 * Kneizys and others, Users Guide to LOWTRAN 7, AFGL-TR-88-0177 (1988). */
#ifndef LOWTRAN_H
#define LOWTRAN_H

#include "base/status.h"
#include "lowtran_sheet.h"

#include <stddef.h>

/* What a deck asks for, as LOWTRAN echoes it, and what came out. Spectra ascend in wavenumber. */
typedef struct lowtran_run {
    int itype, iemsct, iparm;
    double h1_km, h2_km, angle_deg;
    double parm1, psipo_deg; /* 0 unless IEMSCT is 2 */
    double range_km;
    int level_count;
    float altitude_km[LOWTRAN_LEVELS], temperature_k[LOWTRAN_LEVELS];
    int point_count;
    const float *wavenumber_cm1;
    const float *tau;        /* transmission of the path */
    const float *emitted;    /* W cm-2 sr-1 um-1, with the boundary where TBOUND asks for it */
    const float *scattered;  /* sunlight, single and multiple, W cm-2 sr-1 um-1 */
    const float *irradiance; /* of the sun outside the atmosphere, W cm-2 um-1 */
} lowtran_run;

/* Takes the result of deck number `index`; decks end in no fixed order. */
typedef status (*lowtran_taker)(void *receiver, size_t index, const lowtran_run *run);

/* Runs all decks, one process per deck, as many at a time as there are processors. Decks of the same
 * text share one run.
 *   decks   shape (count), the text of each
 *   names   shape (count), for messages
 * Fails with STATUS_FORMAT where LOWTRAN refuses a deck: the message holds what it said. An interrupt ends
 * the processes. Children that others started are left alone. */
status lowtran_run_decks(const char *const *decks, const char *const *names, size_t count,
                         lowtran_taker take, void *receiver);

#endif
