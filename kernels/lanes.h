/* Lanes: LANES_WIDTH independent problems side by side. With width 1 a lane is a float: the scalar
 * twin, and what the host compiles. */
#ifndef LANES_H
#define LANES_H

#include "kernels/mask.h"

#if !defined(LANES_WIDTH) && defined(__OPENCL_C_VERSION__)
#define LANES_WIDTH RAY_LANES
#elif !defined(LANES_WIDTH)
#define LANES_WIDTH 1
#endif

#if LANES_WIDTH == 16
typedef float16 lanes;
typedef int16 lanes_mask; /* of a comparison */
typedef uint16 lanes_bits;
#define lanes_any(mask) (lanes_bits_of(mask) != 0)
#define as_lanes(bits) as_float16(bits)
#define LANES_SET(vector, lane, value) (((float *)&(vector))[lane] = (value))
#elif LANES_WIDTH == 1
typedef float lanes;
typedef int lanes_mask;
typedef uint lanes_bits;
#define lanes_any(mask) (mask)
#define as_lanes(bits) as_float(bits)
#define LANES_SET(vector, lane, value) ((void)(lane), (vector) = (value))
#endif

#ifdef __OPENCL_C_VERSION__

/* Loads and stores of lanes first .. first + LANES_WIDTH - 1 of `count`; what is past the end is the
 * last one once more, and is not stored. */
static inline uint lanes_place(uint first, uint lane, uint count)
{
    return first + lane < count ? first + lane : count - 1;
}

static inline lanes_bits lanes_load_bits(global const uint *from, uint first, uint count)
{
    lanes_bits out;

#if LANES_WIDTH == 16
    if (first + LANES_WIDTH <= count) return vload16(0, from + first);
#endif
    for (uint i = 0; i < LANES_WIDTH; i++) ((uint *)&out)[i] = from[lanes_place(first, i, count)];
    return out;
}

static inline void lanes_store(lanes from, global float *to, uint first, uint count)
{
    for (uint i = 0; i < LANES_WIDTH && first + i < count; i++)
        to[first + i] = ((const float *)&from)[i];
}

/* What stands in a table at each lane's place. */
static inline lanes lanes_gather(global const float *table, lanes_bits place)
{
    lanes out;

    for (uint i = 0; i < LANES_WIDTH; i++) LANES_SET(out, i, table[((const uint *)&place)[i]]);
    return out;
}

#if LANES_WIDTH == 16

#define lanes_of_bits(bits) convert_float16(bits)
#define lanes_bits_from(value) convert_uint16(value)

static inline lanes lanes_read(const float *from)
{
    return vload16(0, from);
}

/* Writes to where 64 bytes begin: in one, since the load of a vector waits for what was stored in parts. */
static inline void lanes_write(lanes from, float *to)
{
    *(float16 *)to = from;
}

/* A bit for every lane of a comparison. */
static inline uint lanes_bits_of(lanes_mask mask)
{
    return mask_of_16(mask);
}

#else

#define lanes_of_bits(bits) ((float)(bits))
#define lanes_bits_from(value) ((uint)(value))

static inline lanes lanes_read(const float *from)
{
    return *from;
}

static inline void lanes_write(lanes from, float *to)
{
    *to = from;
}

static inline uint lanes_bits_of(lanes_mask mask)
{
    return mask != 0;
}

#endif

#endif

#endif
