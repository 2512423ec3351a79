/* Output file: one that is written in a staging folder and comes to its place when it is whole, so
 * that a run that fails or is killed leaves the old file as it was; alone, or with others that are
 * committed together. */
#ifndef OUTPUT_FILE_H
#define OUTPUT_FILE_H

#include "files/staging_folder.h"

#include <stddef.h>
#include <stdio.h>

typedef struct output_file output_file;

/* Opens a new file for writing, exclusively; `path` is untouched until the commit. Fails with
 * STATUS_FILE if its folder takes no file, or if it is a folder or a device. */
status output_file_open(output_file **out, const char *path);

/* The same in a staging folder that stands beside `path`, outlives the file, and removes it unless
 * it was committed. Fails with STATUS_FILE if it has a file of this name already. */
status output_file_open_staged(output_file **out, const staging_folder *staging, const char *path);

/* For reading and writing, until the file is closed. */
FILE *output_file_stream(output_file *file);
const char *output_file_path(const output_file *file);

/* Closes the stream; the file can be committed still. Fails with STATUS_FILE if any write failed, for
 * example on a full disk. */
status output_file_close(output_file *file);

/* Closes the files, has the disk store them, gives them the permissions of the files that they
 * replace, and exchanges them with those: headers (.hdr) behind the others, reports (.json) last.
 * A link is replaced, not followed. Other processes that commit into this folder wait. When an
 * exchange fails those before it are taken back, and all old files are in their places; the same if
 * a write failed (STATUS_FILE). All stand in one folder. */
status output_file_commit_all(output_file *const *file, size_t count);
status output_file_commit(output_file *file);

/* Closes the file, and removes it if it was opened alone and not committed. NULL is allowed. */
void output_file_free(output_file *file);

#endif
