#define _GNU_SOURCE
#include "device/pocl_affinity.h"

#include "base/number.h"

#include <sched.h>
#include <stdbool.h>
#include <stdlib.h>

static bool is_set(const char *name)
{
    return getenv(name) != NULL;
}

static bool is_safe(void)
{
    const char *workers = getenv("POCL_MAX_PTHREAD_COUNT");
    cpu_set_t cpus;
    int64_t stated;

    if (is_set("POCL_AFFINITY")) return false;
    if (is_set("OMPI_COMM_WORLD_RANK") || is_set("PMI_RANK") || is_set("SLURM_PROCID"))
        return false;
    if (sched_getaffinity(0, sizeof cpus, &cpus) != 0) return false;
    const int count = CPU_COUNT(&cpus);
    for (int i = 0; i < count; i++)
        if (!CPU_ISSET(i, &cpus)) return false;
    return !workers || number_read_whole(workers, count, count, &stated);
}

void pocl_affinity_set(void)
{
    if (is_safe()) setenv("POCL_AFFINITY", "1", 0);
}
