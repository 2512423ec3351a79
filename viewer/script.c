#include "script.h"

#include "clock.h"
#include "control.h"
#include "input_file.h"
#include "page.h"
#include "saving.h"

#include <string.h>

enum { LINE_SIZE = 1024, DRAG_STEPS = 10 };

static status draw(preview *p)
{
    bool drew;

    return preview_step(p, &drew);
}

static status pause_for(preview *p, double wait_s)
{
    status rc = STATUS_OK;
    const double end_s = clock_now_s() + wait_s;
    event e;

    while (clock_now_s() < end_s) {
        TRY(draw(p));
        if (p->s->take(p->s, &e, 0.02)) control_take(p, &e);
    }
out:
    return rc;
}

/* True if the text begins with a word and a +; then it is passed. */
static bool has_modifier(const char **text, const char *word)
{
    const size_t length = strlen(word);

    if (strncmp(*text, word, length) != 0 || (*text)[length] != '+') return false;
    *text += length + 1;
    return true;
}

static bool read_key(const char *text, event *out)
{
    static const struct {
        const char *name;
        unsigned key;
    } names[] = {{"left", EVENT_LEFT},    {"right", EVENT_RIGHT},         {"up", EVENT_UP},
                 {"down", EVENT_DOWN},    {"page-up", EVENT_PAGE_UP},     {"home", EVENT_HOME},
                 {"enter", EVENT_ENTER},  {"page-down", EVENT_PAGE_DOWN}, {"space", ' '},
                 {"escape", EVENT_ESCAPE}};

    *out = (event){.kind = EVENT_KEY};
    out->shift = has_modifier(&text, "shift");
    out->control = has_modifier(&text, "control");
    out->alt = has_modifier(&text, "alt");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(text, names[i].name)) out->key = names[i].key;
    if (strlen(text) == 1) out->key = (unsigned char)*text;
    return out->key != 0;
}

static bool read_button(const char *text, event_button *out)
{
    static const char *const names[] = {"left", "right", "middle"};

    for (int i = 0; i < 3; i++)
        if (!strcmp(text, names[i])) {
            *out = (event_button)i;
            return true;
        }
    return false;
}

static void point(preview *p, int column, int row)
{
    event e = {.kind = EVENT_MOVE};

    page_find_point(p, column, row, &e.x, &e.y);
    control_take(p, &e);
}

static void press(preview *p, event_kind kind, event_button button)
{
    const event e = {.kind = kind, .button = button, .x = p->pointer_x, .y = p->pointer_y};

    control_take(p, &e);
}

static status drag(preview *p, event_button button, double dx, double dy)
{
    status rc = STATUS_OK;

    press(p, EVENT_PRESS, button);
    for (int i = 0; i < DRAG_STEPS; i++) {
        const event e = {.kind = EVENT_MOVE,
                         .x = p->pointer_x + dx / DRAG_STEPS,
                         .y = p->pointer_y + dy / DRAG_STEPS};
        control_take(p, &e);
        TRY(draw(p));
    }
    press(p, EVENT_RELEASE, button);
out:
    return rc;
}

static status set_size(preview *p, int width, int height)
{
    status rc = STATUS_OK;
    double scale;

    TRY(p->s->resize(p->s, width, height));
    p->s->measure(p->s, &width, &height, &scale);
    preview_resize(p, width, height);
out:
    return rc;
}

/* Lines about the pointer and the keyboard; `*is_done` tells whether this was one. */
static status do_input(preview *p, const char *line, bool *is_done)
{
    status rc = STATUS_OK;
    char word[64];
    int column, row;
    double dx, dy;
    event e;
    event_button button;

    *is_done = true;
    if (sscanf(line, "key %63s", word) == 1 && read_key(word, &e)) {
        control_take(p, &e);
    } else if (sscanf(line, "point %d %d", &column, &row) == 2) {
        point(p, column, row);
    } else if (sscanf(line, "press %63s", word) == 1 && read_button(word, &button)) {
        press(p, EVENT_PRESS, button);
    } else if (sscanf(line, "release %63s", word) == 1 && read_button(word, &button)) {
        press(p, EVENT_RELEASE, button);
    } else if (sscanf(line, "click %d %d", &column, &row) == 2) {
        point(p, column, row);
        press(p, EVENT_PRESS, EVENT_BUTTON_LEFT);
        press(p, EVENT_RELEASE, EVENT_BUTTON_LEFT);
    } else if (sscanf(line, "drag %63s %lf %lf", word, &dx, &dy) == 3 &&
               read_button(word, &button)) {
        TRY(drag(p, button, dx, dy));
    } else if (sscanf(line, "scroll %lf", &dy) == 1) {
        e = (event){.kind = EVENT_SCROLL, .amount = dy};
        control_take(p, &e);
    } else {
        *is_done = false;
    }
out:
    return rc;
}

static status do_line(preview *p, const char *line, bool *is_done)
{
    status rc = STATUS_OK;
    char path[LINE_SIZE];
    int width, height;
    double wait_s;

    TRY(do_input(p, line, is_done));
    if (*is_done) goto out;
    *is_done = true;
    if (!strcmp(line, "wait")) {
        TRY(preview_rest(p));
    } else if (!strcmp(line, "error")) {
        fprintf(p->picks, "%s\n", p->state.error);
        fflush(p->picks);
    } else if (sscanf(line, "pause %lf", &wait_s) == 1) {
        TRY(pause_for(p, wait_s));
    } else if (sscanf(line, "size %d %d", &width, &height) == 2 && width > 0 && height > 0) {
        TRY(set_size(p, width, height));
    } else if (sscanf(line, "page %1023[^\n]", path) == 1) {
        TRY(draw(p));
        TRY(saving_write_page(p, path));
    } else if (sscanf(line, "image %1023[^\n]", path) == 1) {
        TRY(saving_write_image(p, path));
    } else {
        *is_done = false;
    }
out:
    return rc;
}

status script_run(preview *p, const char *path)
{
    status rc = STATUS_OK;
    char line[LINE_SIZE], message[1024];
    FILE *file = stdin;
    bool is_done = true;

    if (strcmp(path, "-"))
        NEED(!input_file_open(&file, NULL, path, INPUT_FILE_TEXT_LIMIT, message, sizeof message),
             STATUS_FILE, "%s", message);
    for (int number = 1; !p->quits && fgets(line, sizeof line, file); number++) {
        line[strcspn(line, "\r\n")] = '\0';
        if (*line && *line != '#') TRY(do_line(p, line, &is_done));
        NEED(is_done, STATUS_FORMAT,
             "%s:%d: found \"%s\", expected a line as docs/preview.md has them", path, number,
             line);
        TRY(draw(p));
    }
out:
    if (file != stdin) fclose(file);
    return rc;
}
