/* Dialect: lets one header compile as OpenCL C 1.2, C11 and C++17. Every other kernels/ header
 * includes it first. */
#ifndef DIALECT_H
#define DIALECT_H

#ifdef __OPENCL_C_VERSION__

#pragma OPENCL FP_CONTRACT OFF
/* What a work-item has of rays, and of other problems side by side: 16 on CPUs, in vectors; 1 on GPUs. The
 * host says so for each device. */
#ifndef RAY_LANES
#define RAY_LANES 16
#endif
#ifdef __clang__
/* Vectors of 16 go through functions of this program alone: another ABI than other CPUs' does no harm. */
#pragma clang diagnostic ignored "-Wpsabi"
#endif
/* Before a loop of few steps: PoCL unrolls none unasked, and what a loop indexes stays in memory. */
#define UNROLL _Pragma("unroll")
/* Before a function that gets code of its own for every constant it is called with, or does less than
 * handing over its records. Oclgrind cannot run what becomes of such functions. */
#ifdef RAY_PORTABLE
#define INLINE static inline
#else
#define INLINE static inline __attribute__((always_inline))
#endif
/* Before a function that is seldom called, so that those that call it stay small. */
#define RARE static __attribute__((noinline))
#define RECORD_SIZE(type, bytes) typedef char type##_size[sizeof(type) == (bytes) ? 1 : -1]
/* Before a kernel whose work-items do much: on CPUs its body is compiled once, see with_shared_body of
 * launches.py, which writes the other names. */
#define SHARED_BODY
#if RAY_LANES > 1
#define BODY_IS_SHARED 1
#define BODY(name) static __attribute__((noinline)) void name##_shared_body
#define BODY_ITEM , const size_t item_x, const size_t item_y
#define BODY_ID(axis) ((axis) == 0 ? item_x : item_y)
#else
#define BODY_IS_SHARED 0
#define BODY(name) kernel void name
#define BODY_ITEM
#define BODY_ID(axis) get_global_id(axis)
#endif
/* Before a buffer in a kernel's signature: it may be NULL. */
#define OPTIONAL
/* A group of tables (tables.h): as parameters of a kernel; as the struct that its functions get; and
 * from the parameters that struct's value. */
#define TABLES(list) list(TABLE_DECLARED, TABLE_COMMA)
#define TABLES_STRUCT(name, list)                                                                  \
    typedef struct name {                                                                          \
        list(TABLE_DECLARED, TABLE_SEMICOLON);                                                     \
    } name
#define TABLES_GIVEN(list)                                                                         \
    {                                                                                              \
        list(TABLE_NAMED, TABLE_COMMA)                                                             \
    }
#define TABLE_DECLARED(type, name) type name
#define TABLE_NAMED(type, name) name
#define TABLE_COMMA ,
#define TABLE_SEMICOLON ;

#else

#include <stdint.h>
#define UNROLL
#define INLINE static inline
#define RARE static inline
#ifdef __cplusplus
#include <cmath>
#define RECORD_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type)
#else
#include <tgmath.h>
#define RECORD_SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), #type)
#endif
typedef uint32_t uint;
typedef uint8_t uchar;

#endif

#endif
