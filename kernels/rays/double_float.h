/* Double-float: a number as the sum of two floats, some 45 bits, for what single precision loses where
 * large parts cancel; double precision is missing on some devices. Joldes, Muller, Popescu, "Tight and
 * rigorous error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44(2), 2017. */
#ifndef DOUBLE_FLOAT_H
#define DOUBLE_FLOAT_H

#include "kernels/dialect.h"

/* Declares the type and what is computed with it, of floats or of vectors of them:
 *   _sum, _product       exactly, of two floats
 *   _add, _multiply      within 2^-44 of what the magnitudes of the parts would give
 *   _divide              likewise */
#define DOUBLE_FLOAT(type, real)                                                                   \
    typedef struct type {                                                                          \
        real high, low;                                                                            \
    } type;                                                                                        \
                                                                                                   \
    static inline type type##_sum(const real a, const real b)                                      \
    {                                                                                              \
        const real sum = a + b, part = sum - a;                                                    \
        const type out = {sum, (a - (sum - part)) + (b - part)};                                   \
        return out;                                                                                \
    }                                                                                              \
                                                                                                   \
    static inline type type##_product(const real a, const real b)                                  \
    {                                                                                              \
        const real product = a * b, error = fma(a, b, -product);                                   \
        const type out = {product, error};                                                         \
        return out;                                                                                \
    }                                                                                              \
                                                                                                   \
    /* Of a part and a much smaller one. */                                                        \
    static inline type type##_join(const real high, const real low)                                \
    {                                                                                              \
        const real sum = high + low;                                                               \
        const type out = {sum, low - (sum - high)};                                                \
        return out;                                                                                \
    }                                                                                              \
                                                                                                   \
    static inline type type##_add(const type a, const type b)                                      \
    {                                                                                              \
        const type sum = type##_sum(a.high, b.high);                                               \
        return type##_join(sum.high, sum.low + (a.low + b.low));                                   \
    }                                                                                              \
                                                                                                   \
    static inline type type##_multiply(const type a, const type b)                                 \
    {                                                                                              \
        const type product = type##_product(a.high, b.high);                                       \
        return type##_join(product.high, product.low + (a.high * b.low + a.low * b.high));         \
    }                                                                                              \
                                                                                                   \
    static inline type type##_divide(const type a, const type b)                                   \
    {                                                                                              \
        const real quotient = a.high / b.high;                                                     \
        const type back = type##_product(quotient, b.high);                                        \
        const real left = ((a.high - back.high) - back.low) + (a.low - quotient * b.low);          \
        return type##_join(quotient, left / b.high);                                               \
    }

DOUBLE_FLOAT(double_float, float)

#ifdef __OPENCL_C_VERSION__
DOUBLE_FLOAT(double_float16, float16)
#endif

#endif
