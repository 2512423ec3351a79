#include "saving.h"

#include "files/output_file.h"
#include "image/image.h"
#include "meshio/image_file.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_SIZE = 512, NUMBER_LIMIT = 10000 };

/* Writes NAME-KIND-N with the lowest N for which neither ending is taken. */
static void free_stem(const preview *p, const char *kind, const char *const ending[2],
                      char out[PATH_SIZE])
{
    char path[PATH_SIZE + 16];
    bool is_taken = true;

    for (int n = 1; is_taken && n < NUMBER_LIMIT; n++) {
        snprintf(out, PATH_SIZE, "%s-%s-%d", preview_scene(p)->name, kind, n);
        is_taken = false;
        for (int i = 0; i < 2; i++) {
            snprintf(path, sizeof path, "%s%s", out, ending[i]);
            is_taken |= access(path, F_OK) == 0;
        }
    }
}

static void tell(preview *p, status rc, const char *path)
{
    if (rc == STATUS_OK)
        preview_note(p, "%s is written", path);
    else
        preview_note(p, "%s", status_message());
}

void saving_view(preview *p)
{
    static const char *const endings[2] = {".adv", ".toml"};
    char stem[PATH_SIZE], path[PATH_SIZE + 16];
    view v = p->camera;
    status rc;

    v.columns = p->wish.columns;
    v.rows = p->wish.rows;
    v.crop = (view_crop){0};
    free_stem(p, "view", endings, stem);
    snprintf(path, sizeof path, "%s.toml", stem);
    rc = view_write_table(&v, path);
    if (v.width_m > 0.0) goto out; /* which an .adv does not know */
    snprintf(path, sizeof path, "%s.adv", stem);
    if (rc == STATUS_OK) rc = view_write(&v, path);
out:
    tell(p, rc, path);
}

void saving_page(preview *p)
{
    static const char *const endings[2] = {".png", ".png"};
    char stem[PATH_SIZE], path[PATH_SIZE + 16];

    free_stem(p, "page", endings, stem);
    snprintf(path, sizeof path, "%s.png", stem);
    tell(p, saving_write_page(p, path), path);
}

void saving_full_render(preview *p)
{
    static const char *const endings[2] = {"", ""};
    char folder[PATH_SIZE], time[32 + SITE_TIME_SIZE] = "site.time=";
    const char *setting[2];
    size_t count = 0;
    status rc;

    if (p->full && full_render_is_running(p->full)) {
        preview_note(p, "%s is still being rendered", full_render_folder(p->full));
        return;
    }
    full_render_free(p->full);
    p->full = NULL;
    const scene *s = preview_scene(p);
    site_format_time(preview_time_s(p), s->place.utc_offset_min, time + strlen(time));
    if (p->wish.has_time) setting[count++] = time;
    if (p->wish.has_mode)
        setting[count++] = p->wish.thesis ? "render.mode=thesis" : "render.mode=exact";
    free_stem(p, "render", endings, folder);
    rc = full_render_start(&p->full, s->path, setting, count,
                           p->wish.has_camera ? &p->camera : NULL, folder);
    if (rc != STATUS_OK) tell(p, rc, folder);
}

/* A page as the canvas has it. */
typedef struct page_copy {
    size_t width;
    uint8_t *rgb; /* shape (height, width, 3) */
} page_copy;

static const uint8_t *row_of(void *self, uint32_t y)
{
    const page_copy *copy = self;

    return copy->rgb + y * copy->width * 3;
}

status saving_write_page(preview *p, const char *path)
{
    status rc = STATUS_OK;
    char message[1024] = "";
    output_file *file = NULL;
    const image_frame about = {.width = (uint32_t)p->width, .height = (uint32_t)p->height};
    page_copy copy = {(size_t)p->width, malloc((size_t)p->width * (size_t)p->height * 3)};

    NEED(copy.rgb, STATUS_MEMORY, "no memory for the page");
    TRY(canvas_read(p->c, copy.rgb));
    TRY(output_file_open(&file, path));
    NEED(image_file_write_png(output_file_stream(file), path, &about, row_of, &copy, message,
                              sizeof message) == 0,
         STATUS_FILE, "%s", message);
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    free(copy.rgb);
    return rc;
}

/* Cuts FOLDER/STEM.img in its parts. */
static void cut(const char *path, char folder[PATH_SIZE], char stem[PATH_SIZE])
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const size_t length = strlen(name);

    snprintf(folder, PATH_SIZE, "%.*s", slash ? (int)(slash - path + (slash == path)) : 1,
             slash ? path : ".");
    snprintf(stem, PATH_SIZE, "%.*s", (int)(length > 4 ? length - 4 : length), name);
}

static status copy_radiances(const frame *f, output_folder *folder, const char *stem, image **out)
{
    status rc = STATUS_OK;
    const uint32_t bands = f->of->s->band_count;
    image_plane *planes = malloc((bands + 1) * sizeof *planes);

    NEED(planes, STATUS_MEMORY, "no memory for the list of planes");
    for (uint32_t b = 0; b < bands; b++) planes[b] = f->planes[b].plane;
    TRY(image_create(out, folder, stem, (uint32_t)f->camera.columns, (uint32_t)f->camera.rows,
                     planes, bands));
    for (uint32_t b = 0; b < bands; b++)
        memcpy(image_values(*out, b), f->values[b], frame_pixels(f) * sizeof(float));
out:
    free(planes);
    return rc;
}

status saving_write_image(preview *p, const char *path)
{
    status rc = STATUS_OK;
    char folder_path[PATH_SIZE], stem[PATH_SIZE], time[SITE_TIME_SIZE], description[PATH_SIZE];
    const image_header header = {.description = description, .time = time};
    output_folder *folder = NULL;
    image *img = NULL;

    NEED(p->live && p->live->is_exact, STATUS_ARGUMENT, "%s: there is no exact picture yet", path);
    const scene *s = p->live->of->s;
    cut(path, folder_path, stem);
    site_format_time(p->live->time_s, 0, time);
    snprintf(description, sizeof description, "radsig %s, scene %.300s, %s mode", RADSIG_VERSION,
             s->name, s->thesis ? "thesis" : "exact");
    TRY(output_folder_open(&folder, folder_path));
    TRY(copy_radiances(p->live, folder, stem, &img));
    TRY(image_finish(img, &header));
    TRY(output_folder_commit(folder));
out:
    image_free(img);
    output_folder_free(folder);
    return rc;
}
