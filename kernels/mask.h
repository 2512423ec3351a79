/* Mask: the signs of lanes as bits, the first lane's lowest: of a comparison what is true. On the
 * device alone. */
#ifndef MASK_H
#define MASK_H

#include "kernels/dialect.h"

#ifdef __OPENCL_C_VERSION__

static inline uint mask_of_8(const int8 lanes)
{
#if defined(__AVX__) && !defined(RAY_PORTABLE)
    return (uint)__builtin_ia32_movmskps256(as_float8(lanes));
#else
    const int8 bits = lanes >> 31 & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 fours = bits.lo | bits.hi;
    const int2 twos = fours.lo | fours.hi;
    return (uint)(twos.x | twos.y);
#endif
}

static inline uint mask_of_16(const int16 lanes)
{
#if defined(__AVX512DQ__) && !defined(RAY_PORTABLE)
    return (ushort)__builtin_ia32_cvtd2mask512(lanes);
#else
    return mask_of_8(lanes.lo) | mask_of_8(lanes.hi) << 8;
#endif
}

#endif

#endif
