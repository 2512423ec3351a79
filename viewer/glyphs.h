/* Glyphs: the printable ASCII characters in one size, drawn side by side into one image. */
#ifndef GLYPHS_H
#define GLYPHS_H

#include "base/status.h"

#include <stdint.h>

/* A character stands GLYPHS_PADDING pixels from the left of its cell. */
enum { GLYPHS_PADDING = 2 };

enum { GLYPHS_FIRST = ' ', GLYPHS_LAST = '~', GLYPHS_COUNT = GLYPHS_LAST - GLYPHS_FIRST + 1 };

typedef struct glyphs {
    int size;                  /* pixels of an em */
    int cell_width, height;    /* of each character in the image; the last cell is solid */
    int baseline;              /* below the top */
    int advance[GLYPHS_COUNT]; /* from a character to the next */
    int columns, rows;         /* pixels of the image */
    uint8_t *coverage;         /* shape (rows, columns), 0..255; the caller frees it */
} glyphs;

/* Fails with STATUS_FILE if the font is missing. */
status glyphs_draw(glyphs *out, int size);

/* Where the character's cell begins in the image; any other character is a `?`. */
void glyphs_place(const glyphs *g, char character, int *out_x, int *out_y);

int glyphs_advance(const glyphs *g, char character);

#endif
