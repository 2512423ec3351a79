#include "script.h"

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/number.h"
#include "control.h"
#include "files/record_file.h"
#include "meshio/input_file.h"
#include "page.h"
#include "saving.h"

#include <string.h>

enum { LINE_SIZE = 1024, DRAG_STEPS = 10, WORDS = 4, PIXEL_LIMIT = 16384 };

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

    while (clock_now_s() < end_s && !p->quits) {
        TRY(interrupt_check());
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

/* The words of a line; of more than there is room for, one more is counted. */
typedef struct words {
    char text[LINE_SIZE];
    char *word[WORDS];
    int count;
} words;

static void split(words *out, const char *line)
{
    char *at = strcpy(out->text, line);

    out->count = 0;
    for (at += strspn(at, " \t"); *at && out->count < WORDS; at += strspn(at, " \t")) {
        out->word[out->count++] = at;
        at += strcspn(at, " \t");
        if (*at) *at++ = '\0';
    }
    if (*at) out->count++;
}

/* Whether the line is `name` with so many words behind it. */
static bool is_line(const words *w, const char *name, int count)
{
    return w->count == 1 + count && !strcmp(w->word[0], name);
}

static bool read_pixel(const words *w, int low, int out[2])
{
    int64_t value[2];

    for (int i = 0; i < 2; i++) {
        if (!number_read_whole(w->word[i + 1], low, PIXEL_LIMIT, &value[i])) return false;
        out[i] = (int)value[i];
    }
    return true;
}

/* Lines about the pointer and the keyboard; `*is_done` tells whether this was one. */
static status do_input(preview *p, const words *w, bool *is_done)
{
    status rc = STATUS_OK;
    int at[2];
    double dx, dy;
    event e;
    event_button button;

    *is_done = true;
    if (is_line(w, "key", 1) && read_key(w->word[1], &e)) {
        control_take(p, &e);
    } else if (is_line(w, "point", 2) && read_pixel(w, -PIXEL_LIMIT, at)) {
        point(p, at[0], at[1]);
    } else if (is_line(w, "press", 1) && read_button(w->word[1], &button)) {
        press(p, EVENT_PRESS, button);
    } else if (is_line(w, "release", 1) && read_button(w->word[1], &button)) {
        press(p, EVENT_RELEASE, button);
    } else if (is_line(w, "click", 2) && read_pixel(w, -PIXEL_LIMIT, at)) {
        point(p, at[0], at[1]);
        press(p, EVENT_PRESS, EVENT_BUTTON_LEFT);
        press(p, EVENT_RELEASE, EVENT_BUTTON_LEFT);
    } else if (is_line(w, "drag", 3) && read_button(w->word[1], &button) &&
               number_read(w->word[2], &dx) && number_read(w->word[3], &dy)) {
        TRY(drag(p, button, dx, dy));
    } else if (is_line(w, "scroll", 1) && number_read(w->word[1], &dy)) {
        e = (event){.kind = EVENT_SCROLL, .amount = dy};
        control_take(p, &e);
    } else {
        *is_done = false;
    }
out:
    return rc;
}

/* The rest of a line behind a word and a blank; NULL if it begins otherwise. */
static const char *rest_of(const char *line, const char *word)
{
    const size_t length = strlen(word);

    if (strncmp(line, word, length) != 0 || line[length] != ' ') return NULL;
    line += length + strspn(line + length, " ");
    return *line ? line : NULL;
}

static status do_line(preview *p, const char *line, bool *is_done)
{
    status rc = STATUS_OK;
    words w;
    const char *page_path = rest_of(line, "page"), *image_path = rest_of(line, "image");
    int size[2];
    double wait_s;

    split(&w, line);
    TRY(do_input(p, &w, is_done));
    if (*is_done) goto out;
    *is_done = true;
    if (is_line(&w, "wait", 0)) {
        TRY(preview_rest(p));
    } else if (is_line(&w, "error", 0)) {
        fprintf(p->picks, "%s\n", p->state.error);
        fflush(p->picks);
    } else if (is_line(&w, "pause", 1) && number_read(w.word[1], &wait_s)) {
        TRY(pause_for(p, wait_s));
    } else if (is_line(&w, "size", 2) && read_pixel(&w, 1, size)) {
        TRY(set_size(p, size[0], size[1]));
    } else if (page_path) {
        TRY(draw(p));
        TRY(saving_write_page(p, page_path));
    } else if (image_path) {
        TRY(saving_write_image(p, image_path));
    } else {
        *is_done = false;
    }
out:
    return rc;
}

status script_run(preview *p, const char *path)
{
    status rc = STATUS_OK;
    char whole[LINE_SIZE], message[1024];
    FILE *file = stdin;
    bool is_done = true;

    if (strcmp(path, "-"))
        NEED(!input_file_open(&file, NULL, path, INPUT_FILE_TEXT_LIMIT, message, sizeof message),
             STATUS_FILE, "%s", message);
    for (int number = 1; !p->quits && fgets(whole, sizeof whole, file); number++) {
        char *line = whole + (number == 1 ? record_text_begin(whole) - whole : 0);
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
