/* radsig-view: the preview, as a program of its own; `radsig view` starts it. */
#include "base/clock.h"
#include "base/interrupt.h"
#include "base/number.h"
#include "base/parallel_job.h"
#include "bench.h"
#include "control.h"
#include "files/file_name.h"
#include "image/picture.h"
#include "offscreen.h"
#include "options/option_table.h"
#include "options/program.h"
#include "options/standard_output.h"
#include "saving.h"
#include "script.h"
#include "window.h"

static const char command[] = "radsig view";

static const char purpose[] =
    "Shows the radiance of a scene in a window: coarse while something moves, then exactly as\n"
    "radsig render writes it. h lists the keys; docs/preview.md tells more.\n";

enum { SIZE_LIMIT = 16384 };

typedef struct arguments {
    const char *offscreen, *plane, *script;
    uint32_t columns, rows; /* 0: the scene's */
    bool is_bench;
} arguments;

static status read_size(const option *o, const char *text)
{
    status rc = STATUS_OK;
    arguments *a = o->out;

    NEED(number_read_size(text, &a->columns, &a->rows) && a->columns > 0 && a->rows > 0 &&
             a->columns <= SIZE_LIMIT && a->rows <= SIZE_LIMIT,
         STATUS_ARGUMENT, "found '%s', expected COLUMNSxROWS, each from 1 to %d", text, SIZE_LIMIT);
out:
    return rc;
}

static status read_offscreen(const option *o, const char *text)
{
    status rc = STATUS_OK;

    NEED(file_name_ends(text, ".png") || file_name_ends(text, ".img"), STATUS_ARGUMENT,
         "found '%s', expected FILE.png or FILE.img", text);
    *(const char **)o->out = text;
out:
    return rc;
}

static int read_arguments(arguments *a, int argc, char **argv)
{
    option list[] = {
        {"offscreen", 0, "FILE", "no window: write the page (FILE.png) or the radiance (FILE.img)",
         .out = &a->offscreen, .read = read_offscreen},
        {"size", 0, "WxH", "pixels of the picture: columns x rows", .out = a, .read = read_size},
        {"plane", 0, "NAME", "the plane to show first, as temperature_c", .text = &a->plane},
        {"script", 0, "FILE", "do what the file says, then quit; - is the standard input",
         .text = &a->script},
        {"bench", 0, NULL, "measure how fast it is, then quit", .flag = &a->is_bench}};
    const option_table table = {command, "SCENE", 1, 1, purpose, list, sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);

    if (code == OPTION_TABLE_DONE && a->script && a->is_bench)
        return program_misuse(command, "--script and --bench exclude each other");
    return code;
}

/* Does what the person in front of the window asks for until the window is closed. */
static status attend(preview *p)
{
    status rc = STATUS_OK;
    event e;
    bool drew;

    while (!p->quits) {
        const double wait_s = p->state.is_at_rest ? 0.03 : 0.004;
        TRY(interrupt_check());
        for (bool more = p->s->take(p->s, &e, wait_s); more; more = p->s->take(p->s, &e, 0.0))
            control_take(p, &e);
        TRY(preview_step(p, &drew));
    }
out:
    return rc;
}

static status write_result(preview *p, const char *path)
{
    status rc = STATUS_OK;

    TRY(preview_rest(p));
    NEED(!p->state.error[0], STATUS_FORMAT, "%s", p->state.error);
    if (file_name_ends(path, ".img"))
        TRY(saving_write_image(p, path));
    else
        TRY(saving_write_page(p, path));
out:
    return rc;
}

typedef struct opening {
    const char *scene_path;
    shared_scene *of;
} opening;

static status read_scene(void *self)
{
    opening *o = self;

    return shared_scene_read(&o->of, o->scene_path, NULL, 0);
}

static status prepare_pictures(void *self)
{
    (void)self;
    return picture_prepare();
}

static status run(const arguments *a, const char *scene_path, double start_s)
{
    status rc = STATUS_OK;
    opening o = {.scene_path = scene_path};
    const parallel_job list[] = {{read_scene, &o}, {prepare_pictures, NULL}};
    surface *s = NULL;
    preview *p = NULL;
    int width, height;

    interrupt_catch_signals();
    TRY(parallel_run(list, sizeof list / sizeof *list));
    program_warn(command);
    const int columns = a->columns ? (int)a->columns : o.of->s->camera.columns;
    const int rows = a->columns ? (int)a->rows : o.of->s->camera.rows;
    preview_page_size(columns, rows, 1.0, &width, &height);
    if (a->offscreen)
        TRY(offscreen_open(&s, width, height));
    else
        TRY(window_open(&s, width, height));
    TRY(preview_open(&p, s, o.of, columns, rows, a->plane, stdout));
    if (a->script)
        TRY(script_run(p, a->script));
    else if (a->is_bench)
        TRY(bench_run(p, start_s, stdout));
    else if (!a->offscreen)
        TRY(attend(p));
    if (a->offscreen) TRY(write_result(p, a->offscreen));
out:
    preview_free(p);
    if (s) s->free(s);
    shared_scene_drop(o.of);
    return rc;
}

int main(int argc, char **argv)
{
    arguments a = {0};
    const double start_s = clock_now_s();

    standard_output_open();
    int code = read_arguments(&a, argc, argv);
    if (code == OPTION_TABLE_DONE) code = program_end(command, run(&a, argv[1], start_s));
    return program_close(command, code);
}
