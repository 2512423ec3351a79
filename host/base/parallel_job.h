/* Parallel jobs: independent jobs, run side by side by the processors there are. */
#ifndef PARALLEL_JOB_H
#define PARALLEL_JOB_H

#include "base/status.h"

#include <stddef.h>

typedef struct parallel_job {
    status (*run)(void *self);
    void *self;
} parallel_job;

/* Runs all of them and waits; each is begun after those before it in the list. After a failure no more
 * are begun, and the failure of the first in the list that failed is returned. Warnings become those
 * of the calling thread, in the order of the list. The threads obey its interrupt. */
status parallel_run(const parallel_job *list, size_t count);

#endif
