/* Run table: LOWTRAN runs as their decks stand, in the layout of a radiance database (Figure 2.4-3)
 * as far as they fill it. */
#ifndef RUN_TABLE_H
#define RUN_TABLE_H

#include "lowtran.h"

typedef struct run_table run_table;

status run_table_open(run_table **out);
void run_table_free(run_table *t);

/* Keeps a copy of a run; a lowtran_taker. */
status run_table_add(void *table, size_t index, const lowtran_run *run);

/* Writes the file. Rows ascend in wavelength, numbers are as LOWTRAN gives them, not averaged: the
 * twelve grid values; E_S and the transmission of the run that looks at the sun, else of the first
 * run; paths between two altitudes; where the sky is whole, its integral by the thesis' rectangle
 * rule; every direction of the sky; the temperature profile. What no run holds is left out: where the
 * name ends in .rad the file must be one that the database reader takes, else it fails with STATUS_FORMAT
 * and the reader's reason. A file holds one grid of wavenumbers: runs of
 * others than the first follow as NAME_2.rad, NAME_3.rad, in the order of their decks.
 *   decks   shape (count of runs), the texts, for the header */
status run_table_write(run_table *t, const char *const *decks, const char *path);

#endif
