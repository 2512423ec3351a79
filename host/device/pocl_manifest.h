/* PoCL manifest: the files of PoCL's cache with their hashes, because PoCL ends or crashes the process at a
 * damaged one, in every run. */
#ifndef POCL_MANIFEST_H
#define POCL_MANIFEST_H

/* Removes kernels from PoCL's cache that are not what they were, with a warning each, so that they are built
 * again. Those that are not in the manifest yet must be whole as to their form. */
void pocl_manifest_check(const char *folder);

/* Writes the manifest where files were added. What hinders it is not a failure. */
void pocl_manifest_update(const char *folder);

#endif
