#include "curve.h"

#include "picture.h"

#include <math.h>
#include <stdio.h>

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
    TICK_LIMIT = 8
};

/* What the axes span. */
typedef struct axes {
    double low_h, high_h, low, high, step, step_h;
} axes;

/* The smallest of 1, 2, 5, 10 ... that cuts the range into TICK_LIMIT steps or fewer. */
static double round_step(double range)
{
    const double least = fmax(range, 1e-6) / TICK_LIMIT;
    const double power = pow(10.0, floor(log10(least)));
    const double times = least / power;

    return power * (times <= 1.0 ? 1.0 : times <= 2.0 ? 2.0 : times <= 5.0 ? 5.0 : 10.0);
}

static axes axes_of(const curve *c)
{
    axes a = {.low_h = c->time_h[0], .high_h = c->time_h[c->count - 1]};

    a.low = a.high = c->line[0].value[0];
    for (size_t k = 0; k < c->line_count; k++) {
        for (size_t i = 0; i < c->count; i++) {
            a.low = fmin(a.low, c->line[k].value[i]);
            a.high = fmax(a.high, c->line[k].value[i]);
        }
    }
    a.step = round_step(a.high - a.low);
    a.low = a.step * floor(a.low / a.step);
    a.high = fmax(a.low + a.step, a.step * ceil(a.high / a.step));
    a.step_h = 6.0 * fmax(1.0, ceil((a.high_h - a.low_h) / 6.0 / 12.0));
    return a;
}

static uint32_t column_of(const axes *a, double time_h)
{
    return LEFT + (uint32_t)lround((WIDTH - 1) * (time_h - a->low_h) / (a->high_h - a->low_h));
}

static uint32_t row_of(const axes *a, double value)
{
    return TOP + (uint32_t)lround((HEIGHT - 1) * (a->high - value) / (a->high - a->low));
}

static status draw_axes(picture *pic, const axes *a)
{
    status rc = STATUS_OK;
    static const uint8_t grid[3] = {215, 215, 215};
    char text[32];
    uint32_t width;

    for (double v = a->low; v <= a->high + 0.5 * a->step; v += a->step) {
        snprintf(text, sizeof text, "%g", fabs(v) < 1e-9 * a->step ? 0.0 : v);
        TRY(picture_text_width(&width, text, TEXT_SIZE));
        picture_fill(pic, LEFT, row_of(a, v), WIDTH, 1, grid);
        TRY(picture_text(pic, LEFT - 8 - width, row_of(a, v) + TEXT_SIZE / 2 - 2, text, TEXT_SIZE));
    }
    for (double h = a->step_h * ceil(a->low_h / a->step_h); h <= a->high_h; h += a->step_h) {
        snprintf(text, sizeof text, "%g h", h);
        TRY(picture_text_width(&width, text, TEXT_SIZE));
        picture_fill(pic, column_of(a, h), TOP, 1, HEIGHT, grid);
        TRY(picture_text(pic, column_of(a, h) - width / 2, TOP + HEIGHT + 20, text, TEXT_SIZE));
    }
out:
    return rc;
}

/* Linear between the values, a column of the picture at a time. */
static void draw_line(picture *pic, const axes *a, const curve *c, const curve_line *line)
{
    uint32_t last = row_of(a, line->value[0]);

    for (uint32_t x = 0, i = 0; x + PEN <= WIDTH; x++) {
        const double time_h = a->low_h + (a->high_h - a->low_h) * x / (WIDTH - 1);
        while (i + 2 < c->count && c->time_h[i + 1] < time_h) i++;
        const double share = (time_h - c->time_h[i]) / (c->time_h[i + 1] - c->time_h[i]);
        const double value = line->value[i] + share * (line->value[i + 1] - line->value[i]);
        const uint32_t row = row_of(a, value), upper = row < last ? row : last;
        picture_fill(pic, LEFT + x, upper, PEN, (row > last ? row : last) - upper + PEN, line->rgb);
        last = row;
    }
}

static status draw_names(picture *pic, const curve *c)
{
    status rc = STATUS_OK;
    uint32_t x = LEFT, width;
    char text[64];

    TRY(picture_text(pic, LEFT, 26, c->title, TITLE_SIZE));
    for (size_t k = 0; k < c->line_count; k++) {
        snprintf(text, sizeof text, "%s [%s]", c->line[k].name, c->unit);
        TRY(picture_text_width(&width, text, TEXT_SIZE));
        if (x + 24 + width > PAGE_WIDTH) break;
        picture_fill(pic, x, 42, 16, 4, c->line[k].rgb);
        TRY(picture_text(pic, x + 22, 49, text, TEXT_SIZE));
        x += 22 + width + 24;
    }
out:
    return rc;
}

status curve_write(const char *path, const curve *c)
{
    status rc = STATUS_OK;
    const axes a = axes_of(c);
    output_file *file = NULL;
    picture *pic = NULL;

    TRY(picture_create(&pic, PAGE_WIDTH, PAGE_HEIGHT));
    TRY(draw_axes(pic, &a));
    for (size_t k = 0; k < c->line_count; k++) draw_line(pic, &a, c, &c->line[k]);
    TRY(draw_names(pic, c));
    TRY(output_file_reserve(&file, path));
    TRY(picture_write(pic, file));
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    picture_free(pic);
    return rc;
}
