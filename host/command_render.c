#include "command.h"
#include "command_scene.h"
#include "command_value.h"
#include "errand.h"
#include "picture.h"
#include "pocl_affinity.h"
#include "render_output.h"

#include <getopt.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char help[] =
    "usage: radsig render SCENE -o DIR [OPTION ...]\n"
    "\n"
    "Makes the radiance image of a scene and its truth planes:\n"
    "  DIR/NAME.img, .hdr         radiance, one ENVI band per sensor band\n"
    "  DIR/NAME_truth.img, .hdr   every other plane, its unit in the band name\n"
    "  DIR/NAME.exr, NAME_<plane>.png, NAME.json\n"
    "\n"
    "  -o, --output DIR       folder for the files; made where it is absent\n"
    "  --bands A,B            only these bands\n"
    "  --planes A,B           only these truth planes; emitted_BAND, reflected_sun_BAND,\n"
    "                         reflected_sky_BAND, reflected_background_BAND, path_BAND and\n"
    "                         transmission_BAND are written only where they are named\n"
    "  --size WxH             pixels: columns x rows\n"
    "  --time ISO[,ISO...]    time with offset, as 1987-06-24T10:00:00-05:00; several of one day "
    "go\n"
    "                         into DIR/19870624T100000-0500 and so on\n"
    "  --mode exact|thesis    exact integrals, or what the thesis did\n"
    "  --set TABLE.KEY=VALUE  change a value of the scene, as --set camera.twist_deg=10\n"
    "  --probe COLUMN,ROW     also the spectra of that pixel, counted from 0,0 at the top left:\n"
    "                         NAME_probe_COLUMN_ROW.csv and .png, every term of its radiance\n"
    "  --exr                  write NAME.exr above 16 bands too\n"
    "  --device N[,M...]      OpenCL devices, see radsig devices; several share the tiles\n";

static volatile sig_atomic_t stop;

static void on_signal(int signal_number)
{
    (void)signal_number;
    stop = 1;
}

enum { DEVICE_LIMIT = 16 };

typedef struct arguments {
    command_settings settings;
    render_output_options output;
    const char *bands;
    int device[DEVICE_LIMIT];
    size_t device_count;
} arguments;

static bool add_size(command_settings *settings, const char *text)
{
    unsigned columns, rows;
    char end, value[64];

    if (strspn(text, "0123456789x") != strlen(text)) return false;
    if (sscanf(text, "%ux%u%c", &columns, &rows, &end) != 2) return false;
    snprintf(value, sizeof value, "[%u, %u]", columns, rows);
    return command_settings_add(settings, "camera.pixels", value);
}

static bool take_probe(render_output_options *output, const char *text)
{
    char end;

    output->wants_probe = true;
    return strspn(text, "0123456789,") == strlen(text) && strlen(text) < 20 &&
           sscanf(text, "%9u,%9u%c", &output->probe[0], &output->probe[1], &end) == 2;
}

/* One time, or several with commas between. */
static bool add_time(command_settings *settings, const char *text)
{
    char list[COMMAND_SETTING_SIZE];

    if (!strchr(text, ',')) return command_settings_add(settings, "site.time", text);
    if (snprintf(list, sizeof list, "[%s]", text) >= (int)sizeof list) return false;
    return command_settings_add(settings, "site.time", list);
}

/* Takes one option; false where its value is none. */
static bool take_option(arguments *a, int option, const char *value)
{
    switch (option) {
    case 'o':
        a->output.folder = value;
        return *value != '\0';
    case 'b':
        a->bands = value;
        return *value != '\0';
    case 'p':
        a->output.planes = value;
        return *value != '\0';
    case 's':
        return add_size(&a->settings, value);
    case 't':
        return add_time(&a->settings, value);
    case 'm':
        return command_settings_add(&a->settings, "render.mode", value);
    case 'S':
        return strchr(value, '=') && command_settings_add(&a->settings, "", value);
    case 'P':
        return take_probe(&a->output, value);
    case 'd':
        return command_device_numbers(value, DEVICE_LIMIT, a->device, &a->device_count);
    default:
        a->output.wants_exr = true;
        return true;
    }
}

static const struct option options[] = {
    {"output", required_argument, NULL, 'o'}, {"bands", required_argument, NULL, 'b'},
    {"planes", required_argument, NULL, 'p'}, {"size", required_argument, NULL, 's'},
    {"time", required_argument, NULL, 't'},   {"mode", required_argument, NULL, 'm'},
    {"set", required_argument, NULL, 'S'},    {"probe", required_argument, NULL, 'P'},
    {"exr", no_argument, NULL, 'x'},          {"device", required_argument, NULL, 'd'},
    {"help", no_argument, NULL, 'h'},         {NULL, 0, NULL, 0}};

static const char *option_name(int option)
{
    const struct option *o = options;

    while (o->val != option) o++;
    return o->name;
}

/* Returns -1 to go on, or the exit code. */
static int take_arguments(arguments *a, int argc, char **argv)
{
    bool given[128] = {false};
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, ":o:", options, NULL)) != -1) {
        if (option == 'h') {
            fputs(help, stdout);
            return 0;
        }
        if (option == '?') return command_misuse("render", "unknown option '%s'", argv[optind - 1]);
        if (option == ':') return command_misuse("render", "%s needs a value", argv[optind - 1]);
        if (given[option] && option != 'S')
            return command_misuse("render", "--%s is given twice", option_name(option));
        if (!take_option(a, option, optarg))
            return command_misuse("render", "'%s' is no value for --%s", optarg,
                                  option_name(option));
        given[option] = true;
    }
    if (optind + 1 != argc)
        return command_misuse("render", argc > optind ? "one scene at a time" : "needs a scene");
    if (!a->output.folder) return command_misuse("render", "needs -o DIR");
    a->output.scene_path = argv[optind];
    return -1;
}

/* What is read and opened for a render; the devices get ready while the scene is read. */
typedef struct opening {
    const arguments *a;
    scene *s;
    device *dev[DEVICE_LIMIT];
    atomic_bool is_vain; /* the scene, or what writes pictures, has failed */
} opening;

static status read_scene(void *self)
{
    status rc = STATUS_OK;
    opening *o = self;

    TRY(command_scene_read(&o->s, o->a->output.scene_path, &o->a->settings));
    if (o->a->bands) TRY(scene_keep_bands(o->s, o->a->bands));
out:
    if (rc != STATUS_OK) o->is_vain = true;
    return rc;
}

static status prepare_pictures(void *self)
{
    status rc = STATUS_OK;
    opening *o = self;

    TRY(picture_prepare());
out:
    if (rc != STATUS_OK) o->is_vain = true;
    return rc;
}

static status open_devices(void *self)
{
    status rc = STATUS_OK;
    opening *o = self;

    for (size_t i = 0; i < o->a->device_count && !o->is_vain; i++)
        TRY(device_open(&o->dev[i], o->a->device[i]));
    for (size_t i = 0; i < o->a->device_count && !o->is_vain; i++)
        render_prepare(o->dev[i], &o->is_vain);
out:
    return rc;
}

static status run(const arguments *a)
{
    status rc = STATUS_OK;
    opening o = {.a = a};
    const errand list[] = {{read_scene, &o}, {prepare_pictures, &o}, {open_devices, &o}};

    pocl_affinity_set(); /* the environment is another thread's later */
    TRY(errand_run(list, sizeof list / sizeof *list));
    TRY(render_output(o.s, o.dev, a->device_count, &a->output));
out:
    /* A signal can also break off what the system was doing. */
    if (rc != STATUS_OK && stop) rc = status_set(STATUS_INTERRUPTED, "interrupted");
    for (size_t i = 0; i < a->device_count; i++) device_free(o.dev[i]);
    scene_free(o.s);
    return rc;
}

int command_render(int argc, char **argv)
{
    arguments *a = calloc(1, sizeof *a);
    int code;

    if (!a) return command_end("render", status_set(STATUS_MEMORY, "no memory"));
    a->device[0] = -1;
    a->device_count = 1;
    a->output.stop = &stop;
    a->output.shows_progress = isatty(STDERR_FILENO);
    code = take_arguments(a, argc, argv);
    if (code < 0) {
        const struct sigaction action = {.sa_handler = on_signal};
        sigaction(SIGINT, &action, NULL);
        sigaction(SIGTERM, &action, NULL);
        if (signal(SIGHUP, SIG_IGN) != SIG_IGN)
            sigaction(SIGHUP, &action, NULL); /* but for nohup */
        code = command_end("render", run(a));
    }
    free(a);
    return code;
}
