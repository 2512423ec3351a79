/* Heat schedule: self-generated heat that is switched by the clock, every day alike. Thesis 4.0, item 6. */
#ifndef HEAT_SCHEDULE_H
#define HEAT_SCHEDULE_H

#include <stddef.h>

enum { HEAT_SCHEDULE_ENTRIES = 48 };

/* From hour[i] of the local clock on a facet generates w_m2[i], besides what it generates always;
 * before the first hour what the last one says. */
typedef struct heat_schedule {
    size_t count;                       /* 0: nothing */
    double hour[HEAT_SCHEDULE_ENTRIES]; /* 0..24, ascending */
    double w_m2[HEAT_SCHEDULE_ENTRIES];
} heat_schedule;

/* Power at an hour since any midnight. */
double heat_schedule_at_hour(const heat_schedule *table, double hour);

#endif
