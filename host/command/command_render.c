#include "base/interrupt.h"
#include "base/number.h"
#include "base/parallel_job.h"
#include "command/command.h"
#include "command/command_scene.h"
#include "command/command_value.h"
#include "device/pocl_affinity.h"
#include "device/pocl_cache.h"
#include "image/picture.h"
#include "render/render_output.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char command[] = "radsig render";

static const char purpose[] =
    "Makes the radiance image of a scene and its truth planes:\n"
    "  DIR/NAME.img, .hdr         radiance, one ENVI band per sensor band\n"
    "  DIR/NAME_truth.img, .hdr   every other plane, its unit in the band name\n"
    "  DIR/NAME.exr, NAME_<plane>.png, NAME.json\n";

enum { DEVICE_LIMIT = 16 };

typedef struct arguments {
    command_settings settings;
    render_output_options output;
    const char *bands;
    int device[DEVICE_LIMIT];
    size_t device_count;
} arguments;

static status read_size(const option *o, const char *text)
{
    status rc = STATUS_OK;
    uint32_t columns, rows;
    char value[64];

    NEED(number_read_size(text, &columns, &rows), STATUS_ARGUMENT,
         "found '%s', expected COLUMNSxROWS, at most %d pixels", text, INT32_MAX);
    snprintf(value, sizeof value, "[%u, %u]", columns, rows);
    TRY(command_settings_add(o->out, "camera.pixels", value));
out:
    return rc;
}

static status read_mode(const option *o, const char *text)
{
    return command_settings_add(o->out, "render.mode", text);
}

/* One time, or several with commas between. */
static status read_times(const option *o, const char *text)
{
    status rc = STATUS_OK;
    const size_t size = strlen(text) + 3;
    char *list = malloc(size);

    NEED(list, STATUS_MEMORY, "no memory for the times");
    NEED(*text, STATUS_ARGUMENT, "found '', expected a time such as 1987-06-24T10:00:00-05:00");
    snprintf(list, size, strchr(text, ',') ? "[%s]" : "%s", text);
    TRY(command_settings_add(o->out, "site.time", list));
out:
    free(list);
    return rc;
}

static status read_probe(const option *o, const char *text)
{
    status rc = STATUS_OK;
    render_output_options *output = o->out;
    int64_t column = 0, row = 0;
    const char *end = number_take_whole(text, 0, INT32_MAX, &column);

    NEED(end && *end == ',' && number_read_whole(end + 1, 0, INT32_MAX, &row), STATUS_ARGUMENT,
         "found '%s', expected COLUMN,ROW, counted from 0,0", text);
    output->wants_probe = true;
    output->probe[0] = (uint32_t)column;
    output->probe[1] = (uint32_t)row;
out:
    return rc;
}

static status read_devices(const option *o, const char *text)
{
    status rc = STATUS_OK;
    arguments *a = o->out;
    size_t count = 0;
    const char *at = text;

    do {
        int64_t index = 0;
        at = number_take_whole(at, 0, 63, &index);
        NEED(at && (*at == ',' || !*at) && count < DEVICE_LIMIT, STATUS_ARGUMENT,
             "found '%s', expected up to %d numbers of devices from 0 to 63, with commas between",
             text, DEVICE_LIMIT);
        for (size_t i = 0; i < count; i++)
            NEED(a->device[i] != (int)index, STATUS_ARGUMENT,
                 "found '%s', expected each device once", text);
        a->device[count++] = (int)index;
    } while (*at++);
    a->device_count = count;
out:
    return rc;
}

static int read_arguments(arguments *a, int argc, char **argv)
{
    command_settings *settings = &a->settings;
    option list[] = {
        {"output", 'o', "DIR", "folder for the files; made if it is absent",
         .text = &a->output.folder, .is_required = true},
        {"bands", 0, "A,B", "only these bands", .text = &a->bands},
        {"planes", 0, "A,B",
         "only these truth planes; emitted_BAND, reflected_sun_BAND, reflected_sky_BAND, "
         "reflected_background_BAND, path_BAND and transmission_BAND are written only if they are "
         "named",
         .text = &a->output.planes},
        {"size", 0, "WxH", "pixels: columns x rows", .out = settings, .read = read_size},
        {"time", 0, "ISO[,ISO...]",
         "time with offset, as 1987-06-24T10:00:00-05:00; several of one day, up to 96, go into "
         "DIR/19870624T100000-0500 and so on",
         .out = settings, .read = read_times},
        {"mode", 0, "exact|thesis", "exact integrals, or what the thesis did", .out = settings,
         .read = read_mode},
        command_set_option(settings),
        {"probe", 0, "COLUMN,ROW",
         "also the spectra of that pixel, counted from 0,0 at the top left: "
         "NAME_probe_COLUMN_ROW.csv and .png, every term of its radiance",
         .out = &a->output, .read = read_probe},
        {"exr", 0, NULL, "write NAME.exr above 16 bands too", .flag = &a->output.wants_exr},
        {"device", 0, "N[,M...]", "OpenCL devices, see radsig devices; several share the tiles",
         .out = a, .read = read_devices}};
    const option_table table = {command, "SCENE", 1, 1, purpose, list, sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);

    a->output.scene_path = argv[1];
    return code;
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
    const parallel_job list[] = {{read_scene, &o}, {prepare_pictures, &o}, {open_devices, &o}};

    pocl_affinity_set(); /* the environment is another thread's later */
    pocl_cache_choose();
    TRY(parallel_run(list, sizeof list / sizeof *list));
    TRY(render_output(o.s, o.dev, a->device_count, &a->output));
out:
    for (size_t i = 0; i < a->device_count; i++) device_free(o.dev[i]);
    scene_free(o.s);
    return rc;
}

int command_render(int argc, char **argv)
{
    arguments *a = calloc(1, sizeof *a);
    int code;

    if (!a) return program_end(command, status_set(STATUS_MEMORY, "no memory"));
    a->device[0] = -1;
    a->device_count = 1;
    a->output.shows_progress = isatty(STDERR_FILENO);
    code = read_arguments(a, argc, argv);
    if (code == OPTION_TABLE_DONE) {
        interrupt_catch_signals();
        code = program_end(command, run(a));
    }
    command_settings_free(&a->settings);
    free(a);
    return code;
}
