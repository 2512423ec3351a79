/* Full render: `radsig render` of the view on the screen, in a thread and on a device of its own. */
#ifndef FULL_RENDER_H
#define FULL_RENDER_H

#include "base/status.h"
#include "scene/view.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct full_render full_render;

/* Starts; the size is the scene's.
 *   setting    shape (setting_count): as scene_read takes them; copied
 *   camera     NULL: the scene's
 *   folder     for the files */
status full_render_start(full_render **out, const char *scene_path, const char *const *setting,
                         size_t setting_count, const view *camera, const char *folder);

/* Interrupts it unless it has ended, which leaves no file. */
void full_render_free(full_render *full);

bool full_render_is_running(const full_render *full);
int full_render_percent(const full_render *full);
const char *full_render_folder(const full_render *full);

/* Writes how it ended, once. */
void full_render_tell(full_render *full, char *out, size_t size);
bool full_render_is_told(const full_render *full);

#endif
