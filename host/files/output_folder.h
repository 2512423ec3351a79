/* Output folder: the files of one render. Each is written in a staging folder; all come to their
 * places together when the last one is whole, so that a render that fails leaves the folder as it
 * was, and of two renders at once one whole set stands there. */
#ifndef OUTPUT_FOLDER_H
#define OUTPUT_FOLDER_H

#include "files/output_file.h"

typedef struct output_folder output_folder;

/* Makes the folder and its parents where they are absent, and removes what killed runs left in it.
 * Fails with STATUS_FILE if it cannot be made or files cannot be made in it. */
status output_folder_open(output_folder **out, const char *path);

/* Opens the file `name` of the folder for writing. It belongs to the folder, which commits it; whoever
 * writes closes it. Several threads may add at once. */
status output_folder_add(output_folder *folder, const char *name, output_file **out);

/* As output_file_commit_all, of every file added. */
status output_folder_commit(output_folder *folder);

/* Removes what was not committed, and the folders that were made for it. NULL is allowed. */
void output_folder_free(output_folder *folder);

#endif
