#include "hemisphere/point_order.h"

#include "base/unique_rows.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* What points have in common that face alike: a normal, without the signs of its zeros, and a material. */
enum { KEY_WORDS = 4 };

/* Points are taken by squares of so many rows and columns, and within by a group's square. */
enum { SQUARE = 8, GROUP_SIDE = 4 };

static void fill_key(uint32_t key[KEY_WORDS], const hit_record *hit, const facet_record *facet)
{
    const float normal[3] = {hit->normal[0] + 0.0f, hit->normal[1] + 0.0f, hit->normal[2] + 0.0f};

    memcpy(key, normal, sizeof normal);
    key[3] = hit->facet == RECORD_NONE ? RECORD_NONE : facet[hit->facet].material;
}

/* Lists a square of an image that begins at `left` of row `top`, one group's square after the other.
 * Returns behind the last point. */
static uint32_t *walk_square(uint32_t *out, const point_tile *tile, uint32_t top, uint32_t left)
{
    const uint32_t groups_across = SQUARE / GROUP_SIDE;

    for (uint32_t i = 0; i < SQUARE * SQUARE; i++) {
        const uint32_t group = i / PIXEL_GROUP, within = i % PIXEL_GROUP;
        const uint32_t row = top + group / groups_across * GROUP_SIDE + within / GROUP_SIDE;
        const uint32_t column = left + group % groups_across * GROUP_SIDE + within % GROUP_SIDE;
        const uint64_t point = (uint64_t)row * tile->columns + column;
        if (column < tile->columns && point >= tile->first && point - tile->first < tile->count)
            *out++ = (uint32_t)(point - tile->first);
    }
    return out;
}

/* Lists all points so that neighbours stand close by. */
static void walk(uint32_t *out, const point_tile *tile)
{
    const uint64_t end = (uint64_t)tile->first + tile->count;

    for (uint32_t top = tile->first / tile->columns; (uint64_t)top * tile->columns < end;
         top += SQUARE)
        for (uint32_t left = 0; left < tile->columns; left += SQUARE)
            out = walk_square(out, tile, top, left);
}

/* Where the points of each kind begin: those that fill whole groups, and behind all of these the others.
 *   whole   shape (kinds): how many fill whole groups */
static void divide(uint32_t *whole, uint32_t *begin, uint32_t *rest, const uint32_t *kind,
                   uint32_t count, size_t kinds)
{
    uint32_t at = 0;

    memset(whole, 0, kinds * sizeof *whole);
    for (uint32_t i = 0; i < count; i++) whole[kind[i]]++;
    for (size_t k = 0; k < kinds; k++) {
        begin[k] = at;
        at += whole[k] - whole[k] % PIXEL_GROUP;
    }
    for (size_t k = 0; k < kinds; k++) {
        const uint32_t over = whole[k] % PIXEL_GROUP;
        rest[k] = at;
        at += over;
        whole[k] -= over;
    }
}

status point_order_fill(uint32_t *order, const hit_record *hit, const facet_record *facet,
                        const point_tile *tile)
{
    status rc = STATUS_OK;
    const uint32_t count = tile->count;
    size_t kinds = 0;
    uint32_t(*key)[KEY_WORDS] = calloc((size_t)count + 1, sizeof *key);
    uint32_t *work = malloc(((size_t)count + 1) * 5 * sizeof *work);
    uint32_t *kind = work, *walked = kind + count + 1, *whole = walked + count + 1;
    uint32_t *begin = whole + count + 1, *rest = begin + count + 1;

    NEED(key && work, STATUS_MEMORY, "no memory to order %u points", count);
    for (uint32_t i = 0; i < count; i++) fill_key(key[i], &hit[i], facet);
    TRY(unique_rows(key[0], KEY_WORDS, count, kind, begin, &kinds));
    divide(whole, begin, rest, kind, count, kinds);
    walk(walked, tile);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t k = kind[walked[i]];
        const bool is_whole = whole[k] > 0;
        order[is_whole ? begin[k]++ : rest[k]++] = walked[i];
        whole[k] -= is_whole;
    }
out:
    free(work);
    free(key);
    return rc;
}

status point_order_run(device *dev, hit_record_buffer hit, const facet_record *facet,
                       const point_tile *tile, uint_buffer out_order, hit_record_buffer out_hit)
{
    status rc = STATUS_OK;
    const uint32_t count = tile->count;
    const hit_record *from = NULL;
    uint32_t *order = malloc((count + 1) * sizeof *order);
    hit_record *ordered = malloc((count + 1) * sizeof *ordered);

    NEED(order && ordered, STATUS_MEMORY, "no memory to order %u points", count);
    TRY(device_map(dev, hit, count, &from));
    TRY(point_order_fill(order, from, facet, tile));
    for (uint32_t i = 0; i < count; i++) ordered[i] = from[order[i]];
    TRY(device_upload(dev, out_order, count, order));
    TRY(device_upload(dev, out_hit, count, ordered));
out:
    device_unmap(dev, hit, from);
    free(ordered);
    free(order);
    return rc;
}
