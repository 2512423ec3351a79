/* Facet range: how far along a ray the facet lies that it meets, in double precision. The kernels find
 * the facet in single precision, in which ranges much shorter than the facet, and grazing ones, lose
 * digits. */
#ifndef FACET_RANGE_H
#define FACET_RANGE_H

#include <stdint.h>

/* Returns where the ray crosses the plane of the facet, of a quad that of the triangle which it meets.
 *   corner     of the facet, as bvh_source has them
 *   ray        origin and direction
 *   range      as the kernels found it, in lengths of the direction; it is returned where the ray
 *              passes beside the facet by more than rounding explains */
double facet_range(const uint32_t corner[4], const float (*position)[3], const double ray[6],
                   double range);

#endif
