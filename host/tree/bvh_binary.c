#include "tree/bvh_binary.h"

#include "base/interrupt.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

enum { BINS = 32, HEURISTIC_DEPTH = 64 };

/* Subtrees of fewer items are not worth a thread. */
enum { THREAD_ITEMS = 1 << 14 };

/* Steps through a node cost as much as a test of one block. */
static const float fork_cost = 1.0f;

typedef struct box {
    float low[3], high[3];
} box;

typedef struct bin {
    box bounds;
    uint32_t count;
} bin;

/* Items are binned by their centres along each axis. */
typedef struct scale {
    float low[3], factor[3]; /* factor 0: no extent along this axis */
} scale;

typedef struct split {
    float cost; /* in units of area times blocks */
    int axis;   /* -1: none was found */
    uint32_t bin;
} split;

typedef struct builder {
    bvh_fork *fork;
    bvh_item *item;
    bool even;
    uint32_t thread_depth; /* above it the right subtree has a thread of its own */
    const atomic_int *token;
} builder;

/* A subtree to build: its root's place among the forks, its items, and how many forks it got. */
typedef struct subtree {
    const builder *b;
    uint32_t fork, first, count, depth, fork_count;
} subtree;

static const box empty_box = {{1e30f, 1e30f, 1e30f}, {-1e30f, -1e30f, -1e30f}};

static void extend(box *b, const float low[3], const float high[3])
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = low[k] < b->low[k] ? low[k] : b->low[k];
        b->high[k] = high[k] > b->high[k] ? high[k] : b->high[k];
    }
}

float bvh_half_area(const float low[3], const float high[3])
{
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];

    return x < 0 ? 0 : x * y + y * z + z * x;
}

static float block_count(uint32_t count)
{
    return (float)((count + BVH_BLOCK_SIZE - 1) / BVH_BLOCK_SIZE);
}

static float centre(const bvh_item *item, int axis)
{
    return .5f * item->low[axis] + .5f * item->high[axis];
}

static uint32_t find_bin(const scale *s, const bvh_item *item, int axis)
{
    return (uint32_t)((centre(item, axis) - s->low[axis]) * s->factor[axis]);
}

/* Finds the box of the items and the scale of their centres. */
static box measure(const bvh_item *item, uint32_t count, scale *out_scale)
{
    box all = empty_box, centres = empty_box;

    for (uint32_t i = 0; i < count; i++) {
        const float c[3] = {centre(&item[i], 0), centre(&item[i], 1), centre(&item[i], 2)};
        extend(&all, item[i].low, item[i].high);
        extend(&centres, c, c);
    }
    for (int k = 0; k < 3; k++) {
        const float extent = centres.high[k] - centres.low[k];
        out_scale->low[k] = centres.low[k];
        out_scale->factor[k] = extent > 1e-30f ? BINS * .9999f / extent : 0;
    }
    return all;
}

static void fill_bins(bin bins[3][BINS], const scale *s, const bvh_item *item, uint32_t count)
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < BINS; i++) bins[k][i] = (bin){empty_box, 0};
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            bin *b = &bins[k][find_bin(s, &item[i], k)];
            extend(&b->bounds, item[i].low, item[i].high);
            b->count++;
        }
}

/* Looks at the borders between the bins of one axis, sweeping from above and then from below. */
static void try_axis(split *best, const bin bins[BINS], int axis)
{
    float above_cost[BINS];
    uint32_t above_count[BINS];
    box bounds = empty_box;
    uint32_t count = 0;

    for (int i = BINS - 1; i > 0; i--) {
        extend(&bounds, bins[i].bounds.low, bins[i].bounds.high);
        count += bins[i].count;
        above_count[i] = count;
        above_cost[i] = bvh_half_area(bounds.low, bounds.high) * block_count(count);
    }
    bounds = empty_box;
    count = 0;
    for (int i = 0; i < BINS - 1; i++) {
        extend(&bounds, bins[i].bounds.low, bins[i].bounds.high);
        count += bins[i].count;
        const float cost =
            bvh_half_area(bounds.low, bounds.high) * block_count(count) + above_cost[i + 1];
        if (count && above_count[i + 1] && cost < best->cost)
            *best = (split){cost, axis, (uint32_t)i};
    }
}

static split find_split(const scale *s, const bvh_item *item, uint32_t count)
{
    bin bins[3][BINS];
    split best = {3e38f, -1, 0};

    fill_bins(bins, s, item, count);
    for (int k = 0; k < 3; k++)
        if (s->factor[k] > 0) try_axis(&best, bins[k], k);
    return best;
}

/* Moves the items up to the border to the front; returns how many they are. */
static uint32_t partition(const split *where, const scale *s, bvh_item *item, uint32_t count)
{
    uint32_t low = 0, high = count;

    while (low < high) {
        if (find_bin(s, &item[low], where->axis) <= where->bin) {
            low++;
        } else {
            const bvh_item swapped = item[low];
            item[low] = item[--high];
            item[high] = swapped;
        }
    }
    return low;
}

/* Returns how many items go to the left; 0 makes a leaf. */
static uint32_t choose(const builder *b, const box *bounds, const scale *s, bvh_item *item,
                       uint32_t count, uint32_t depth)
{
    const float area = bvh_half_area(bounds->low, bounds->high);
    split best;

    if (count == 1) return 0;
    if (b->even || depth >= HEURISTIC_DEPTH) return count > BVH_BLOCK_SIZE ? count / 2 : 0;
    best = find_split(s, item, count);
    if (count <= BVH_BLOCK_SIZE &&
        (best.axis < 0 || area * block_count(count) <= fork_cost * area + best.cost))
        return 0;
    return best.axis < 0 ? count / 2 : partition(&best, s, item, count);
}

static void build_subtree(subtree *t);

static void *build_beside(void *argument)
{
    subtree *t = argument;

    interrupt_obey(t->b->token);
    build_subtree(t);
    return NULL;
}

/* Builds both sides, together where that pays. What they hold does not depend on it: a subtree of n
 * items keeps to 2 n - 1 places. */
static void build_sides(subtree *left, subtree *right)
{
    pthread_t thread;
    const bool together = left->depth <= left->b->thread_depth && left->count > THREAD_ITEMS &&
                          right->count > THREAD_ITEMS &&
                          pthread_create(&thread, NULL, build_beside, right) == 0;

    build_subtree(left);
    if (together)
        pthread_join(thread, NULL);
    else
        build_subtree(right);
}

/* After an interrupt what is left becomes leaves, whatever they hold. */
static void build_subtree(subtree *t)
{
    const builder *b = t->b;
    bvh_fork *fork = &b->fork[t->fork];
    bvh_item *item = b->item + t->first;
    scale s;
    const box bounds = measure(item, t->count, &s);
    const uint32_t border =
        interrupt_is_set() ? 0 : choose(b, &bounds, &s, item, t->count, t->depth);

    *fork = (bvh_fork){.first = t->first, .count = t->count};
    for (int k = 0; k < 3; k++) {
        fork->low[k] = bounds.low[k];
        fork->high[k] = bounds.high[k];
    }
    t->fork_count = 1;
    if (border > 0) {
        const uint32_t depth = t->depth + 1;
        subtree left = {b, t->fork + 1, t->first, border, depth, 0};
        subtree right = {b, t->fork + 2 * border, t->first + border, t->count - border, depth, 0};
        fork->right = right.fork;
        build_sides(&left, &right);
        t->fork_count += left.fork_count + right.fork_count;
    }
}

/* Deep enough for twice as many threads as processors. */
static uint32_t find_thread_depth(void)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    uint32_t depth = 0;

    while (processors > 1 && 1L << depth < 2 * processors && depth < 8) depth++;
    return depth;
}

status bvh_binary_build(bvh_fork **out_fork, uint32_t *out_count, bvh_item *item, uint32_t count,
                        bool even)
{
    status rc = STATUS_OK;
    builder b = {.item = item,
                 .even = even,
                 .thread_depth = find_thread_depth(),
                 .token = interrupt_token()};
    subtree all = {.b = &b, .count = count};

    b.fork = malloc((2 * (size_t)count - 1) * sizeof *b.fork);
    NEED(b.fork, STATUS_MEMORY, "no memory for a tree over %u triangles", count);
    build_subtree(&all);
    TRY(interrupt_check());
    *out_fork = b.fork;
    *out_count = all.fork_count;
    b.fork = NULL;
out:
    free(b.fork);
    return rc;
}
