/* Phase table: a user's aerosol phase functions, LOWTRAN's cards 3B (IPH 1). Thesis 2.4.2. */
#ifndef PHASE_TABLE_H
#define PHASE_TABLE_H

#include "base/status.h"

/* Reads a file of one scattering angle a line: degrees, then the phase functions in sr-1 of the
 * four altitude regions (0-2, 2-10, 10-30, 30-100 km), or one number for all four; lines that start
 * with '#' may stand before. Angles rise from 0 to 180, 2 to 50 of them.
 *   out    the cards, "" if path is NULL; the caller frees them
 * Fails with STATUS_FORMAT where the integral over the sphere is not 1 to 5 %. */
status phase_table_cards(char **out, const char *path);

#endif
