/* Lobe: tables of the diffuse lobe of materials whose emissivity changes with angle. Exact mode's
 * counterpart of the (1 - e) / pi of eq. 2.4-2. */
#ifndef HOST_LOBE_H
#define HOST_LOBE_H

#include <stdint.h>

/* Averages what a surface reflects, 1 - e, over rings of equal projected solid angle; every direction counts by
 * its cosine, and e is linear between the degrees. The first row is 1 / (1 - e_hemi) of the whole
 * hemisphere, 0 where that divides by 0; the others are means over the rings, the lowest first,
 * divided by 1 - e_hemi, 1 where that is 0.
 *   table   of emissivity, shape (EMISSIVITY_ANGLES, sample_count)
 *   out     shape (LOBE_ROWS + ring_count, sample_count) */
void lobe_fill(const float *table, uint32_t sample_count, uint32_t ring_count, float *out);

#endif
