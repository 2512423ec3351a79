/* Output folder: the files of one render. Each is written under a temporary name; all are renamed
 * together when the last one is whole, so that a render that fails leaves the folder as it was. */
#ifndef OUTPUT_FOLDER_H
#define OUTPUT_FOLDER_H

#include "output_file.h"

typedef struct output_folder output_folder;

/* Makes the folder and its parents where they are absent. Fails with STATUS_FILE if it cannot be
 * made or files cannot be made in it. */
status output_folder_open(output_folder **out, const char *path);

/* Reserves the file `name` of the folder, to be written under its temporary path. It belongs to the
 * folder, which commits it. Several threads may add at once. */
status output_folder_add(output_folder *folder, const char *name, const output_file **out);

/* Renames every file added to its name. Each must have been written and closed. */
status output_folder_commit(output_folder *folder);

/* Removes what was not committed, and the folders that were made for it. NULL is allowed. */
void output_folder_free(output_folder *folder);

#endif
