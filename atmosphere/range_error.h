/* Range error: what level paths between a database's ranges err by, as a render takes them. */
#ifndef RANGE_ERROR_H
#define RANGE_ERROR_H

#include "sky/atmosphere.h"

/* The most by which the radiance of a surface 20 K above the air errs, of its own, over 3 to 5.2 and 7 to 14.3 um
 * where the database holds half of them or more: renders take ln tau linear in range, here it follows the power of
 * range that its values at both ends have, before the first range that of the next step (one range alone: 0.5,
 * strong lines).
 *   out_from_m, out_to_m   the ranges between which that is */
double range_error_most(const atmosphere *a, double *out_from_m, double *out_to_m);

#endif
