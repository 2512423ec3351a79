/* Command scene: options that change what scene.toml says. */
#ifndef COMMAND_SCENE_H
#define COMMAND_SCENE_H

#include "options/option_table.h"
#include "scene/scene.h"

typedef struct command_settings {
    char **text; /* shape (count): key=value */
    size_t count;
} command_settings;

/* Adds "key=value". */
status command_settings_add(command_settings *settings, const char *key, const char *value);
void command_settings_free(command_settings *settings);

/* --set TABLE.KEY=VALUE */
option command_set_option(command_settings *settings);

/* Reads a scene with the settings. */
status command_scene_read(scene **out, const char *path, const command_settings *settings);

#endif
