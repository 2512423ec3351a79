/* Doubles within a tolerance; cmocka's assert_float_equal compares floats. */
#ifndef ASSERT_NEAR_H
#define ASSERT_NEAR_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#define assert_near(value, expected, tolerance)                                                    \
    do {                                                                                           \
        const double near_value = (value), near_expected = (expected);                             \
        if (!(fabs(near_value - near_expected) <= (tolerance)))                                    \
            fail_msg("%s is %.17g, expected %.17g", #value, near_value, near_expected);            \
    } while (0)

#endif
