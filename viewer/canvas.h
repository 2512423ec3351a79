/* Canvas: rectangles, lines, text and pictures in pixels of a surface, drawn by OpenGL. x runs to the
 * right, y down, from the top left corner. */
#ifndef CANVAS_H
#define CANVAS_H

#include "surface.h"

#include <stdint.h>

typedef struct canvas canvas;

typedef struct canvas_colour {
    uint8_t r, g, b, a; /* a: 255 hides what is below */
} canvas_colour;

typedef enum canvas_size { CANVAS_TEXT, CANVAS_HEADING, CANVAS_SIZES } canvas_size;

/* Pictures that can be on the canvas at a time. */
enum { CANVAS_PICTURES = 2 };

/* Pixels of text at scale 1. */
enum { CANVAS_TEXT_SIZE = 12, CANVAS_HEADING_SIZE = 16 };

/* Needs the surface's context to be current.
 *   scale   of the letters
 * Fails with STATUS_DEVICE where OpenGL lacks something, STATUS_FILE where the font is missing. */
status canvas_open(canvas **out, const surface *s, double scale);
void canvas_free(canvas *c);

/* Height of a line of text. */
int canvas_line_height(const canvas *c, canvas_size size);
int canvas_text_width(const canvas *c, canvas_size size, const char *text);

/* Fills the surface, which has this size, with white. */
void canvas_begin(canvas *c, int width, int height);
void canvas_fill(canvas *c, double x, double y, double width, double height, canvas_colour colour);
void canvas_line(canvas *c, double x0, double y0, double x1, double y1, double width,
                 canvas_colour colour);

/* The text's line has its top left corner at x, y, which are rounded, so that letters are crisp. */
void canvas_text(canvas *c, double x, double y, canvas_size size, canvas_colour colour,
                 const char *text);

/* Keeps picture `index` for canvas_picture. rgb   shape (rows, columns, 3) */
void canvas_load_picture(canvas *c, int index, int columns, int rows, const uint8_t *rgb);

/* Draws it into the rectangle: enlarged its pixels stay sharp, reduced they are mixed. */
void canvas_picture(canvas *c, int index, double x, double y, double width, double height);

/* Draws what is left to draw. Fails with STATUS_DEVICE on any error of OpenGL since canvas_begin. */
status canvas_end(canvas *c);

/* Reads what was drawn. out_rgb   shape (height, width, 3) of canvas_begin */
status canvas_read(canvas *c, uint8_t *out_rgb);

#endif
