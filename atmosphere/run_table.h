/* Run table: LOWTRAN runs as their decks stand, in the layout of a radiance database (Figure 2.4-3)
 * as far as they fill it. */
#ifndef RUN_TABLE_H
#define RUN_TABLE_H

#include "lowtran.h"

typedef struct run_table run_table;

status run_table_open(run_table **out);
void run_table_free(run_table *t);

/* Keeps a copy of a run; a lowtran_taker. Fails with STATUS_FORMAT if its spectral points are not
 * those of the others. */
status run_table_add(void *table, size_t index, const lowtran_run *run);

/* Writes the file. Rows ascend in wavelength, numbers are as LOWTRAN gives them, not averaged: the
 * twelve grid values; E_S and the transmission of the run that looks at the sun, else of the first
 * run; paths between two altitudes; where the sky is whole, its integral by the thesis' rectangle
 * rule; every direction of the sky; the temperature profile. What no run holds is left out, so that
 * the database reader takes the file only if it is whole.
 *   decks   shape (count), the texts, for the header */
status run_table_write(run_table *t, const char *const *decks, size_t count, const char *path);

#endif
