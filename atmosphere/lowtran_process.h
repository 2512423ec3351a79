/* LOWTRAN process: one deck in one process of radsig-lowtran, which leaves its arrays in a file. The
 * Fortran keeps its state in static storage, so a process runs one deck and ends. */
#ifndef LOWTRAN_PROCESS_H
#define LOWTRAN_PROCESS_H

#include "lowtran.h"

#include <sys/types.h>

typedef struct lowtran_process lowtran_process;

/* Makes a place for runs, one after the other, in a folder of its own below `folder`. */
status lowtran_process_open(lowtran_process **out, const char *folder, int number);

/* Removes the folder; ends a run that goes on. */
void lowtran_process_free(lowtran_process *p);

/* Starts a deck. Fails with STATUS_FILE if radsig-lowtran does not lie beside this program. */
status lowtran_process_start(lowtran_process *p, const char *deck);

/* Id of the child process, 0 where none runs. */
pid_t lowtran_process_id(const lowtran_process *p);

/* Tells what came out of the child that ended.
 *   wait_status   of waitpid
 *   name          of the deck, for messages
 *   out           points into the place: valid until the next start
 * Fails with STATUS_FORMAT where LOWTRAN stopped, crashed, or left no spectrum. */
status lowtran_process_finish(lowtran_process *p, int wait_status, const char *name,
                              lowtran_run *out);

#endif
