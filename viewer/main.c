/* radsig-view: the preview, as a program of its own; `radsig view` starts it. */
#include "bench.h"
#include "clock.h"
#include "control.h"
#include "errand.h"
#include "offscreen.h"
#include "picture.h"
#include "saving.h"
#include "script.h"
#include "standard_output.h"
#include "window.h"

#include <getopt.h>
#include <string.h>

enum { EXIT_USAGE = 2 };

static const char help[] =
    "usage: radsig view SCENE [OPTION ...]\n"
    "\n"
    "Shows the radiance of a scene in a window: coarse while something moves, then exactly as\n"
    "radsig render writes it. h lists the keys; docs/preview.md tells more.\n"
    "\n"
    "  --offscreen FILE       no window: write the page (FILE.png) or the radiance (FILE.img)\n"
    "  --size WxH             pixels of the picture: columns x rows\n"
    "  --plane NAME           the plane to show first, as temperature_c\n"
    "  --script FILE          do what the file says, then quit; - is the standard input\n"
    "  --bench                measure how fast it is, then quit\n";

typedef struct arguments {
    const char *scene_path, *offscreen, *plane, *script;
    int columns, rows; /* 0: the scene's */
    bool is_bench;
} arguments;

static int misuse(const char *what, const char *detail)
{
    fprintf(stderr, "radsig view: %s%s%s (radsig view --help)\n", what, *detail ? " " : "", detail);
    return EXIT_USAGE;
}

static void print_lines(const char *label, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (length) fprintf(stderr, "radsig view: %s%.*s\n", label, (int)length, text);
        text += length + (text[length] == '\n');
    }
}

static bool ends_in(const char *text, const char *end)
{
    const size_t length = strlen(text), end_length = strlen(end);

    return length > end_length && !strcmp(text + length - end_length, end);
}

static bool take_size(arguments *a, const char *text)
{
    char end;

    return sscanf(text, "%dx%d%c", &a->columns, &a->rows, &end) == 2 && a->columns > 0 &&
           a->rows > 0 && a->columns <= 16384 && a->rows <= 16384;
}

/* Takes one option; false where its value is none. */
static bool take_option(arguments *a, int option, const char *value)
{
    switch (option) {
    case 'o':
        a->offscreen = value;
        return ends_in(value, ".png") || ends_in(value, ".img");
    case 's':
        return take_size(a, value);
    case 'p':
        a->plane = value;
        return *value != '\0';
    case 'c':
        a->script = value;
        return *value != '\0';
    default:
        a->is_bench = true;
        return true;
    }
}

/* Returns -1 to go on, or the exit code. */
static int take_arguments(arguments *a, int argc, char **argv)
{
    static const struct option options[] = {{"offscreen", required_argument, NULL, 'o'},
                                            {"size", required_argument, NULL, 's'},
                                            {"plane", required_argument, NULL, 'p'},
                                            {"script", required_argument, NULL, 'c'},
                                            {"bench", no_argument, NULL, 'b'},
                                            {"help", no_argument, NULL, 'h'},
                                            {NULL, 0, NULL, 0}};
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, ":", options, NULL)) != -1) {
        if (option == 'h') {
            fputs(help, stdout);
            return 0;
        }
        if (option == '?') return misuse("unknown option", argv[optind - 1]);
        if (option == ':') return misuse("a value is missing behind", argv[optind - 1]);
        if (!take_option(a, option, optarg)) return misuse("no value for its option:", optarg);
    }
    if (optind + 1 != argc)
        return misuse(argc > optind ? "one scene at a time" : "needs a scene", "");
    if (a->script && a->is_bench) return misuse("either --script or --bench", "");
    a->scene_path = argv[optind];
    return -1;
}

/* Does what the person in front of the window asks for until the window is closed. */
static status attend(preview *p)
{
    status rc = STATUS_OK;
    event e;
    bool drew;

    while (!p->quits) {
        const double wait_s = p->state.is_at_rest ? 0.03 : 0.004;
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
    if (ends_in(path, ".img"))
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

static status run(const arguments *a, double start_s)
{
    status rc = STATUS_OK;
    opening o = {.scene_path = a->scene_path};
    const errand list[] = {{read_scene, &o}, {prepare_pictures, NULL}};
    surface *s = NULL;
    preview *p = NULL;
    int width, height;

    TRY(errand_run(list, sizeof list / sizeof *list));
    print_lines("warning: ", status_warnings());
    const int columns = a->columns ? a->columns : o.of->s->camera.columns;
    const int rows = a->columns ? a->rows : o.of->s->camera.rows;
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

static int end(status rc)
{
    if (rc == STATUS_OK) return 0;
    print_lines("warning: ", status_warnings());
    print_lines("", status_message());
    return 1;
}

int main(int argc, char **argv)
{
    arguments a = {0};
    const double start_s = clock_now_s();
    int code;

    standard_output_open();
    code = take_arguments(&a, argc, argv);
    if (code < 0) code = end(run(&a, start_s));
    const int lost = end(standard_output_close());
    return code ? code : lost;
}
