/* Errands: jobs that know nothing of each other, done beside each other by the processors there are. */
#ifndef ERRAND_H
#define ERRAND_H

#include "status.h"

#include <stddef.h>

typedef struct errand {
    status (*run)(void *self);
    void *self;
} errand;

/* Runs all of them and waits; each is begun after those before it in the list. After a failure no more
 * are begun, and the failure of the first in the list that failed is returned. Warnings become those
 * of the calling thread, in the order of the list. The threads obey its interrupt. */
status errand_run(const errand *list, size_t count);

#endif
