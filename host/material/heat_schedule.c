#include "material/heat_schedule.h"

#include <math.h>

double heat_schedule_at_hour(const heat_schedule *table, double hour)
{
    const double clock_h = hour - 24.0 * floor(hour / 24.0);
    double w_m2 = table->count > 0 ? table->w_m2[table->count - 1] : 0.0;

    for (size_t i = 0; i < table->count && table->hour[i] <= clock_h + 1e-9; i++)
        w_m2 = table->w_m2[i];
    return w_m2;
}
