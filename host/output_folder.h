/* Output folder: the files of one render. Each is written under a temporary name; all are renamed
 * together when the last one is whole, so that a render that fails leaves the folder as it was. */
#ifndef OUTPUT_FOLDER_H
#define OUTPUT_FOLDER_H

#include "status.h"

typedef struct output_folder output_folder;

/* Makes the folder and its parents where they are absent. Fails with STATUS_FILE if it cannot be
 * made or files cannot be made in it. */
status output_folder_open(output_folder **out, const char *path);

/* Reserves the file `name` of the folder.
 *   out_temporary_path   to write it under; belongs to the folder */
status output_folder_add(output_folder *folder, const char *name, const char **out_temporary_path);

/* Renames every file added to its name. Each must have been written and closed. */
status output_folder_commit(output_folder *folder);

/* Removes what was not committed, and the folders that were made for it. NULL is allowed. */
void output_folder_free(output_folder *folder);

#endif
