#include "painting.h"

#include "image/colour_map.h"
#include "image/image.h"
#include "image/quick_look.h"

#include <math.h>
#include <string.h>

painting_scale painting_scale_of(const render_plane *plane, painting_map map, value_range range)
{
    const quick_look_colours own = quick_look_colours_of(&plane->plane);
    painting_scale scale = {.map = map,
                            .is_by_number = own == QUICK_LOOK_LABELS || own == QUICK_LOOK_IDS,
                            .is_facet = own == QUICK_LOOK_IDS,
                            .is_material = strstr(plane->name, "material") != NULL,
                            .range = range};

    if (map == PAINTING_OWN) scale.map = own == QUICK_LOOK_HEAT ? PAINTING_HEAT : PAINTING_GREY;
    return scale;
}

static void number_colour(const painting_scale *scale, const scene *s, double value,
                          uint8_t out_rgb[3])
{
    const uint32_t number = (uint32_t)(int64_t)value;
    uint32_t i = 0;

    if (scale->is_facet) {
        colour_map_id(number, out_rgb);
        return;
    }
    while (i < s->material_count && s->materials[i].record.number != number) i++;
    colour_map_category(scale->is_material && i < s->material_count ? i : number, out_rgb);
}

void painting_colour(const painting_scale *scale, const scene *s, double value, uint8_t out_rgb[3])
{
    static const uint8_t missing[3] = {172, 190, 214};
    const double fraction = (value - scale->range.min) / (scale->range.max - scale->range.min);

    if (!isfinite(value) || value == (double)IMAGE_NO_DATA)
        memcpy(out_rgb, missing, 3);
    else if (scale->is_by_number)
        number_colour(scale, s, value, out_rgb);
    else if (scale->map == PAINTING_HEAT)
        colour_map_heat(fraction, out_rgb);
    else if (scale->map == PAINTING_DIVERGING)
        colour_map_diverging(fraction, out_rgb);
    else
        colour_map_grey(fraction, out_rgb);
}

void painting_fill(const painting_scale *scale, const scene *s, const float *value, size_t count,
                   uint8_t *out_rgb)
{
    float last = NAN;

    for (size_t i = 0; i < count; i++) {
        if (value[i] == last) {
            memcpy(out_rgb + 3 * i, out_rgb + 3 * (i - 1), 3);
            continue;
        }
        last = value[i];
        painting_colour(scale, s, (double)last, out_rgb + 3 * i);
    }
}

void painting_subtract(const frame *minuend, const float *from, const frame *subtrahend,
                       const float *value, float *out)
{
    const int columns = minuend->camera.columns, rows = minuend->camera.rows;
    const int other_columns = subtrahend->camera.columns, other_rows = subtrahend->camera.rows;

    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            const size_t i = (size_t)row * (size_t)columns + (size_t)column;
            const size_t other_row = (size_t)row * (size_t)other_rows / (size_t)rows;
            const size_t other_column = (size_t)column * (size_t)other_columns / (size_t)columns;
            const float b = value[other_row * (size_t)other_columns + other_column];
            const bool missing = from[i] == IMAGE_NO_DATA || b == IMAGE_NO_DATA;
            out[i] = missing ? IMAGE_NO_DATA : from[i] - b;
        }
}

void painting_outline(const frame *f, const float *facet, uint8_t *rgb)
{
    static const uint8_t ink[3] = {0, 230, 118};
    const int columns = f->camera.columns, rows = f->camera.rows;

    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            const size_t i = (size_t)row * (size_t)columns + (size_t)column;
            const bool right = column + 1 < columns && facet[i + 1] != facet[i];
            const bool below = row + 1 < rows && facet[i + (size_t)columns] != facet[i];
            if (right || below) memcpy(rgb + 3 * i, ink, 3);
        }
}

void painting_histogram(const float *value, size_t count, value_range range, int bins,
                        double *out_fraction)
{
    double fullest = 1.0;

    memset(out_fraction, 0, (size_t)bins * sizeof *out_fraction);
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i]) || value[i] == IMAGE_NO_DATA) continue;
        const double place = ((double)value[i] - range.min) / (range.max - range.min) * bins;
        const int bin = (int)fmin(fmax(place, 0.0), bins - 1.0);
        out_fraction[bin] += 1.0;
        fullest = fmax(fullest, out_fraction[bin]);
    }
    for (int i = 0; i < bins; i++) out_fraction[i] /= fullest;
}
