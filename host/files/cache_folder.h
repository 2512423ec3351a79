/* Cache folder: files that can be made again, in $XDG_CACHE_HOME/radsig, or ~/.cache/radsig where that
 * is not set. It keeps to a budget of 4 GiB, or RADSIG_CACHE_GB (10^9 bytes; 0: nothing is kept). */
#ifndef CACHE_FOLDER_H
#define CACHE_FOLDER_H

#include <stdbool.h>
#include <stdint.h>

enum { CACHE_FOLDER_PATH = 4096 };

/* Makes a folder and those above it, for this user alone; whether files can be made in it. */
bool cache_folder_make(const char *path);

/* Writes the path of the cache folder, and makes it; false if there is none to be had. */
bool cache_folder_find(char out[CACHE_FOLDER_PATH]);

uint64_t cache_folder_budget(void);

/* Notes that an open file of the folder was used just now. */
void cache_folder_touch(int descriptor);

/* Removes the files that were used longest ago until the others, and `bytes` to come, take no more
 * than the budget; false if those to come alone do. Other programs may do so at the same time: what
 * they have open stays readable. */
bool cache_folder_make_room(const char *path, uint64_t bytes);

#endif
