#include "tree/bvh_wide.h"

#include "base/interrupt.h"

#include <stdlib.h>

/* What it costs to hang a fork into a node as up to 1 .. 8 children. */
typedef struct hanging {
    float cost[BVH_CHILDREN];
} hanging;

/* A word of the plan has three bits for every number of children: how many of them the left side of
 * the fork takes, 0 where the fork itself is one child. Those for 1 tell it of the node over the fork. */
static uint32_t planned(uint32_t word, uint32_t children)
{
    return word >> 3 * (children - 1) & 7;
}

/* The best division of `count` children among both sides. */
static uint32_t divide(const hanging *left, const hanging *right, uint32_t count, float *out_cost)
{
    uint32_t best = 1;

    *out_cost = left->cost[0] + right->cost[count - 2];
    for (uint32_t k = 2; k < count; k++) {
        const float cost = left->cost[k - 1] + right->cost[count - k - 1];
        if (cost >= *out_cost) continue;
        *out_cost = cost;
        best = k;
    }
    return best;
}

static hanging plan_fork(uint32_t *plan, const bvh_fork *fork, uint32_t index)
{
    const bvh_fork *f = &fork[index];
    hanging out = {{0}};

    plan[index] = 0;
    if (f->right == 0 || interrupt_is_set()) return out;
    const hanging left = plan_fork(plan, fork, index + 1);
    const hanging right = plan_fork(plan, fork, f->right);
    plan[index] = divide(&left, &right, BVH_CHILDREN, &out.cost[0]);
    out.cost[0] += bvh_half_area(f->low, f->high);
    for (uint32_t count = 2; count <= BVH_CHILDREN; count++) {
        const uint32_t k = divide(&left, &right, count, &out.cost[count - 1]);
        if (out.cost[count - 1] < out.cost[0])
            plan[index] |= k << 3 * (count - 1);
        else
            out.cost[count - 1] = out.cost[0];
    }
    return out;
}

status bvh_wide_plan(uint32_t **out_plan, const bvh_fork *fork, size_t place_count)
{
    status rc = STATUS_OK;
    uint32_t *plan = malloc(place_count * sizeof *plan);

    NEED(plan, STATUS_MEMORY, "no memory for a tree of %zu forks", place_count);
    plan_fork(plan, fork, 0);
    TRY(interrupt_check());
    *out_plan = plan;
    plan = NULL;
out:
    free(plan);
    return rc;
}

/* Hangs a fork into a node as up to `most` children; returns how many it became. */
static uint32_t hang(const uint32_t *plan, const bvh_fork *fork, uint32_t index, uint32_t most,
                     uint32_t *out_child)
{
    const uint32_t left = most > 1 ? planned(plan[index], most) : 0;
    uint32_t count;

    if (left == 0) {
        *out_child = index;
        return 1;
    }
    count = hang(plan, fork, index + 1, left, out_child);
    return count + hang(plan, fork, fork[index].right, most - left, out_child + count);
}

uint32_t bvh_wide_children(const uint32_t *plan, const bvh_fork *fork, uint32_t top,
                           uint32_t out_child[BVH_CHILDREN])
{
    const uint32_t left = planned(plan[top], 1);
    uint32_t count;

    if (fork[top].right == 0) return hang(plan, fork, top, 1, out_child);
    count = hang(plan, fork, top + 1, left, out_child);
    return count + hang(plan, fork, fork[top].right, BVH_CHILDREN - left, out_child + count);
}
