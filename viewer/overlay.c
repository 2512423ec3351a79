#include "overlay.h"

#include "control.h"

#include <math.h>

static const canvas_colour ink = {25, 25, 25, 255}, paper = {255, 255, 255, 240},
                           alarm = {178, 24, 43, 255}, chosen = {200, 220, 250, 255};

/* Text in two columns; enough columns of pairs that all fit below each other. */
static void draw_keys(const preview *p)
{
    const double height = canvas_line_height(p->c, CANVAS_TEXT), pad = 8.0 * p->scale;
    const double top = p->picture.y, room = p->height - top - 3.0 * pad;
    const int rows = (int)fmax(1.0, floor(room / height));
    double x = 2.0 * pad;
    size_t count = 0;
    const control_key *keys = control_keys(&count);

    canvas_fill(p->c, 0.0, top - pad, p->width, p->height - top, paper);
    for (size_t first = 0; first < count; first += (size_t)rows) {
        int name_width = 0, width = 0;
        for (size_t i = first; i < count && i < first + (size_t)rows; i++) {
            const int wide = canvas_text_width(p->c, CANVAS_TEXT, keys[i].name);
            const int wider = canvas_text_width(p->c, CANVAS_TEXT, keys[i].purpose);
            name_width = wide > name_width ? wide : name_width;
            width = wider > width ? wider : width;
        }
        for (size_t i = first; i < count && i < first + (size_t)rows; i++) {
            const double y = top + (double)(i - first) * height;
            canvas_text(p->c, x, y, CANVAS_TEXT, alarm, keys[i].name);
            canvas_text(p->c, x + name_width + pad, y, CANVAS_TEXT, ink, keys[i].purpose);
        }
        x += name_width + width + 3.0 * pad;
    }
}

/* Of a long list the part about its mark. */
static void list_window(const preview *p, size_t *out_first, size_t *out_rows)
{
    const double height = canvas_line_height(p->c, CANVAS_TEXT);
    const size_t rows = (size_t)fmax(1.0, floor((p->height - p->picture.y - 30.0) / height));

    *out_rows = rows;
    *out_first = p->list_at < rows / 2 ? 0 : p->list_at - rows / 2;
    if (p->live->plane_count <= rows)
        *out_first = 0;
    else if (*out_first > p->live->plane_count - rows)
        *out_first = p->live->plane_count - rows;
}

static void draw_list(const preview *p)
{
    const double height = canvas_line_height(p->c, CANVAS_TEXT);
    size_t first, rows;
    double y = p->picture.y;
    char text[256];

    list_window(p, &first, &rows);
    canvas_fill(p->c, p->picture.x, y - 4.0, 340.0 * p->scale, p->height - y, paper);
    for (size_t i = first; i < p->live->plane_count && i < first + rows; i++, y += height) {
        const render_plane *plane = &p->live->planes[i];
        if (i == p->list_at) canvas_fill(p->c, p->picture.x, y, 340.0 * p->scale, height, chosen);
        snprintf(text, sizeof text, "%s [%s]", plane->name,
                 plane->plane.unit ? plane->plane.unit : "");
        canvas_text(p->c, p->picture.x + 6.0, y, CANVAS_TEXT, ink, text);
    }
}

bool overlay_find(const preview *p, double y, size_t *out_plane)
{
    size_t first, rows;
    const double place = floor((y - p->picture.y) / canvas_line_height(p->c, CANVAS_TEXT));

    list_window(p, &first, &rows);
    if (place < 0.0 || place >= (double)rows || first + (size_t)place >= p->live->plane_count)
        return false;
    *out_plane = first + (size_t)place;
    return true;
}

void overlay_draw(const preview *p)
{
    if (p->overlay == PREVIEW_HELP) draw_keys(p);
    if (p->overlay == PREVIEW_LIST && p->live) draw_list(p);
}

/* Writes the next line that fits a width; returns what is left. */
static const char *next_line(const preview *p, const char *text, double width, char *out,
                             size_t size)
{
    size_t length = 0, blank = 0;

    while (text[length] && text[length] != '\n' && length + 1 < size) {
        out[length] = text[length];
        out[length + 1] = '\0';
        if (canvas_text_width(p->c, CANVAS_TEXT, out) > width) break;
        if (text[length] == ' ' || text[length] == '/') blank = length;
        length++;
    }
    const bool whole = text[length] == '\0' || text[length] == '\n';
    if (!whole && blank > 0) length = blank + 1;
    out[length] = '\0';
    return text + length + (text[length] == '\n');
}

void overlay_message(const preview *p, const char *text)
{
    enum { LINES = 12 };
    char line[LINES][256];
    const double height = canvas_line_height(p->c, CANVAS_TEXT), pad = 8.0 * p->scale;
    int count = 0;

    while (*text && count < LINES)
        text = next_line(p, text, p->width - 4.0 * pad, line[count++], sizeof line[0]);
    const double top = p->height - count * height - pad;
    canvas_fill(p->c, 0.0, top - pad, p->width, p->height - top + pad, paper);
    canvas_fill(p->c, 0.0, top - pad, p->width, 2.0, alarm);
    for (int i = 0; i < count; i++)
        canvas_text(p->c, 2.0 * pad, top - 0.5 * pad + i * height, CANVAS_TEXT, alarm, line[i]);
}
