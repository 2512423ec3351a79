#include "full_render.h"

#include "base/interrupt.h"
#include "render/render_output.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SETTING_LIMIT = 4 };

struct full_render {
    pthread_t thread;
    bool has_thread, is_told;
    char *path, *folder, *setting[SETTING_LIMIT];
    size_t setting_count;
    bool has_camera;
    view camera;
    atomic_int stop, percent;
    atomic_bool ended;
    status result;
    char message[512];
};

static status run(full_render *full)
{
    status rc = STATUS_OK;
    scene *s = NULL;
    device *dev = NULL;
    const render_output_options options = {
        .scene_path = full->path, .folder = full->folder, .percent = &full->percent};

    TRY(scene_read(&s, full->path, (const char *const *)full->setting, full->setting_count));
    if (full->has_camera) {
        const view stated = s->camera;
        s->camera = full->camera;
        s->camera.columns = stated.columns;
        s->camera.rows = stated.rows;
        s->camera.crop = stated.crop;
    }
    TRY(device_open(&dev, -1));
    TRY(render_output(s, &dev, 1, &options));
out:
    device_free(dev);
    scene_free(s);
    return rc;
}

static void *work(void *argument)
{
    full_render *full = argument;

    interrupt_obey(&full->stop);
    full->result = run(full);
    if (full->result != STATUS_OK)
        snprintf(full->message, sizeof full->message, "%s", status_message());
    atomic_store(&full->ended, true);
    return NULL;
}

status full_render_start(full_render **out, const char *scene_path, const char *const *setting,
                         size_t setting_count, const view *camera, const char *folder)
{
    status rc = STATUS_OK;
    full_render *full = calloc(1, sizeof *full);

    NEED(full, STATUS_MEMORY, "no memory for a render");
    full->path = strdup(scene_path);
    full->folder = strdup(folder);
    NEED(full->path && full->folder, STATUS_MEMORY, "no memory for a render");
    for (size_t i = 0; i < setting_count && i < SETTING_LIMIT; i++) {
        full->setting[i] = strdup(setting[i]);
        NEED(full->setting[i], STATUS_MEMORY, "no memory for a render");
        full->setting_count++;
    }
    full->has_camera = camera != NULL;
    if (camera) full->camera = *camera;
    NEED(pthread_create(&full->thread, NULL, work, full) == 0, STATUS_MEMORY,
         "no thread can be started");
    full->has_thread = true;
    *out = full;
    full = NULL;
out:
    full_render_free(full);
    return rc;
}

void full_render_free(full_render *full)
{
    if (!full) return;
    full->stop = 1;
    if (full->has_thread) pthread_join(full->thread, NULL);
    for (size_t i = 0; i < SETTING_LIMIT; i++) free(full->setting[i]);
    free(full->path);
    free(full->folder);
    free(full);
}

bool full_render_is_running(const full_render *full)
{
    return !atomic_load(&full->ended);
}

int full_render_percent(const full_render *full)
{
    return full->percent;
}

const char *full_render_folder(const full_render *full)
{
    return full->folder;
}

void full_render_tell(full_render *full, char *out, size_t size)
{
    full->is_told = true;
    if (full->result == STATUS_OK)
        snprintf(out, size, "%s is written", full->folder);
    else
        snprintf(out, size, "%s", full->message);
}

bool full_render_is_told(const full_render *full)
{
    return full->is_told;
}
