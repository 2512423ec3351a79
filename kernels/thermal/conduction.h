/* Conduction: heat along sheets of one material, from facet to facet. Thesis 4.0, item 5.
 * Facets that touch make a patch. In a step a facet's temperature (layered_lateral_k) rises by
 *   x = a + b q,   A q = sum of G (T' + x' - T - x) over its neighbours,
 * a without its neighbours, b for each W m-2 that comes from them (layered_lateral_gain), A its area:
 * symmetric equations for x, solved by conjugate gradients. So the whole step is implicit. */
#ifndef CONDUCTION_KERNEL_H
#define CONDUCTION_KERNEL_H

#include "kernels/thermal/layered_history.h"

/* LANES_WIDTH facets of a patch, on their way from one record of the weather to the next. */
typedef struct conduction_group {
    layered_body body;
    facet_state state, day_before;
    thermal_load before, after;
    layered_elimination elimination; /* for sub-steps of this way */
    lanes sum_w_m2;                  /* of what came along the facet, over sub-steps */
} conduction_group;

/* The host, for which a lane is a float, sets aside so many bytes a facet; whole groups must fit. */
#define CONDUCTION_FACET_BYTES 460u
#if LANES_WIDTH == 1
RECORD_SIZE(conduction_group, CONDUCTION_FACET_BYTES);
#else
typedef char conduction_group_fits[sizeof(conduction_group) <= LANES_WIDTH * CONDUCTION_FACET_BYTES
                                       ? 1
                                       : -1];
#endif

/* How far a patch has come, for the next launch to go on from; all 0 at first. */
typedef struct conduction_progress {
    uint days;       /* times that the first day was begun; 0: nothing was */
    uint step;       /* the last that was gone through */
    uint is_settled; /* no node moves over the first day any more */
    uint is_done;
} conduction_progress;

/* Patches of facets, and what they work with.
 *   patch_first   shape (patch_count + 1): where the facets of each begin
 *   links         shape (facets): neighbours as places in these arrays
 *   groups        shape (facets / LANES_WIDTH); numbers: (9, facets); progress: (patch_count) */
#define PATCH_TABLES(TABLE, AND)                                                                   \
    TABLE(global const uint *, patch_first)                                                        \
    AND TABLE(global const conduction_record *, links)                                             \
    AND TABLE(global conduction_group *, groups)                                                   \
    AND TABLE(global float *, numbers)                                                             \
    AND TABLE(global conduction_progress *, progress)

#ifdef __OPENCL_C_VERSION__

TABLES_STRUCT(patch_tables, PATCH_TABLES);

#define CONDUCTION_TOLERANCE_K                                                                     \
    1e-5f /* rms, of what is left over and over all that a facet conducts */
#define CONDUCTION_ITERATIONS 1000

/* A launch ends after the step in which a patch has had so many facets times iterations, some 0.1 s. */
#define CONDUCTION_WORK 5000000u

/* A patch's rows of numbers, one for each facet. */
typedef struct conduction_rows {
    global float *now_k, *alone_k, *gain; /* T, a, b */
    global float *rise_k;                 /* x */
    global float *own_w_k;                /* A / b */
    global float *left_w, *way_k, *product_w, *diagonal_w_k;
} conduction_rows;

/* What facet i gives to its neighbours for temperatures x of the patch, W. */
static inline float conduction_product(global const conduction_record *links, conduction_rows r,
                                       global const float *x, uint i)
{
    const conduction_record link = links[i];
    float sum = r.diagonal_w_k[i] * x[i];

    for (int k = 0; k < 4; k++)
        if (link.neighbour[k] != RECORD_NONE) sum -= link.link_w_k[k] * x[link.neighbour[k]];
    return sum;
}

/* Two sums over what is left over: of its squares by what facets conduct in all, and by A / b. */
typedef struct conduction_left {
    float by_diagonal, by_own;
} conduction_left;

static inline conduction_left conduction_left_of(conduction_rows r, uint first, uint end)
{
    conduction_left sum = {0.0f, 0.0f};

    for (uint i = first; i < end; i++) {
        const float square = r.left_w[i] * r.left_w[i];
        sum.by_diagonal += square / r.diagonal_w_k[i];
        sum.by_own += square / r.own_w_k[i];
    }
    return sum;
}

/* Sets the equations up, from x = 0. Returns how much may be left over. */
static inline float conduction_set_up(global const conduction_record *links, conduction_rows r,
                                      uint first, uint end)
{
    float all = 0.0f;

    for (uint i = first; i < end; i++) {
        const conduction_record link = links[i];
        const float own_w_k = link.area_m2 / r.gain[i];
        float left = own_w_k * r.alone_k[i] + link.stated_w_k * (link.stated_k - r.now_k[i]);
        float diagonal = own_w_k + link.stated_w_k;
        for (int k = 0; k < 4; k++) {
            if (link.neighbour[k] == RECORD_NONE) continue;
            left += link.link_w_k[k] * (r.now_k[link.neighbour[k]] - r.now_k[i]);
            diagonal += link.link_w_k[k];
        }
        r.rise_k[i] = 0.0f;
        r.own_w_k[i] = own_w_k;
        r.left_w[i] = left;
        r.diagonal_w_k[i] = diagonal;
        r.way_k[i] = left / diagonal;
        all += own_w_k;
    }
    return CONDUCTION_TOLERANCE_K * CONDUCTION_TOLERANCE_K * all;
}

/* Solves for the rises of facets first .. end - 1, in one order whatever else runs. Returns the facets that
 * were gone through, times iterations. */
static inline uint conduction_solve(global const conduction_record *links, conduction_rows r,
                                    uint first, uint end)
{
    const float limit = conduction_set_up(links, r, first, end);
    conduction_left left = conduction_left_of(r, first, end);
    uint step = 0;

    for (; step < CONDUCTION_ITERATIONS && left.by_own > limit; step++) {
        float along = 0.0f;
        for (uint i = first; i < end; i++) {
            r.product_w[i] = conduction_product(links, r, r.way_k, i);
            along += r.way_k[i] * r.product_w[i];
        }
        if (!(along > 0.0f)) break;
        const float length = left.by_diagonal / along;
        for (uint i = first; i < end; i++) {
            r.rise_k[i] += length * r.way_k[i];
            r.left_w[i] -= length * r.product_w[i];
        }
        const conduction_left next = conduction_left_of(r, first, end);
        const float turn = next.by_diagonal / left.by_diagonal;
        for (uint i = first; i < end; i++)
            r.way_k[i] = r.left_w[i] / r.diagonal_w_k[i] + turn * r.way_k[i];
        left = next;
    }
    return (step + 1) * (end - first);
}

#endif

#endif
