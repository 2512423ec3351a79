/* Cache of trees: one that was built once is read again from radsig's folder of cached files,
 * $XDG_CACHE_HOME/radsig, or ~/.cache/radsig where that is not set. */
#ifndef BVH_CACHE_H
#define BVH_CACHE_H

#include "bvh.h"

/* Trees over fewer facets are built as fast as they are read, and not kept. */
enum { BVH_CACHE_LEAST = 50000 };

/* As bvh_build, with the same bytes. A file's name comes from all that the tree is built over and from
 * BVH_LAYOUT; one that is damaged, or is none of ours, is written anew. The folder may be deleted at
 * any time, and what hinders reading or writing in it is no failure. */
status bvh_cache_build(bvh **out, const bvh_source *source);

#endif
