/* Picture: an 8-bit RGB image that is drawn and written as PNG, strip by strip: memory does not grow with
 * its height. */
#ifndef PICTURE_H
#define PICTURE_H

#include "files/output_file.h"

#include <stdint.h>

/* The strip that is being drawn; coordinates are the whole picture's, and what lies outside is cut. */
typedef struct picture picture;

/* Loads what draws and writes pictures (image_file_prepare): first of all where a picture is the result.
 * Fails with STATUS_FILE if it cannot be loaded. */
status picture_prepare(void);

/* Row 0 on top; the rectangle must lie inside the picture. */
void picture_fill(picture *pic, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                  const uint8_t rgb[3]);

/* The rows that are drawn now, for what would take long to draw in vain: first .. end - 1. */
uint32_t picture_rows(const picture *pic, uint32_t *out_end);

/* Draws ASCII text from x on, its baseline at y. Fails with STATUS_FILE if the font is missing; so
 * does picture_text_width. */
status picture_text(picture *pic, uint32_t x, uint32_t y, const char *text, int size);
status picture_text_width(uint32_t *out_width, const char *text, int size);

/* Draws all of a picture, white at first: once for each strip, with the same result. */
typedef status picture_painter(picture *pic, const void *self);

/* Draws a picture and writes it to `place`, which stays to be committed. */
status picture_write(output_file *place, uint32_t width, uint32_t height, picture_painter *paint,
                     const void *self);

#endif
