#include "tree/bvh_memory.h"

status bvh_memory_take(bvh_memory *out, device *dev, bvh **tree)
{
    status rc = STATUS_OK;
    const bvh_tables *tables = bvh_look(*tree);

    TRY(device_share(dev, &out->node, tables->node_count, tables->node));
    TRY(device_share(dev, &out->block, tables->block_count, tables->block));
    out->tree = *tree;
    *tree = NULL;
out:
    return rc;
}

void bvh_memory_free(bvh_memory *m)
{
    device_release(m->block);
    device_release(m->node);
    bvh_free(m->tree);
}
