/* Staging folder: a private folder beside the place of files that are being made. Its name is random,
 * others may not look into it, and it is locked while its process lives: what a killed process left
 * is known by the free lock and removed when the next one is opened in the same place. */
#ifndef STAGING_FOLDER_H
#define STAGING_FOLDER_H

#include "base/status.h"

typedef struct staging_folder staging_folder;

/* Makes `.radsig-XXXXXX` in the folder `parent`, after removing those that killed processes of this
 * user left there.
 *   wanted   what is to be made there, for the message
 * Fails with STATUS_FILE if the parent cannot be listed or takes no folder. */
status staging_folder_open(staging_folder **out, const char *parent, const char *wanted);

/* For programs that are told where to write. */
const char *staging_folder_path(const staging_folder *staging);

/* Descriptors of the folder and of its parent. */
int staging_folder_self(const staging_folder *staging);
int staging_folder_parent(const staging_folder *staging);

/* Removes the folder with all that it holds. NULL is allowed. */
void staging_folder_free(staging_folder *staging);

#endif
