#include "scene/scene_limits.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>

#define PIXEL_BYTES (1u << 29) /* of one pixel's samples on a device */

status scene_limits_view(const scene *s, const view *camera)
{
    status rc = STATUS_OK;
    const bool is_part = camera->crop.columns > 0;
    const int columns = is_part ? camera->crop.columns : camera->columns;
    const int rows = is_part ? camera->crop.rows : camera->rows;
    const double pixels = (double)camera->columns * camera->rows,
                 samples = (double)s->samples_per_side * s->samples_per_side;

    NEED(view_fits(columns, rows), STATUS_ARGUMENT,
         "found %d x %d pixels, expected at most %d in all", columns, rows, VIEW_PIXELS);
    NEED(samples * pixels <= UINT32_MAX, STATUS_ARGUMENT,
         "found %d x %d pixels of %g samples, expected at most %u samples in all", camera->columns,
         camera->rows, samples, UINT32_MAX);
out:
    return rc;
}

/* What states the size of the picture. */
static const toml_node *size_node(const scene_reader *reader)
{
    static const char *const keys[] = {"pixels", "view"};
    const toml_node *camera = toml_node_get(reader->root, "camera");

    for (int i = 0; i < 2; i++)
        if (toml_node_get(camera, keys[i])) return toml_node_get(camera, keys[i]);
    return camera;
}

/* A tile holds whole pixels: see render_tile_most. */
static void check_pixel(scene_reader *reader)
{
    const scene *s = reader->s;
    const double cells =
        90.0 / s->hemisphere_zenith_step_deg * 360.0 / s->hemisphere_azimuth_step_deg;
    const double samples = (double)s->samples_per_side * s->samples_per_side;
    const double bytes = samples * (cells + (double)s->band_count * BAND_PLANES) * sizeof(float);

    if (bytes > PIXEL_BYTES)
        scene_fail(
            reader, toml_node_get(reader->root, "render"),
            "render: %g samples a pixel, %.0f directions around it and %u bands take %.0f MiB, "
            "expected at most %u",
            samples, cells, s->band_count, ceil(bytes / 0x1p20), PIXEL_BYTES >> 20);
}

void scene_limits_check(scene_reader *reader)
{
    if (scene_limits_view(reader->s, &reader->s->camera) != STATUS_OK) {
        const char *which = toml_node_name(size_node(reader));
        scene_fail(reader, size_node(reader), "%s: %s", which, status_last());
    }
    check_pixel(reader);
}

/* The nearest folder on the way to one that need not be there. */
static bool find_disk(const char *folder, struct statvfs *out)
{
    char *part = strdup(folder);
    bool found = part && statvfs(part, out) == 0;

    for (char *slash; part && !found && (slash = strrchr(part, '/'));) {
        *slash = '\0';
        found = statvfs(*part ? part : "/", out) == 0;
    }
    found = found || statvfs(".", out) == 0;
    free(part);
    return found;
}

status scene_limits_disk(const scene *s, size_t plane_count, const char *folder)
{
    status rc = STATUS_OK;
    struct statvfs disk;
    const double bytes = (double)s->camera.columns * s->camera.rows * (double)plane_count *
                         sizeof(float) * (double)s->time_count;

    if (!find_disk(folder, &disk)) goto out;
    const double room = (double)disk.f_bavail * (double)disk.f_frsize;
    NEED(bytes <= room, STATUS_FILE, "%s: no room for %.0f bytes of images, there are %.0f: %s",
         folder, bytes, room, strerror(ENOSPC));
out:
    return rc;
}
