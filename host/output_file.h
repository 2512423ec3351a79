/* Output file: is written under a temporary name beside its place and renamed when it is whole, so
 * that a run that fails or is killed leaves the old file as it was. */
#ifndef OUTPUT_FILE_H
#define OUTPUT_FILE_H

#include "status.h"

#include <stdio.h>

typedef struct output_file output_file;

/* Opens a temporary file for writing; `path` is untouched until the commit. Fails with STATUS_FILE if
 * its folder takes no file, or if it is a folder or a device. */
status output_file_open(output_file **out, const char *path);

/* For libraries that write by name: reserves the temporary name and opens nothing. */
status output_file_reserve(output_file **out, const char *path);

/* NULL for a reserved file. */
FILE *output_file_stream(output_file *file);
const char *output_file_temporary_path(const output_file *file);
const char *output_file_path(const output_file *file);

/* Flushes, closes and renames. Fails with STATUS_FILE if any write failed, for example on a full
 * disk; the old file is then still in place. */
status output_file_commit(output_file *file);

/* Removes the temporary file unless it was committed. */
void output_file_free(output_file *file);

#endif
