/* Bench: how fast the preview is, measured from inside the program. */
#ifndef BENCH_H
#define BENCH_H

#include "preview.h"

/* Waits for the first picture and the exact one, orbits for five seconds, rests, and writes the figures,
 * a line each. start_s   monotonic time at the start of the process */
status bench_run(preview *p, double start_s, FILE *to);

#endif
