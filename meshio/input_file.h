/* Input file: a regular file, open for reading. A pipe would keep the program waiting, and a device
 * may have no end. */
#ifndef MESHIO_INPUT_FILE_H
#define MESHIO_INPUT_FILE_H

#include <stddef.h>
#include <stdio.h>

/* Numbers of lines, corners and bytes of a text must fit 32 bit. */
#define INPUT_FILE_TEXT_LIMIT ((size_t)1 << 31)

/* Opens the file at `path`, through links; the caller closes *out.
 *   limit      largest size in bytes
 *   out_size   the file's bytes; NULL: not wanted
 * Returns 0, or non-zero with a message `path: ...`: no such file, a folder, a pipe, a device, a
 * socket, larger than the limit. */
int input_file_open(FILE **out, size_t *out_size, const char *path, size_t limit, char *message,
                    size_t message_size);

#endif
