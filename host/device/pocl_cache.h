/* PoCL's cache: the folder in which it keeps the kernels that it built, without which it has no device. */
#ifndef POCL_CACHE_H
#define POCL_CACHE_H

#include <stdbool.h>

/* Has PoCL take a folder that can be written and has room, unless POCL_CACHE_DIR is set: PoCL's own
 * ($XDG_CACHE_HOME/pocl/kcache or ~/.cache/pocl/kcache), else, with a warning, radsig-UID/pocl in
 * XDG_RUNTIME_DIR, TMPDIR or /tmp. The first call chooses, and writes the environment: it comes before
 * OpenCL's first, and before other threads read the environment. */
void pocl_cache_choose(void);

/* The folder, and whether PoCL can use it. */
const char *pocl_cache_folder(void);
bool pocl_cache_is_usable(void);

#endif
