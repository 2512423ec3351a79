/* Thermal: facet temperatures from the weather history, a reconstruction of what THERM does. Thesis
 * 2.2; equations in kernels/thermal.h. */
#ifndef THERMAL_H
#define THERMAL_H

#include "../kernels/records.h"
#include "device.h"
#include "site.h"
#include "weather.h"

/* Turns every record of the weather into what acts on a facet. The last full day of the history is
 * the day of the site's time.
 *   out   shape (w->count); the caller allocates */
void thermal_forcing(forcing_record *out, const weather *w, const site *place);

/* Hours from the first record of the weather to the site's time; between 0 and the history's length
 * where the history covers that day. */
double thermal_time_h(const weather *w, const site *place);

/* Computes the temperature of every facet at one time, all steps sunlit; launches and does not
 * wait. facets, materials   facet_record[facet_count] and the materials that they name step_s time
 * between forcing records time_h              hours since the first forcing record; linear between
 * steps out_temperature_k   float32, shape (facet_count) Fails with STATUS_ARGUMENT where the time
 * is outside the forcing. */
status thermal_run(device *dev, device_memory facets, device_memory materials, size_t facet_count,
                   const forcing_record *forcing, size_t step_count, double step_s, double time_h,
                   device_memory out_temperature_k);

/* The same at every step.
 *   out_temperature_k   shape (step_count, facet_count); the caller allocates */
status thermal_history(device *dev, device_memory facets, device_memory materials,
                       size_t facet_count, const forcing_record *forcing, size_t step_count,
                       double step_s, float *out_temperature_k);

#endif
