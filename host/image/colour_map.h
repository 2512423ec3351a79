/* Colour maps of the quick looks, sRGB. */
#ifndef COLOUR_MAP_H
#define COLOUR_MAP_H

#include <stdint.h>

/* These take a fraction of 0..1, and cut what lies outside. */
void colour_map_grey(double fraction, uint8_t out_rgb[3]);

/* The colours of matplotlib's `inferno` (S. van der Walt and N. Smith, CC0), within 2 of 255. */
void colour_map_heat(double fraction, uint8_t out_rgb[3]);

/* Blue, white at 0.5, red: the ends and the middle of ColorBrewer's RdBu (C. Brewer), straight lines
 * between them. */
void colour_map_diverging(double fraction, uint8_t out_rgb[3]);

/* Colour of the n-th category; the first 22 differ as much as possible: K. L. Kelly, Twenty-two
 * colors of maximum contrast, Color Engineering 3 (1965). Those beyond are hashed. */
void colour_map_category(uint32_t n, uint8_t out_rgb[3]);

/* A colour hashed from a number, never dark; neighbours in number differ. */
void colour_map_id(uint32_t id, uint8_t out_rgb[3]);

#endif
