#include "render/render_output.h"

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/parallel_job.h"
#include "image/quick_look.h"
#include "render/render_pool.h"
#include "render/render_probe.h"
#include "render/render_sensor.h"
#include "render/render_summary.h"
#include "scene/scene_limits.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct writing {
    const scene *s;
    const render_output_options *options;
    render_pool *pool;
    const render_plane *planes;
    size_t plane_count;
    output_folder *folder;
    image *cube, *truth, *sensor; /* sensor: NULL unless the scene has one */
    float **values;               /* shape (plane_count): of the image's plane, NULL: not wanted */
    char time[SITE_TIME_SIZE];
    image_label *materials;
    image_header header;
} writing;

typedef struct drawing {
    output_folder *folder;
    char name[512];
    quick_look look;
} drawing;

typedef struct drawings {
    drawing *list;
    size_t count;
} drawings;

/* True if `name` stands in a list of names with commas between. */
static bool is_listed(const char *list, const char *name)
{
    const size_t length = strlen(name);

    for (const char *at = list; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL)
        if (!strncmp(at, name, length) && (at[length] == ',' || at[length] == '\0')) return true;
    return false;
}

static bool is_wanted(const writing *w, const render_plane *p)
{
    if (p->is_radiance) return true;
    if (w->options->planes) return is_listed(w->options->planes, p->name);
    return !p->is_of_band || (!p->is_part && w->s->band_count <= RENDER_OUTPUT_BANDS);
}

static status check_names(const writing *w)
{
    status rc = STATUS_OK;
    char name[RENDER_PLANE_NAME_SIZE];

    for (const char *at = w->options->planes; at;) {
        const size_t length = strcspn(at, ",");
        snprintf(name, sizeof name, "%.*s", (int)length, at);
        TRY(render_plane_check(w->planes, w->plane_count, name));
        at = at[length] ? at + length + 1 : NULL;
    }
out:
    return rc;
}

static status check_probe(const scene *s, const render_output_options *options)
{
    status rc = STATUS_OK;
    const uint32_t *at = options->probe;

    NEED(!options->wants_probe ||
             (at[0] < (uint32_t)s->camera.columns && at[1] < (uint32_t)s->camera.rows),
         STATUS_ARGUMENT, "there is no pixel in column %u, row %u to probe, expected 0,0 to %d,%d",
         at[0], at[1], s->camera.columns - 1, s->camera.rows - 1);
out:
    return rc;
}

static char *file_name(char out[512], const scene *s, const char *plane, const char *extension)
{
    snprintf(out, 512, "%s%s%s%s", s->name, *plane ? "_" : "", plane, extension);
    return out;
}

/* Opens one image with the wanted planes of a kind, and sets where their values go. */
static status open_image(writing *w, image **out, bool is_radiance)
{
    status rc = STATUS_OK;
    char stem[512];
    image_plane *list = malloc(w->plane_count * sizeof *list);
    size_t count = 0, at = 0;

    NEED(list, STATUS_MEMORY, "no memory for the list of planes");
    for (size_t i = 0; i < w->plane_count; i++)
        if (w->planes[i].is_radiance == is_radiance && is_wanted(w, &w->planes[i]))
            list[count++] = w->planes[i].plane;
    if (count == 0) goto out;
    TRY(image_create(out, w->folder, file_name(stem, w->s, is_radiance ? "" : "truth", ""),
                     (uint32_t)w->s->camera.columns, (uint32_t)w->s->camera.rows, list, count));
    for (size_t i = 0; i < w->plane_count; i++)
        if (w->planes[i].is_radiance == is_radiance && is_wanted(w, &w->planes[i]))
            w->values[i] = image_values(*out, at++);
out:
    free(list);
    return rc;
}

/* The pool is opened for the first time of a scene, and moved to the others.
 *   folder   that the files go to */
static status open_writing(writing *w, const scene *s, device *const *dev, size_t dev_count,
                           const render_output_options *options, const char *folder,
                           render_pool **pool)
{
    status rc = STATUS_OK;

    *w = (writing){.s = s, .options = options};
    site_format_time(s->place.time_s, 0, w->time);
    TRY(check_probe(s, options));
    if (*pool)
        TRY(render_pool_move(*pool, s));
    else
        TRY(render_pool_open(pool, s, dev, dev_count));
    w->pool = *pool;
    w->planes = render_planes(render_pool_render(w->pool), &w->plane_count);
    TRY(check_names(w));
    w->values = calloc(w->plane_count, sizeof *w->values);
    w->materials = malloc((s->material_count + 1) * sizeof *w->materials);
    NEED(w->values && w->materials, STATUS_MEMORY, "no memory for the list of planes");
    for (uint32_t i = 0; i < s->material_count; i++)
        w->materials[i] =
            (image_label){(int32_t)s->materials[i].record.number, s->materials[i].name};
    TRY(output_folder_open(&w->folder, folder));
    TRY(open_image(w, &w->cube, true));
    TRY(open_image(w, &w->truth, false));
out:
    return rc;
}

static void free_writing(writing *w)
{
    image_free(w->sensor);
    image_free(w->truth);
    image_free(w->cube);
    output_folder_free(w->folder);
    free(w->materials);
    free(w->values);
}

static void show_progress(void *listener, uint32_t done)
{
    const writing *w = listener;
    const uint32_t all = (uint32_t)w->s->camera.columns * (uint32_t)w->s->camera.rows;

    if (w->options->percent) *w->options->percent = (int)(100 * (uint64_t)done / all);
    if (!w->options->shows_progress) return;
    fprintf(stderr, "\r%s: %3.0f %% of %u pixels%s", w->s->name, floor(100.0 * done / all), all,
            done == all ? "\n" : "");
}

static status write_values(void *self, size_t plane, uint32_t first, uint32_t count,
                           const float *values)
{
    const writing *w = self;
    image *to = w->planes[plane].is_radiance ? w->cube : w->truth;
    const size_t pixels = (size_t)image_columns(to) * image_rows(to);
    const size_t place = (size_t)(w->values[plane] - image_values(to, 0)) / pixels;

    return image_write(to, place, first, count, values);
}

static status render_pixels(writing *w)
{
    status rc = STATUS_OK;
    const render_store store = {write_values, w};

    TRY(render_pool_run(w->pool, w->values, &store, show_progress, w));
    w->planes = render_planes(render_pool_render(w->pool), &w->plane_count);
out:
    return rc;
}

/* Numbers of materials and of interactions with their names. */
static quick_look labelled(const writing *w, const render_plane *p, quick_look look)
{
    static const image_label interactions[] = {
        {0, "missed"},          {1, "diffuse"},
        {2, "specular to sky"}, {3, "specular to background"},
        {4, "partly to sky"},   {5, "partly to background"}};

    if (look.colours != QUICK_LOOK_LABELS) return look;
    if (!strcmp(p->name, "interaction")) {
        look.label = interactions;
        look.label_count = sizeof interactions / sizeof *interactions;
    } else {
        look.label = w->materials;
        look.label_count = w->s->material_count;
    }
    return look;
}

/* Of many bands only the first, the middle and the last become pictures. */
static bool is_pictured(const writing *w, size_t plane)
{
    const uint32_t bands = w->s->band_count;
    const uint32_t index = w->planes[plane].source / BAND_PLANES;

    if (!w->planes[plane].is_of_band || bands <= RENDER_OUTPUT_BANDS) return true;
    return index == 0 || index == bands / 2 || index == bands - 1;
}

static status write_picture(void *self)
{
    const drawing *d = self;

    return quick_look_write(d->folder, d->name, &d->look);
}

static void add_drawing(writing *w, drawings *to, image *of, const image_plane *plane,
                        const float *value)
{
    drawing *d = &to->list[to->count++];

    d->folder = w->folder;
    file_name(d->name, w->s, plane->name, ".png");
    d->look = (quick_look){.columns = image_columns(of),
                           .rows = image_rows(of),
                           .value = value,
                           .scene = w->s->name,
                           .time = w->time,
                           .plane = plane->name,
                           .unit = plane->unit};
}

static status list_drawings(writing *w, drawings *to)
{
    status rc = STATUS_OK;

    to->list = calloc(w->plane_count + w->s->band_count, sizeof *to->list);
    NEED(to->list, STATUS_MEMORY, "no memory for the list of pictures");
    for (size_t i = 0; i < w->plane_count; i++) {
        const render_plane *p = &w->planes[i];
        if (!w->values[i] || !is_pictured(w, i)) continue;
        add_drawing(w, to, p->is_radiance ? w->cube : w->truth, &p->plane, w->values[i]);
        quick_look *look = &to->list[to->count - 1].look;
        look->colours = quick_look_colours_of(&p->plane);
        *look = labelled(w, p, *look);
    }
    for (uint32_t i = 0; w->sensor && i < w->s->band_count; i++)
        if (is_pictured(w, i))
            add_drawing(w, to, w->sensor, image_plane_at(w->sensor, i), image_values(w->sensor, i));
out:
    return rc;
}

static status write_exr(void *self)
{
    const writing *w = self;
    image *const images[] = {w->cube, w->truth};
    char name[512];

    return image_write_exr(w->folder, file_name(name, w->s, "", ".exr"), images, w->truth ? 2 : 1,
                           &w->header);
}

/* Pictures and OpenEXR; what takes longest first. */
static status write_pictures(writing *w)
{
    status rc = STATUS_OK;
    drawings pictures = {0};
    parallel_job *list = NULL;
    size_t count = 0;

    TRY(list_drawings(w, &pictures));
    list = calloc(pictures.count + 1, sizeof *list);
    NEED(list, STATUS_MEMORY, "no memory for the list of pictures");
    if (w->s->band_count <= RENDER_OUTPUT_BANDS || w->options->wants_exr)
        list[count++] = (parallel_job){write_exr, w};
    for (size_t i = 0; i < pictures.count; i++)
        list[count++] = (parallel_job){write_picture, &pictures.list[i]};
    TRY(parallel_run(list, count));
out:
    free(list);
    free(pictures.list);
    return rc;
}

static status write_summary(writing *w, double start)
{
    char name[512];
    const render_summary summary = {.s = w->s,
                                    .scene_path = w->options->scene_path,
                                    .planes = w->planes,
                                    .values = w->values,
                                    .plane_count = w->plane_count,
                                    .sensor = w->sensor,
                                    .materials = w->materials,
                                    .pool = w->pool,
                                    .start_s = start};

    return render_summary_write(w->folder, file_name(name, w->s, "", ".json"), &summary);
}

static status write_files(writing *w, double start)
{
    status rc = STATUS_OK;
    char description[512];
    const image_field field = {
        .key = "radsig materials", .label = w->materials, .label_count = w->s->material_count};

    snprintf(description, sizeof description, "radsig %s, scene %s, %s mode", RADSIG_VERSION,
             w->s->name, w->s->thesis ? "thesis" : "exact");
    w->header = (image_header){description, w->time, &field, 1};
    if (w->s->sensor.is_wanted) /* what the sensor makes of the radiance */
        TRY(render_sensor_write(&w->sensor, w->folder, w->s, render_pool_device(w->pool, 0),
                                w->cube, &w->header));
    TRY(write_pictures(w));
    TRY(image_finish(w->cube, &w->header));
    if (w->truth) TRY(image_finish(w->truth, &w->header));
    if (w->options->wants_probe)
        TRY(render_probe_write(w->folder, w->s, render_pool_render(w->pool), w->options->probe[0],
                               w->options->probe[1]));
    TRY(write_summary(w, start));
    TRY(interrupt_check());
    TRY(output_folder_commit(w->folder));
out:
    return rc;
}

static status render_time(const scene *s, device *const *dev, size_t dev_count,
                          const render_output_options *options, const char *folder,
                          render_pool **pool)
{
    status rc = STATUS_OK;
    const double start_s = clock_now_s();
    writing w = {0};

    TRY(open_writing(&w, s, dev, dev_count, options, folder, pool));
    TRY(render_pixels(&w));
    TRY(write_files(&w, start_s));
out:
    free_writing(&w);
    return rc;
}

/* The folder of one time, as 19870624T100000-0500; without what a file name should not hold. */
static void time_folder(char *out, size_t size, const char *folder, const site *place)
{
    char time[SITE_TIME_SIZE];
    size_t length;

    site_format_time(place->time_s, place->utc_offset_min, time);
    length = (size_t)snprintf(out, size, "%s/", folder);
    for (size_t i = 0; time[i] && length + 1 < size; i++)
        if (time[i] != ':' && (time[i] != '-' || i > 10)) out[length++] = time[i];
    out[length < size ? length : size - 1] = '\0';
}

/* Planes that the images hold at least: the radiances, and those that are asked for. */
static size_t least_planes(const scene *s, const char *planes)
{
    size_t count = s->band_count + (planes ? 1u : TRUTH_PLANES + SUN_PLANES);

    for (; planes && *planes; planes++) count += *planes == ',';
    return count;
}

status render_output(const scene *s, device *const *dev, size_t dev_count,
                     const render_output_options *options)
{
    status rc = STATUS_OK;
    const size_t size = strlen(options->folder) + SITE_TIME_SIZE + 2;
    char *folder = malloc(size);
    scene *at = malloc(s->time_count * sizeof *at);
    render_pool *pool = NULL;

    NEED(folder && at, STATUS_MEMORY, "no memory for %zu times", s->time_count);
    TRY(scene_limits_disk(s, least_planes(s, options->planes), options->folder));
    for (size_t i = 0; i < s->time_count; i++) {
        at[i] = *s;
        at[i].place.time_s = s->time_s[i];
        time_folder(folder, size, options->folder, &at[i].place);
        TRY(render_time(&at[i], dev, dev_count, options,
                        s->time_count > 1 ? folder : options->folder, &pool));
    }
out:
    render_pool_free(pool);
    free(at);
    free(folder);
    return rc;
}
