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

/* Reads a whole file; the caller frees *out, which ends with a zero byte beyond its size. Returns 0, or
 * non-zero with a message as above. */
int input_file_read(char **out, size_t *out_size, const char *path, size_t limit, char *message,
                    size_t message_size);

/* Is told of a file that was read as a whole: the bytes that are used.
 *   bytes   shape (size); gone after the call */
typedef void input_file_observer(void *self, const char *path, const void *bytes, size_t size);

/* From now on what this thread reads is told to `observer`; NULL: to nobody. */
void input_file_observe(input_file_observer *observer, void *self);

/* Tells it; input_file_read does so by itself. */
void input_file_tell(const char *path, const void *bytes, size_t size);

#endif
