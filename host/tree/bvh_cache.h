/* Cache of trees: one that was built once is read again from radsig's cache folder (cache_folder.h). */
#ifndef BVH_CACHE_H
#define BVH_CACHE_H

#include "tree/bvh.h"

/* Trees over fewer facets are built as fast as they are read, and not kept. */
enum { BVH_CACHE_LEAST = 50000 };

/* As bvh_build, with the same bytes. A file's name comes from all that the tree is built over and from
 * the sources that build it (BVH_LAYOUT of the Makefile); one that is damaged, or not a tree, is
 * written anew. The folder may be deleted at any time, and what hinders reading or writing in it is
 * not a failure. */
status bvh_cache_build(bvh **out, const bvh_source *source);

#endif
