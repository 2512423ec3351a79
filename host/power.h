/* Power: self-generated heat that is switched by the clock, every day alike. Thesis 4.0, item 6. */
#ifndef POWER_H
#define POWER_H

#include <stddef.h>

enum { POWER_ENTRIES = 48 };

/* From hour[i] of the local clock on a facet generates w_m2[i], besides what it generates always;
 * before the first hour what the last one says. */
typedef struct power_table {
    size_t count;               /* 0: nothing */
    double hour[POWER_ENTRIES]; /* 0..24, ascending */
    double w_m2[POWER_ENTRIES];
} power_table;

/* Power at an hour since any midnight. */
double power_at_hour(const power_table *table, double hour);

#endif
