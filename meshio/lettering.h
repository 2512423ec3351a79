/* Text drawn into 8-bit RGB images, in DejaVu Sans (Debian's fonts-dejavu-core). */
#ifndef MESHIO_LETTERING_H
#define MESHIO_LETTERING_H

#include <stddef.h>
#include <stdint.h>

/* The image that is drawn into; rgb has shape (height, width, 3), rows from the top. */
typedef struct lettering_page {
    uint32_t width, height;
    uint8_t *rgb;
} lettering_page;

/* Width in pixels of a text in letters `size` pixels high. Here and below a character outside ASCII
 * becomes `?`: OpenImageIO 2.4 draws others in their place.
 * Returns 0, or non-zero with a message that names the package if the font is missing. */
int lettering_width(int *out_width, const char *text, int size, char *message, size_t message_size);

/* Draws a text from x on, with its baseline at y; what lies outside the page is cut.
 * Returns 0, or non-zero as lettering_width does. */
int lettering_draw(const lettering_page *page, int x, int y, const char *text, int size,
                   const uint8_t colour[3], char *message, size_t message_size);

#endif
