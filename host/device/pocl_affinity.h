/* PoCL affinity: has PoCL pin its workers to CPUs where that is safe. Without it its workers often
 * start on one core, and kernels of a few milliseconds run on that core alone. */
#ifndef POCL_AFFINITY_H
#define POCL_AFFINITY_H

/* Sets POCL_AFFINITY=1 in the environment; call before the first OpenCL call. Leaves it alone where
 * the user has set it, where this process may not run on exactly the CPUs 0..n-1 (PoCL ignores the
 * mask), where POCL_MAX_PTHREAD_COUNT differs from n, and under MPI or SLURM, whose ranks would
 * share cores. */
void pocl_affinity_set(void);

#endif
