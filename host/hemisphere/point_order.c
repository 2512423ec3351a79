#include "hemisphere/point_order.h"

#include "base/unique_rows.h"
#include "hemisphere/hemisphere_strata.h"

#include <stdlib.h>
#include <string.h>

/* What points have in common that face alike: a normal, without the signs of its zeros, a material and a set of
 * directions. */
enum { KEY_WORDS = 6 };

/* Points are taken by squares of so many rows and columns, and within by a group's square. */
enum { SQUARE = HEMISPHERE_SQUARE, GROUP_SIDE = 4 };

/* The set of directions that point `i` of the tile takes. */
static uint32_t set_of(const point_tile *tile, uint32_t i)
{
    const uint32_t pixel = (tile->first + i) / tile->samples;

    if (!tile->has_sets) return 0;
    return hemisphere_strata_set(pixel % tile->columns + tile->first_column,
                                 pixel / tile->columns + tile->first_row,
                                 (tile->first + i) % tile->samples, tile->seed);
}

static uint32_t square_of(const point_tile *tile, uint32_t i)
{
    const uint32_t pixel = (tile->first + i) / tile->samples;
    const uint32_t column = pixel % tile->columns + tile->first_column;
    const uint32_t row = pixel / tile->columns + tile->first_row;

    if (!tile->has_sets) return 0;
    return row / SQUARE << 16 | column / SQUARE;
}

static void fill_key(uint32_t key[KEY_WORDS], const hit_record *hit, const facet_record *facet,
                     uint32_t square, uint32_t set)
{
    const float normal[3] = {hit->normal[0] + 0.0f, hit->normal[1] + 0.0f, hit->normal[2] + 0.0f};

    memcpy(key, normal, sizeof normal);
    key[3] = hit->facet == RECORD_NONE ? RECORD_NONE : facet[hit->facet].material;
    key[4] = square;
    key[5] = set;
}

/* Lists a square of an image that begins at `left` of row `top`, one group's square after the other.
 * Returns behind the last point. */
static uint32_t *walk_square(uint32_t *out, const point_tile *tile, int64_t top, int64_t left)
{
    const uint32_t groups_across = SQUARE / GROUP_SIDE;

    for (uint32_t i = 0; i < SQUARE * SQUARE; i++) {
        const uint32_t group = i / PIXEL_GROUP, within = i % PIXEL_GROUP;
        const int64_t row = top + group / groups_across * GROUP_SIDE + within / GROUP_SIDE;
        const int64_t column = left + group % groups_across * GROUP_SIDE + within % GROUP_SIDE;
        const int64_t point = (row * tile->columns + column) * tile->samples;
        if (row < 0 || column < 0 || column >= tile->columns || point < tile->first ||
            point - tile->first >= tile->count)
            continue;
        for (uint32_t k = 0; k < tile->samples; k++) *out++ = (uint32_t)(point - tile->first) + k;
    }
    return out;
}

/* Lists all points so that neighbours stand close by. */
static void walk(uint32_t *out, const point_tile *tile)
{
    const uint64_t row_samples = (uint64_t)tile->columns * tile->samples;
    const uint64_t end = (uint64_t)tile->first + tile->count;
    const uint32_t before_row = (uint32_t)(tile->first / row_samples + tile->first_row) % SQUARE;
    const uint32_t before_column = tile->first_column % SQUARE;

    for (int64_t top = (int64_t)(tile->first / row_samples) - before_row;
         top < 0 || (uint64_t)top * row_samples < end; top += SQUARE)
        for (int64_t left = -(int64_t)before_column; left < tile->columns; left += SQUARE)
            out = walk_square(out, tile, top, left);
}

/* Points of a tile by kind; a class is of those kinds that differ by their set of directions alone. */
typedef struct point_kinds {
    uint32_t *of_point; /* shape (points) */
    uint32_t *of_class; /* shape (kinds): the class of each */
    uint32_t *whole;    /* shape (kinds): points that fill whole groups and have no place yet */
    uint32_t *next;     /* shape (kinds): the place of the next */
    uint32_t *group,
        *single; /* shape (classes): the place of the next whole group, of the next other */
    size_t kind_count, class_count;
} point_kinds;

static void release(point_kinds *k)
{
    free(k->of_point);
    free(k->of_class);
    free(k->whole);
    free(k->next);
    free(k->group);
    free(k->single);
}

/* Finds kinds and classes.
 *   key     shape (count, KEY_WORDS); first: shape (count), overwritten */
static status find_kinds(point_kinds *k, const uint32_t (*key)[KEY_WORDS], uint32_t *first,
                         uint32_t count)
{
    status rc = STATUS_OK;
    uint32_t(*alike)[KEY_WORDS] = NULL;

    k->of_point = malloc(((size_t)count + 1) * sizeof *k->of_point);
    NEED(k->of_point, STATUS_MEMORY, "no memory to order %u points", count);
    TRY(unique_rows(key[0], KEY_WORDS, count, k->of_point, first, &k->kind_count));
    alike = malloc((k->kind_count + 1) * sizeof *alike);
    k->of_class = malloc((k->kind_count + 1) * sizeof *k->of_class);
    k->whole = calloc(k->kind_count + 1, sizeof *k->whole);
    k->next = calloc(k->kind_count + 1, sizeof *k->next);
    NEED(alike && k->of_class && k->whole && k->next, STATUS_MEMORY, "no memory to order %u points",
         count);
    for (size_t i = 0; i < k->kind_count; i++) {
        memcpy(alike[i], key[first[i]], sizeof *alike);
        alike[i][KEY_WORDS - 1] = alike[i][KEY_WORDS - 2] = 0;
    }
    TRY(unique_rows(alike[0], KEY_WORDS, k->kind_count, k->of_class, first, &k->class_count));
    k->group = calloc(k->class_count + 1, sizeof *k->group);
    k->single = calloc(k->class_count + 1, sizeof *k->single);
    NEED(k->group && k->single, STATUS_MEMORY, "no memory to order %u points", count);
out:
    free(alike);
    return rc;
}

/* Where each class begins: its whole groups, and behind those of all classes the others. */
static void divide(point_kinds *k, uint32_t count)
{
    uint32_t at = 0;

    for (uint32_t i = 0; i < count; i++) k->whole[k->of_point[i]]++;
    for (size_t i = 0; i < k->kind_count; i++) {
        k->single[k->of_class[i]] += k->whole[i] % PIXEL_GROUP;
        k->whole[i] -= k->whole[i] % PIXEL_GROUP;
        k->group[k->of_class[i]] += k->whole[i];
    }
    for (size_t c = 0; c < k->class_count; c++) {
        const uint32_t own = k->group[c];
        k->group[c] = at;
        at += own;
    }
    for (size_t c = 0; c < k->class_count; c++) {
        const uint32_t own = k->single[c];
        k->single[c] = at;
        at += own;
    }
}

/* The place of the next point of a kind: a group begins where the one before it of its class ends. */
static uint32_t take_place(point_kinds *k, uint32_t kind)
{
    const uint32_t class = k->of_class[kind];

    if (k->whole[kind] == 0) return k->single[class]++;
    if (k->whole[kind]-- % PIXEL_GROUP == 0) {
        k->next[kind] = k->group[class];
        k->group[class] += PIXEL_GROUP;
    }
    return k->next[kind]++;
}

status point_order_fill(uint32_t *order, uint32_t *set, const hit_record *hit,
                        const facet_record *facet, const point_tile *tile)
{
    status rc = STATUS_OK;
    const uint32_t count = tile->count;
    point_kinds kinds = {0};
    uint32_t(*key)[KEY_WORDS] = calloc((size_t)count + 1, sizeof *key);
    uint32_t *walked = malloc(((size_t)count + 1) * sizeof *walked);

    NEED(key && walked, STATUS_MEMORY, "no memory to order %u points", count);
    for (uint32_t i = 0; i < count; i++)
        fill_key(key[i], &hit[i], facet, square_of(tile, i), set_of(tile, i));
    TRY(find_kinds(&kinds, key, walked, count));
    divide(&kinds, count);
    walk(walked, tile);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t place = take_place(&kinds, kinds.of_point[walked[i]]);
        order[place] = walked[i];
        set[place] = key[walked[i]][KEY_WORDS - 1];
    }
out:
    release(&kinds);
    free(walked);
    free(key);
    return rc;
}

status point_order_run(device *dev, hit_record_buffer hit, const facet_record *facet,
                       const point_tile *tile, uint_buffer out_order, uint_buffer out_set,
                       hit_record_buffer out_hit)
{
    status rc = STATUS_OK;
    const uint32_t count = tile->count;
    const hit_record *from = NULL;
    uint32_t *order = malloc(((size_t)count + 1) * 2 * sizeof *order), *set = order + count + 1;
    hit_record *ordered = malloc((count + 1) * sizeof *ordered);

    NEED(order && ordered, STATUS_MEMORY, "no memory to order %u points", count);
    TRY(device_map(dev, hit, count, &from));
    TRY(point_order_fill(order, set, from, facet, tile));
    for (uint32_t i = 0; i < count; i++) ordered[i] = from[order[i]];
    TRY(device_upload(dev, out_order, count, order));
    TRY(device_upload(dev, out_set, count, set));
    TRY(device_upload(dev, out_hit, count, ordered));
out:
    device_unmap(dev, hit, from);
    free(ordered);
    free(order);
    return rc;
}
