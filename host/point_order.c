#include "point_order.h"

#include "distinct.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* What points have in common that face alike: a normal, without the signs of its zeros, and a material. */
enum { KEY_WORDS = 4 };

static void fill_key(uint32_t key[KEY_WORDS], const hit_record *hit, const facet_record *facet)
{
    const float normal[3] = {hit->normal[0] + 0.0f, hit->normal[1] + 0.0f, hit->normal[2] + 0.0f};

    memcpy(key, normal, sizeof normal);
    key[3] = hit->facet == RECORD_NONE ? RECORD_NONE : facet[hit->facet].material;
}

/* Where the points of each kind begin that fill whole groups.
 *   whole   shape (kinds): how many these are
 * Returns where the others begin. */
static uint32_t divide(uint32_t *whole, uint32_t *begin, const uint32_t *kind, uint32_t count,
                       size_t kinds)
{
    uint32_t at = 0;

    memset(whole, 0, kinds * sizeof *whole);
    for (uint32_t i = 0; i < count; i++) whole[kind[i]]++;
    for (size_t k = 0; k < kinds; k++) {
        whole[k] -= whole[k] % PIXEL_GROUP;
        begin[k] = at;
        at += whole[k];
    }
    return at;
}

status point_order_fill(uint32_t *order, const hit_record *hit, const facet_record *facet,
                        uint32_t count)
{
    status rc = STATUS_OK;
    size_t kinds = 0;
    uint32_t(*key)[KEY_WORDS] = calloc((size_t)count + 1, sizeof *key);
    uint32_t *kind = malloc((count + 1) * sizeof *kind);
    uint32_t *whole = malloc((count + 1) * sizeof *whole);
    uint32_t *begin = malloc((count + 1) * sizeof *begin);

    NEED(key && kind && whole && begin, STATUS_MEMORY, "no memory to order %u points", count);
    for (uint32_t i = 0; i < count; i++) fill_key(key[i], &hit[i], facet);
    TRY(distinct_rows(key[0], KEY_WORDS, count, kind, begin, &kinds));
    uint32_t rest = divide(whole, begin, kind, count, kinds);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t k = kind[i];
        const bool is_whole = whole[k] > 0;
        order[is_whole ? begin[k]++ : rest++] = i;
        whole[k] -= is_whole;
    }
out:
    free(begin);
    free(whole);
    free(kind);
    free(key);
    return rc;
}

status point_order_run(device *dev, device_memory hit, const facet_record *facet, uint32_t count,
                       device_memory out_order, device_memory out_hit)
{
    status rc = STATUS_OK;
    const hit_record *from = NULL;
    uint32_t *order = malloc((count + 1) * sizeof *order);
    hit_record *ordered = malloc((count + 1) * sizeof *ordered);

    NEED(order && ordered, STATUS_MEMORY, "no memory to order %u points", count);
    TRY(device_map(dev, hit, count * sizeof *from, (const void **)&from));
    TRY(point_order_fill(order, from, facet, count));
    for (uint32_t i = 0; i < count; i++) ordered[i] = from[order[i]];
    TRY(device_upload(dev, out_order, 0, count * sizeof *order, order));
    TRY(device_upload(dev, out_hit, 0, count * sizeof *ordered, ordered));
out:
    device_unmap(dev, hit, from);
    free(ordered);
    free(order);
    return rc;
}
