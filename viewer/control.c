#include "control.h"

#include "image/image.h"
#include "motion.h"
#include "overlay.h"
#include "page.h"
#include "saving.h"

#include <math.h>

/* Steps of the keys. */
static const double orbit_deg = 3.0, turn_deg = 1.0, pan_fraction = 0.02, fly_fraction = 0.03,
                    approach_factor = 1.05, minute_s = 60.0, range_fraction = 0.1;

/* What a pixel of a drag and a notch of the wheel do. */
static const double drag_deg = 0.3, wheel_factor = 1.1;

static const control_key help_lines[] = {
    {"h", "show or hide this help"},
    {"arrows", "orbit about the target"},
    {"shift + arrows", "pan"},
    {"control + arrows", "turn the head"},
    {"alt + arrows", "move the picked pixel"},
    {"w s a d r f", "fly: forward, back, left, right, up, down"},
    {"+ -", "nearer, farther"},
    {"page up, down", "longer, shorter lens"},
    {"t", "look at the picked point"},
    {"home", "the scene's camera, time, mode"},
    {", .", "ten minutes earlier, later"},
    {"< >", "an hour earlier, later"},
    {"n N", "next, previous plane"},
    {"1 ... 9", "radiance of a band"},
    {"l", "list of planes: up, down, enter"},
    {"g", "colours: own, grey, inferno, blue to red"},
    {"x", "fix the colours' range, or let it follow"},
    {"u j", "more, less gain"},
    {"i k", "raise, lower the bias"},
    {"y", "histogram"},
    {"e", "borders of the facets"},
    {"m", "thesis or exact"},
    {"p", "pin the picture to compare with"},
    {"c", "alone, beside the pinned one, difference"},
    {"v", "values of the picked pixel"},
    {"space", "print those values"},
    {"o", "save the view: .adv, [camera]"},
    {"z", "save this page (PNG)"},
    {"Z", "render in full size"},
    {"q", "quit"},
    {"left button", "drag: orbit; click: pick a pixel"},
    {"right button", "drag: pan"},
    {"middle button", "drag: turn the head"},
    {"wheel", "nearer, farther"},
};

const control_key *control_keys(size_t *out_count)
{
    *out_count = sizeof help_lines / sizeof *help_lines;
    return help_lines;
}

static void ask_for_camera(preview *p)
{
    p->wish.has_camera = true;
    preview_ask(p);
}

static void change_time(preview *p, double minutes)
{
    p->wish.time_s = preview_time_s(p) + minutes * minute_s;
    p->wish.has_time = true;
    preview_ask(p);
}

static void change_mode(preview *p)
{
    p->wish.thesis = !preview_thesis(p);
    p->wish.has_mode = true;
    preview_ask(p);
}

static void go_home(preview *p)
{
    p->wish.has_camera = p->wish.has_time = p->wish.has_mode = false;
    preview_ask(p);
}

static void look_at(preview *p)
{
    if (!p->live) return;
    const size_t range = frame_find(p->live, "range_m");
    const size_t pixel = preview_pixel(p, p->live, p->pick_column, p->pick_row);
    const float range_m =
        range < p->live->plane_count ? p->live->values[range][pixel] : IMAGE_NO_DATA;

    if (range_m == IMAGE_NO_DATA) {
        preview_note(p, "the picked pixel shows the sky");
        return;
    }
    p->camera.columns = p->wish.columns;
    p->camera.rows = p->wish.rows;
    motion_look_at(&p->camera, p->pick_column + 0.5, p->pick_row + 0.5, (double)range_m);
    p->pick_column = p->wish.columns / 2;
    p->pick_row = p->wish.rows / 2;
    ask_for_camera(p);
}

static void next_plane(preview *p, bool forward)
{
    if (!p->live) return;
    const size_t count = p->live->plane_count;
    size_t plane = p->plane;

    do plane = (plane + (forward ? 1 : count - 1)) % count;
    while (!p->live->values[plane]);
    preview_show_plane(p, plane);
}

static void show_band(preview *p, size_t index)
{
    if (p->live && index < p->live->of->s->band_count) preview_show_plane(p, index);
}

static void next_map(preview *p)
{
    static const char *const names[PAINTING_MAPS] = {"the plane's own", "grey", "inferno",
                                                     "blue to red"};

    p->map = (painting_map)((p->map + 1) % PAINTING_MAPS);
    preview_note(p, "colours: %s", names[p->map]);
    p->is_stale = true;
}

static void change_range(preview *p, double gain, double bias)
{
    const double middle = 0.5 * (p->range.min + p->range.max), half = p->range.max - middle;

    p->has_fixed_range = true;
    p->range.min = middle - half * gain - half * bias;
    p->range.max = middle + half * gain - half * bias;
    preview_note(p, "colours from %.5g to %.5g", p->range.min, p->range.max);
    p->is_stale = true;
}

static void next_compare(preview *p)
{
    static const char *const names[PREVIEW_COMPARES] = {
        "the picture alone", "beside the pinned one", "minus the pinned one"};

    if (!p->pinned) preview_pin(p);
    p->compare = (preview_compare)((p->compare + 1) % PREVIEW_COMPARES);
    p->has_fixed_range = false;
    preview_note(p, "%s", names[p->compare]);
    p->is_stale = true;
}

static void toggle_overlay(preview *p, preview_overlay overlay)
{
    p->overlay = p->overlay == overlay ? PREVIEW_NOTHING : overlay;
    p->list_at = p->plane;
    p->is_stale = true;
}

static void toggle(preview *p, bool *what)
{
    *what = !*what;
    p->is_stale = true;
}

/* Only exact values leave the preview. */
static void print_values(preview *p)
{
    p->prints_values = true;
    p->is_stale = true;
}

static void fly(preview *p, double forward, double right, double up)
{
    motion_fly(&p->camera, fly_fraction * forward, fly_fraction * right, fly_fraction * up);
    ask_for_camera(p);
}

/* Keys that move the camera; false: this is none. */
static bool take_motion(preview *p, unsigned key)
{
    switch (key) {
    case 'w':
        fly(p, 1.0, 0.0, 0.0);
        return true;
    case 's':
        fly(p, -1.0, 0.0, 0.0);
        return true;
    case 'a':
        fly(p, 0.0, -1.0, 0.0);
        return true;
    case 'd':
        fly(p, 0.0, 1.0, 0.0);
        return true;
    case 'r':
        fly(p, 0.0, 0.0, 1.0);
        return true;
    case 'f':
        fly(p, 0.0, 0.0, -1.0);
        return true;
    case '+':
    case '-':
        motion_approach(&p->camera, key == '+' ? approach_factor : 1.0 / approach_factor);
        ask_for_camera(p);
        return true;
    case EVENT_PAGE_UP:
    case EVENT_PAGE_DOWN:
        motion_lens(&p->camera, key == EVENT_PAGE_UP ? approach_factor : 1.0 / approach_factor);
        ask_for_camera(p);
        return true;
    default:
        return false;
    }
}

/* Keys that change what the picture is of; false: this is none. */
static bool take_subject(preview *p, unsigned key)
{
    switch (key) {
    case 't':
        look_at(p);
        return true;
    case EVENT_HOME:
        go_home(p);
        return true;
    case ',':
    case '.':
        change_time(p, key == '.' ? 10.0 : -10.0);
        return true;
    case '<':
    case '>':
        change_time(p, key == '>' ? 60.0 : -60.0);
        return true;
    case 'm':
        change_mode(p);
        return true;
    case 'n':
    case 'N':
        next_plane(p, key == 'n');
        return true;
    default:
        if (key < '1' || key > '9') return false;
        show_band(p, key - '1');
        return true;
    }
}

/* Keys that change how it is drawn; false: this is none. */
static bool take_drawing(preview *p, unsigned key)
{
    switch (key) {
    case 'g':
        next_map(p);
        return true;
    case 'x':
        toggle(p, &p->has_fixed_range);
        preview_note(p, p->has_fixed_range ? "fixed range" : "the range follows the picture");
        return true;
    case 'u':
    case 'j':
        change_range(p, key == 'u' ? 1.0 - range_fraction : 1.0 + range_fraction, 0.0);
        return true;
    case 'i':
    case 'k':
        change_range(p, 1.0, key == 'i' ? range_fraction : -range_fraction);
        return true;
    case 'y':
        toggle(p, &p->shows_histogram);
        return true;
    case 'e':
        toggle(p, &p->shows_outlines);
        return true;
    case 'p':
        preview_pin(p);
        preview_note(p, "the picture is pinned");
        return true;
    case 'c':
        next_compare(p);
        return true;
    case 'v':
        toggle(p, &p->shows_values);
        return true;
    default:
        return false;
    }
}

static void take_character(preview *p, unsigned key)
{
    if (take_motion(p, key) || take_subject(p, key) || take_drawing(p, key)) return;
    switch (key) {
    case 'h':
        toggle_overlay(p, PREVIEW_HELP);
        break;
    case 'l':
        if (p->live) toggle_overlay(p, PREVIEW_LIST);
        break;
    case ' ':
        print_values(p);
        break;
    case 'o':
        saving_view(p);
        break;
    case 'z':
        saving_page(p);
        break;
    case 'Z':
        saving_full_render(p);
        break;
    case 'q':
        p->quits = true;
        break;
    case EVENT_ESCAPE:
        p->overlay = PREVIEW_NOTHING;
        p->is_stale = true;
        break;
    }
}

static void move_pick(preview *p, int right, int up)
{
    p->pick_column = (int)fmax(0.0, fmin(p->wish.columns - 1.0, p->pick_column + right));
    p->pick_row = (int)fmax(0.0, fmin(p->wish.rows - 1.0, p->pick_row - up));
    p->is_stale = true;
}

static void take_arrow(preview *p, const event *e)
{
    const int right = (e->key == EVENT_RIGHT) - (e->key == EVENT_LEFT);
    const int up = (e->key == EVENT_UP) - (e->key == EVENT_DOWN);

    if (e->alt) {
        move_pick(p, right, up);
        return;
    }
    if (e->shift)
        motion_pan(&p->camera, pan_fraction * right, pan_fraction * up);
    else if (e->control)
        motion_turn(&p->camera, turn_deg * right, turn_deg * up);
    else
        motion_orbit(&p->camera, orbit_deg * right, orbit_deg * up);
    ask_for_camera(p);
}

/* The list takes the keys that it needs; false: it does not need this one. */
static bool take_list(preview *p, unsigned key)
{
    const size_t count = p->live->plane_count;

    if (key == EVENT_UP)
        p->list_at = (p->list_at + count - 1) % count;
    else if (key == EVENT_DOWN)
        p->list_at = (p->list_at + 1) % count;
    else if (key == EVENT_ENTER) {
        if (p->live->values[p->list_at]) preview_show_plane(p, p->list_at);
        p->overlay = PREVIEW_NOTHING;
    } else
        return false;
    p->is_stale = true;
    return true;
}

static void take_key(preview *p, const event *e)
{
    if (p->overlay == PREVIEW_LIST && p->live && take_list(p, e->key)) return;
    if (e->key == EVENT_LEFT || e->key == EVENT_RIGHT || e->key == EVENT_UP || e->key == EVENT_DOWN)
        take_arrow(p, e);
    else
        take_character(p, e->key);
}

static void take_move(preview *p, const event *e)
{
    const double dx = e->x - p->pointer_x, dy = e->y - p->pointer_y;

    p->pointer_x = e->x;
    p->pointer_y = e->y;
    if (!p->is_held) {
        int column, row;
        if (!p->shows_values || !page_find_pixel(p, e->x, e->y, &column, &row)) return;
        p->pick_column = column;
        p->pick_row = row;
        p->is_stale = true;
        return;
    }
    p->has_dragged |= dx != 0.0 || dy != 0.0;
    if (p->held == EVENT_BUTTON_LEFT)
        motion_orbit(&p->camera, -drag_deg * dx, drag_deg * dy);
    else if (p->held == EVENT_BUTTON_RIGHT)
        motion_pan(&p->camera, -dx / p->picture.width, dy / p->picture.width);
    else
        motion_turn(&p->camera, -drag_deg * dx, drag_deg * dy);
    ask_for_camera(p);
}

/* A click picks: a plane of the open list, else a pixel. */
static void click(preview *p, double x, double y)
{
    size_t plane;
    int column, row;

    if (p->overlay == PREVIEW_LIST && p->live && overlay_find(p, y, &plane)) {
        if (p->live->values[plane]) preview_show_plane(p, plane);
        p->overlay = PREVIEW_NOTHING;
    } else if (page_find_pixel(p, x, y, &column, &row)) {
        p->pick_column = column;
        p->pick_row = row;
        p->shows_values = true;
        print_values(p);
    }
    p->is_stale = true;
}

void control_take(preview *p, const event *e)
{
    switch (e->kind) {
    case EVENT_KEY:
        take_key(p, e);
        break;
    case EVENT_PRESS:
        p->is_held = true;
        p->has_dragged = false;
        p->held = e->button;
        p->pointer_x = e->x;
        p->pointer_y = e->y;
        break;
    case EVENT_RELEASE:
        if (p->is_held && !p->has_dragged && e->button == EVENT_BUTTON_LEFT) click(p, e->x, e->y);
        p->is_held = false;
        break;
    case EVENT_MOVE:
        take_move(p, e);
        break;
    case EVENT_SCROLL:
        motion_approach(&p->camera, pow(wheel_factor, e->amount));
        ask_for_camera(p);
        break;
    case EVENT_RESIZE:
        preview_resize(p, (int)e->x, (int)e->y);
        break;
    case EVENT_CLOSE:
        p->quits = true;
        break;
    }
}
