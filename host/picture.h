/* Picture: an 8-bit RGB image that is drawn into and written as PNG. */
#ifndef PICTURE_H
#define PICTURE_H

#include "output_file.h"

#include <stdint.h>

typedef struct picture picture;

/* Loads what draws and writes pictures (image_file_prepare): first of all where a picture is the result.
 * Fails with STATUS_FILE if it cannot be loaded. */
status picture_prepare(void);

/* White all over. */
status picture_create(picture **out, uint32_t width, uint32_t height);

/* Row 0 on top; the rectangle must lie inside. */
void picture_fill(picture *pic, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                  const uint8_t rgb[3]);

/* Draws ASCII text from x on, its baseline at y. Fails with STATUS_FILE if the font is missing; so
 * does picture_text_width. */
status picture_text(picture *pic, uint32_t x, uint32_t y, const char *text, int size);
status picture_text_width(uint32_t *out_width, const char *text, int size);

/* Writes under the temporary path of `place`, which stays to be committed. */
status picture_write(const picture *pic, output_file *place);

void picture_free(picture *pic);

#endif
