#include "image/quick_look.h"

#include "base/interrupt.h"
#include "image/colour_map.h"
#include "image/picture.h"
#include "image/value_range.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MARGIN = 12,
    GAP = 8,
    LINE = 18, /* height of a line of small text */
    HEADING_SIZE = 16,
    TEXT_SIZE = 12,
    SWATCH = 12, /* width of the bar and side of a legend's square */
    SHORT_SIDE = 256,
    LONG_SIDE = 4096,
    SHORTEST_BAR = 160,
    TICK_DISTANCE = 32,
    TEXT_LENGTH = 160,
    NAMED_LINES = 64,   /* of a legend */
    UNNAMED_LINES = 20, /* of numbers without a name, among those */
    NUMBERS = 1024      /* different numbers looked for */
};

static const uint8_t missing_rgb[3] = {172, 190, 214}, line_rgb[3] = {110, 110, 110};

/* One line beside the picture: a tick of the bar or a colour of the legend. */
typedef struct line {
    char text[TEXT_LENGTH];
    uint8_t rgb[3];
    uint32_t y; /* ticks: below the bar's top */
} line;

typedef struct layout {
    const quick_look *look;
    char heading[TEXT_LENGTH], subheading[TEXT_LENGTH];
    uint32_t factor;        /* of enlargement */
    uint32_t width, height; /* of the picture, enlarged */
    uint32_t top;           /* of the picture and of what stands beside it */
    uint32_t side, side_height;
    uint32_t page_width, page_height;
    value_range range;
    bool has_bar;
    line tick[VALUE_RANGE_TICKS], legend[NAMED_LINES + 2];
    uint32_t tick_count, legend_count;
} layout;

quick_look_colours quick_look_colours_of(const image_plane *plane)
{
    const char *unit = plane->unit ? plane->unit : "";

    if (plane->categorical)
        return strcmp(plane->name, "facet") == 0 ? QUICK_LOOK_IDS : QUICK_LOOK_LABELS;
    return strcmp(unit, "C") == 0 || strcmp(unit, "K") == 0 ? QUICK_LOOK_HEAT : QUICK_LOOK_GREY;
}

static const image_label *find_label(const quick_look *look, double number)
{
    for (size_t i = 0; i < look->label_count; i++)
        if (look->label[i].number == number) return &look->label[i];
    return NULL;
}

static void bar_colour(const layout *lay, double value, uint8_t rgb[3])
{
    const double fraction = (value - lay->range.min) / (lay->range.max - lay->range.min);

    if (lay->look->colours == QUICK_LOOK_HEAT)
        colour_map_heat(fraction, rgb);
    else
        colour_map_grey(fraction, rgb);
}

static void number_colour(const quick_look *look, double number, uint8_t rgb[3])
{
    const image_label *label = look->colours == QUICK_LOOK_LABELS ? find_label(look, number) : NULL;

    if (label)
        colour_map_category((uint32_t)(label - look->label), rgb);
    else
        colour_map_id((uint32_t)(int64_t)fmod(number, 4294967296.0), rgb);
}

static bool is_bar(const quick_look *look)
{
    return look->colours == QUICK_LOOK_GREY || look->colours == QUICK_LOOK_HEAT;
}

static void colour_of(const layout *lay, float value, uint8_t rgb[3])
{
    if (!isfinite(value) || value == IMAGE_NO_DATA)
        memcpy(rgb, missing_rgb, 3);
    else if (is_bar(lay->look))
        bar_colour(lay, (double)value, rgb);
    else
        number_colour(lay->look, (double)value, rgb);
}

/* Adds a number to the `count` that ascend, unless it is among them. */
static size_t note_number(float *number, size_t count, float value)
{
    size_t place = 0;

    while (place < count && number[place] < value) place++;
    if ((place < count && number[place] == value) || count == NUMBERS) return count;
    memmove(number + place + 1, number + place, (count - place) * sizeof *number);
    number[place] = value;
    return count + 1;
}

/* The numbers that occur, with their names; what a long list leaves out becomes `...`. */
static status list_labels(layout *lay)
{
    status rc = STATUS_OK;
    const quick_look *look = lay->look;
    const size_t pixels = (size_t)look->columns * look->rows;
    float number[NUMBERS], last = IMAGE_NO_DATA;
    size_t count = 0, unnamed = 0;
    bool is_cut = false;

    for (size_t i = 0; i < pixels; i++) {
        const float value = look->value[i];
        if (i % look->columns == 0) TRY(interrupt_check());
        if (!isfinite(value) || value == last || value == IMAGE_NO_DATA) continue;
        count = note_number(number, count, value);
        last = value;
    }
    for (size_t i = 0; i < count; i++) {
        const image_label *label = find_label(look, (double)number[i]);
        if (lay->legend_count == NAMED_LINES || (!label && unnamed == UNNAMED_LINES)) {
            is_cut = true;
            continue;
        }
        line *to = &lay->legend[lay->legend_count++];
        unnamed += !label;
        snprintf(to->text, sizeof to->text, "%.0f %s", (double)number[i], label ? label->name : "");
        number_colour(look, (double)number[i], to->rgb);
    }
    if (is_cut) {
        line *to = &lay->legend[lay->legend_count++];
        snprintf(to->text, sizeof to->text, "...");
        memset(to->rgb, 255, 3);
    }
out:
    return rc;
}

static uint32_t bar_height(const layout *lay)
{
    return lay->side_height - LINE - (lay->range.missing_count ? LINE + GAP : 0);
}

static void list_ticks(layout *lay)
{
    const double span = lay->range.max - lay->range.min, height = bar_height(lay) - 1;
    const double step = value_range_step(span * TICK_DISTANCE / height);
    double tick[VALUE_RANGE_TICKS];

    lay->tick_count = (uint32_t)value_range_ticks(&lay->range, step, tick);
    for (uint32_t i = 0; i < lay->tick_count; i++) {
        const double share = (tick[i] - lay->range.min) / span;
        line *to = &lay->tick[i];
        value_range_label(to->text, sizeof to->text, tick[i], step);
        to->y = (uint32_t)lround((1.0 - fmin(fmax(share, 0.0), 1.0)) * height);
    }
}

static status list_beside(layout *lay)
{
    status rc = STATUS_OK;

    if (lay->look->colours == QUICK_LOOK_LABELS) TRY(list_labels(lay));
    lay->has_bar = is_bar(lay->look) && lay->range.valid_count;
    if (lay->has_bar) list_ticks(lay);
    if (lay->range.missing_count) {
        line *to = &lay->legend[lay->legend_count++];
        snprintf(to->text, sizeof to->text, "no data");
        memcpy(to->rgb, missing_rgb, 3);
    }
out:
    return rc;
}

static void enlarge(layout *lay)
{
    const uint32_t columns = lay->look->columns, rows = lay->look->rows;
    const uint32_t shorter = columns < rows ? columns : rows;
    const uint32_t longer = columns < rows ? rows : columns;

    lay->factor = (SHORT_SIDE + shorter - 1) / shorter;
    while (lay->factor > 1 && (uint64_t)lay->factor * longer > LONG_SIDE) lay->factor--;
    lay->width = columns * lay->factor;
    lay->height = rows * lay->factor;
}

static status widen(uint32_t *width, uint32_t before, const char *text, int size)
{
    status rc = STATUS_OK;
    uint32_t own = 0;

    TRY(picture_text_width(&own, text, size));
    if (before + own + MARGIN > *width) *width = before + own + MARGIN;
out:
    return rc;
}

static const char *unit_of(const quick_look *look)
{
    return look->unit ? look->unit : "";
}

static status arrange(layout *lay, const quick_look *look)
{
    status rc = STATUS_OK;
    const uint32_t text_side = SWATCH + GAP;

    lay->look = look;
    TRY(value_range_find(&lay->range, look->value, (size_t)look->columns * look->rows,
                         IMAGE_NO_DATA));
    enlarge(lay);
    snprintf(lay->heading, sizeof lay->heading, "%s", look->plane);
    snprintf(lay->subheading, sizeof lay->subheading, "%s, %.10s %.8s UTC", look->scene, look->time,
             strlen(look->time) > 11 ? look->time + 11 : "");
    lay->side_height = lay->height > SHORTEST_BAR ? lay->height : SHORTEST_BAR;
    TRY(list_beside(lay));
    if (!lay->has_bar && lay->legend_count * LINE > lay->side_height)
        lay->side_height = lay->legend_count * LINE;
    lay->top = MARGIN + HEADING_SIZE + LINE + GAP;
    lay->side = MARGIN + lay->width + MARGIN;
    lay->page_width = lay->side;
    TRY(widen(&lay->page_width, MARGIN, lay->heading, HEADING_SIZE));
    TRY(widen(&lay->page_width, MARGIN, lay->subheading, TEXT_SIZE));
    if (lay->has_bar) TRY(widen(&lay->page_width, lay->side, unit_of(look), TEXT_SIZE));
    for (uint32_t i = 0; i < lay->tick_count; i++)
        TRY(widen(&lay->page_width, lay->side + text_side + 4, lay->tick[i].text, TEXT_SIZE));
    for (uint32_t i = 0; i < lay->legend_count; i++)
        TRY(widen(&lay->page_width, lay->side + text_side, lay->legend[i].text, TEXT_SIZE));
    lay->page_height = lay->top + lay->side_height + MARGIN;
out:
    return rc;
}

static void draw_frame(picture *pic, uint32_t x, uint32_t y, uint32_t width, uint32_t height)
{
    picture_fill(pic, x - 1, y - 1, width + 2, height + 2, line_rgb);
}

static void draw_pixels(picture *pic, const layout *lay)
{
    const quick_look *look = lay->look;
    uint8_t rgb[3] = {0};
    float last = NAN;
    uint32_t end;
    const uint32_t first = picture_rows(pic, &end);

    draw_frame(pic, MARGIN, lay->top, lay->width, lay->height);
    for (uint32_t row = first > lay->top ? (first - lay->top) / lay->factor : 0;
         row < look->rows && lay->top + row * lay->factor < end; row++)
        for (uint32_t column = 0; column < look->columns; column++) {
            const float value = look->value[(size_t)row * look->columns + column];
            if (value != last) colour_of(lay, value, rgb);
            last = value;
            picture_fill(pic, MARGIN + column * lay->factor, lay->top + row * lay->factor,
                         lay->factor, lay->factor, rgb);
        }
}

static status draw_bar(picture *pic, const layout *lay)
{
    status rc = STATUS_OK;
    const uint32_t height = bar_height(lay), top = lay->top + LINE;

    TRY(picture_text(pic, lay->side, lay->top + TEXT_SIZE - 2, unit_of(lay->look), TEXT_SIZE));
    draw_frame(pic, lay->side, top, SWATCH, height);
    for (uint32_t y = 0; y < height; y++) {
        const double fraction = 1.0 - (double)y / (height - 1);
        uint8_t rgb[3];
        bar_colour(lay, lay->range.min + fraction * (lay->range.max - lay->range.min), rgb);
        picture_fill(pic, lay->side, top + y, SWATCH, 1, rgb);
    }
    for (uint32_t i = 0; i < lay->tick_count; i++) {
        const uint32_t y = top + lay->tick[i].y;
        picture_fill(pic, lay->side + SWATCH, y, 6, 1, line_rgb);
        TRY(picture_text(pic, lay->side + SWATCH + GAP + 4, y + TEXT_SIZE / 3, lay->tick[i].text,
                         TEXT_SIZE));
    }
out:
    return rc;
}

/* The legend starts on top; below a bar it is the last line alone. */
static status draw_legend(picture *pic, const layout *lay)
{
    status rc = STATUS_OK;
    uint32_t y = lay->has_bar ? lay->top + lay->side_height - SWATCH : lay->top;

    for (uint32_t i = 0; i < lay->legend_count; i++, y += LINE) {
        picture_fill(pic, lay->side, y, SWATCH, SWATCH, lay->legend[i].rgb);
        TRY(picture_text(pic, lay->side + SWATCH + GAP, y + SWATCH - 2, lay->legend[i].text,
                         TEXT_SIZE));
    }
out:
    return rc;
}

static status draw_page(picture *pic, const void *self)
{
    status rc = STATUS_OK;
    const layout *lay = self;

    TRY(picture_text(pic, MARGIN, MARGIN + HEADING_SIZE - 3, lay->heading, HEADING_SIZE));
    TRY(picture_text(pic, MARGIN, MARGIN + HEADING_SIZE + LINE - 4, lay->subheading, TEXT_SIZE));
    draw_pixels(pic, lay);
    if (lay->has_bar) TRY(draw_bar(pic, lay));
    TRY(draw_legend(pic, lay));
out:
    return rc;
}

status quick_look_write(output_folder *folder, const char *name, const quick_look *look)
{
    status rc = STATUS_OK;
    output_file *place = NULL;
    layout *lay = calloc(1, sizeof *lay);

    NEED(lay, STATUS_MEMORY, "%s: no memory to draw it", name);
    TRY(arrange(lay, look));
    TRY(output_folder_add(folder, name, &place));
    TRY(picture_write(place, lay->page_width, lay->page_height, draw_page, lay));
out:
    free(lay);
    return rc;
}
