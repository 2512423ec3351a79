/* Images written as OpenEXR (named float planes) and PNG (8 bit), and planes of an OpenEXR read
 * back. The same input gives the same bytes. The caller opens the file to write, and closes it.
 * OpenImageIO, which does the work, is part of a plug-in (plugin.h); where that cannot be loaded all
 * functions fail. */
#ifndef MESHIO_IMAGE_FILE_H
#define MESHIO_IMAGE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A string stored in the image under a key. The key `DateTime` (`1987:06:24 15:00:00`) is the time of
 * capture; without it an OpenEXR holds an empty one and a PNG none. */
typedef struct image_text {
    const char *key, *value;
} image_text;

/* What both formats share; rows run from the top, columns from the left. */
typedef struct image_frame {
    uint32_t width, height;
    const image_text *text; /* shape (text_count) */
    size_t text_count;
    bool (*is_cancelled)(
        void); /* asked before each row: true ends the writing, which fails; NULL: nobody */
} image_frame;

typedef struct image_channel {
    const char *name;   /* readers see the channels sorted by name */
    const float *value; /* shape (height, width) */
    double low, high;   /* low < high: written as the fraction of the way from low to high, 0..1 */
} image_channel;

/* Gives row y of an 8-bit RGB image, shape (width, 3), valid until the next one is asked for. They are asked
 * for from the top, each once. NULL ends the writing, which fails. */
typedef const uint8_t *image_row_source(void *self, uint32_t y);

typedef enum image_compression { IMAGE_NONE, IMAGE_ZIP } image_compression;

/* Loads the plug-in, which takes a while: called beside other work, or before work whose result would
 * otherwise be lost. Returns 0, or non-zero with `path: ...`. */
int image_file_prepare(char *message, size_t message_size);

/* Writes the channels, float32 and exact, under their names (each once), and flushes the file. Holds some
 * rows of all channels in memory.
 *   path   names the file in the message
 * Returns 0, or non-zero with `path: ...`: disk full, no channels, a name given twice. What was
 * written then remains. */
int image_file_write_exr(FILE *file, const char *path, const image_frame *frame,
                         const image_channel *channel, size_t channel_count,
                         image_compression compression, char *message, size_t message_size);

/* Writes 8-bit RGB row by row, of which it holds one. Fails as image_file_write_exr does. */
int image_file_write_png(FILE *file, const char *path, const image_frame *frame,
                         image_row_source *row, void *self, char *message, size_t message_size);

/* Reads the channel called `name` of an OpenEXR file.
 *   out   shape (height, width), released by the caller with free()
 * Returns 0, or non-zero with `path: ...`: no such file, no such channel, damaged. */
int image_file_read_channel(float **out, uint32_t *out_width, uint32_t *out_height,
                            const char *path, const char *name, char *message, size_t message_size);

#endif
