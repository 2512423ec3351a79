/* Ray queue: rays that ask whether anything stands in their way wait until a packet is full. */
#ifndef RAY_QUEUE_H
#define RAY_QUEUE_H

#include "kernels/rays/ray_packet.h"

typedef struct ray_queue {
    ray_packet packet;
    uint mark[RAY_LANES]; /* what the caller knows a ray by */
    uint count;
} ray_queue;

static inline ray_queue ray_queue_of(const world_record *world)
{
    ray_queue q = {.count = 0};

    ray_packet_clear(&q.packet, world);
    return q;
}

/* Adds a ray; returns 1 where the queue is full and has to be cast. */
static inline uint ray_queue_add(ray_queue *q, const ray *r, const uint mark)
{
    q->mark[q->count] = mark;
    ray_packet_set(&q->packet, q->count++, r);
    return q->count == RAY_LANES;
}

/* Casts the rays that wait; returns a bit for each that meets nothing. The queue is empty then, but
 * for the marks. */
static inline uint ray_queue_cast(ray_queue *q, global const bvh_node *nodes,
                                  global const bvh_block *blocks)
{
    const uint reached = q->packet.alive & ~ray_packet_any(nodes, blocks, &q->packet);

    q->packet.alive = 0;
    q->count = 0;
    return reached;
}

#endif
