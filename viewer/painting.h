/* Painting: turns the values of a plane into colours. */
#ifndef PAINTING_H
#define PAINTING_H

#include "frame.h"
#include "image/value_range.h"

typedef enum painting_map {
    PAINTING_OWN, /* the one that suits the plane */
    PAINTING_GREY,
    PAINTING_HEAT,
    PAINTING_DIVERGING, /* blue below the middle of the range, red above */
    PAINTING_MAPS
} painting_map;

/* What the colours stand for. */
typedef struct painting_scale {
    painting_map map;  /* not PAINTING_OWN, unless the values are numbers of things */
    bool is_by_number; /* a colour for each number */
    bool is_facet;     /* and that hashed */
    bool is_material;  /* the number is a material's code */
    value_range range;
} painting_scale;

/* The map that suits a plane, unless `map` is another one. */
painting_scale painting_scale_of(const render_plane *plane, painting_map map, value_range range);

/* Colour of a value: neutral for one that is missing.
 *   s   gives materials their colours */
void painting_colour(const painting_scale *scale, const scene *s, double value, uint8_t out_rgb[3]);

/* value   shape (count); out_rgb   shape (count, 3) */
void painting_fill(const painting_scale *scale, const scene *s, const float *value, size_t count,
                   uint8_t *out_rgb);

/* Subtracts pixel by pixel; the subtrahend's pixels are repeated or left out to fit. A value that is
 * missing in either is missing.
 *   out   shape (rows, columns) of the minuend */
void painting_subtract(const frame *minuend, const float *from, const frame *subtrahend,
                       const float *value, float *out);

/* Draws the borders between facets: pixels whose right or lower neighbour shows another one. */
void painting_outline(const frame *f, const float *facet, uint8_t *rgb);

/* Counts the values in equal parts of the range; those outside count for the first and last part.
 *   out_share   shape (bins): of the fullest bin */
void painting_histogram(const float *value, size_t count, value_range range, int bins,
                        double *out_fraction);

#endif
