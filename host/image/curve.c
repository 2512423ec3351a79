#include "image/curve.h"

#include "image/picture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    PAGE_WIDTH = 800,
    PAGE_HEIGHT = 460,
    LEFT = 64,
    TOP = 60,
    WIDTH = 710,
    HEIGHT = 350,
    TITLE_SIZE = 18,
    TEXT_SIZE = 13,
    PEN = 2,
    TICK_LIMIT = 8,
    DECADES = 6
};

/* What the axes span; of a logarithmic one low, high and step are powers of ten. */
typedef struct axes {
    double low_x, high_x, low, high, step, step_x;
    double least; /* cut there before the logarithm */
    bool is_log, is_log_x;
} axes;

/* The smallest of 1, 2, 5, 10 ... that cuts the range into TICK_LIMIT steps or fewer. */
static double round_step(double range)
{
    const double least = fmax(range, 1e-6) / TICK_LIMIT;
    const double power = pow(10.0, floor(log10(least)));
    const double times = least / power;

    return power * (times <= 1.0 ? 1.0 : times <= 2.0 ? 2.0 : times <= 5.0 ? 5.0 : 10.0);
}

static double highest_of(const curve *c)
{
    double highest = c->line[0].value[0];

    for (size_t k = 0; k < c->line_count; k++)
        for (size_t i = 0; i < c->count; i++) highest = fmax(highest, c->line[k].value[i]);
    return highest;
}

static double height_of(const axes *a, double value)
{
    return a->is_log ? log10(fmax(value, a->least)) : value;
}

static axes axes_of(const curve *c)
{
    axes a = {.low_x = c->x[0],
              .high_x = c->x[c->count - 1],
              .is_log = c->is_log,
              .is_log_x = c->is_log_x};
    const double range = a.high_x - a.low_x, highest = highest_of(c);

    a.least = fmax(highest, 1e-30) * pow(10.0, -DECADES);
    a.low = a.high = height_of(&a, highest);
    for (size_t k = 0; k < c->line_count; k++)
        for (size_t i = 0; i < c->count; i++)
            if (!isnan(c->line[k].value[i]))
                a.low = fmin(a.low, height_of(&a, c->line[k].value[i]));
    a.step = a.is_log ? 1.0 : round_step(a.high - a.low);
    a.low = a.step * floor(a.low / a.step);
    a.high = fmax(a.low + a.step, a.step * ceil(a.high / a.step));
    a.step_x =
        strcmp(c->x_unit, "h") ? round_step(range) : 6.0 * fmax(1.0, ceil(range / 6.0 / 12.0));
    return a;
}

/* From 0 at the left end of the axis to 1. */
static double share_of(const axes *a, double x)
{
    if (a->is_log_x) return log(x / a->low_x) / log(a->high_x / a->low_x);
    return (x - a->low_x) / (a->high_x - a->low_x);
}

static double x_of(const axes *a, double fraction)
{
    if (a->is_log_x) return a->low_x * pow(a->high_x / a->low_x, fraction);
    return a->low_x + (a->high_x - a->low_x) * fraction;
}

static uint32_t column_of(const axes *a, double x)
{
    return LEFT + (uint32_t)lround((WIDTH - 1) * share_of(a, x));
}

/* The first tick, and the one after another: each step, or 1, 2, 5, 10 and so on. */
static double first_tick(const axes *a)
{
    if (!a->is_log_x) return a->step_x * ceil(a->low_x / a->step_x);
    return round_step(TICK_LIMIT * a->low_x);
}

static double next_tick(const axes *a, double x)
{
    return a->is_log_x ? round_step(TICK_LIMIT * 1.01 * x) : x + a->step_x;
}

static uint32_t row_of(const axes *a, double height)
{
    return TOP + (uint32_t)lround((HEIGHT - 1) * (a->high - height) / (a->high - a->low));
}

static status draw_axes(picture *pic, const axes *a, const char *x_unit)
{
    status rc = STATUS_OK;
    static const uint8_t grid[3] = {215, 215, 215};
    char text[32];
    uint32_t width;

    for (double v = a->low; v <= a->high + 0.5 * a->step; v += a->step) {
        const double value = a->is_log ? pow(10.0, v) : v;
        snprintf(text, sizeof text, "%g", fabs(value) < 1e-9 * a->step && !a->is_log ? 0.0 : value);
        TRY(picture_text_width(&width, text, TEXT_SIZE));
        picture_fill(pic, LEFT, row_of(a, v), WIDTH, 1, grid);
        TRY(picture_text(pic, LEFT - 8 - width, row_of(a, v) + TEXT_SIZE / 2 - 2, text, TEXT_SIZE));
    }
    for (double x = first_tick(a); x <= a->high_x; x = next_tick(a, x)) {
        snprintf(text, sizeof text, "%g %s", x, x_unit);
        TRY(picture_text_width(&width, text, TEXT_SIZE));
        picture_fill(pic, column_of(a, x), TOP, 1, HEIGHT, grid);
        TRY(picture_text(pic, column_of(a, x) - width / 2, TOP + HEIGHT + 20, text, TEXT_SIZE));
    }
out:
    return rc;
}

/* Linear between the values, a column of the picture at a time. */
static void draw_line(picture *pic, const axes *a, const curve *c, const curve_line *line)
{
    uint32_t last = 0;
    bool is_drawn = false;

    for (uint32_t column = 0, i = 0; column + PEN <= WIDTH; column++) {
        const double x = x_of(a, (double)column / (WIDTH - 1));
        while (i + 2 < c->count && c->x[i + 1] < x) i++;
        const double fraction = (x - c->x[i]) / (c->x[i + 1] - c->x[i]);
        const double value = line->value[i] + fraction * (line->value[i + 1] - line->value[i]);
        if (isnan(value)) {
            is_drawn = false;
            continue;
        }
        const uint32_t row = row_of(a, height_of(a, value));
        if (!is_drawn) last = row;
        is_drawn = true;
        const uint32_t upper = row < last ? row : last;
        if (!a->is_log || value > a->least)
            picture_fill(pic, LEFT + column, upper, PEN, (row > last ? row : last) - upper + PEN,
                         line->rgb);
        last = row;
    }
}

static status draw_names(picture *pic, const curve *c)
{
    status rc = STATUS_OK;
    uint32_t x = LEFT, width;
    char text[128];

    snprintf(text, sizeof text, "%s [%s]", c->title, c->unit);
    TRY(picture_text(pic, LEFT, 26, text, TITLE_SIZE));
    for (size_t k = 0; k < c->line_count; k++) {
        TRY(picture_text_width(&width, c->line[k].name, TEXT_SIZE));
        if (x + 24 + width > PAGE_WIDTH) break;
        picture_fill(pic, x, 42, 16, 4, c->line[k].rgb);
        TRY(picture_text(pic, x + 22, 49, c->line[k].name, TEXT_SIZE));
        x += 22 + width + 24;
    }
out:
    return rc;
}

static status draw_page(picture *pic, const void *self)
{
    status rc = STATUS_OK;
    const curve *c = self;
    const axes a = axes_of(c);

    TRY(draw_axes(pic, &a, c->x_unit));
    for (size_t k = 0; k < c->line_count; k++) draw_line(pic, &a, c, &c->line[k]);
    TRY(draw_names(pic, c));
out:
    return rc;
}

static status write_page(output_file *place, const curve *c)
{
    return picture_write(place, PAGE_WIDTH, PAGE_HEIGHT, draw_page, c);
}

status curve_write(const char *path, const curve *c)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    TRY(write_page(file, c));
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

status curve_write_into(output_folder *folder, const char *name, const curve *c)
{
    status rc = STATUS_OK;
    output_file *place;

    TRY(output_folder_add(folder, name, &place));
    TRY(write_page(place, c));
out:
    return rc;
}
