/* Command scene: the options that render and check share: they change what scene.toml says. */
#ifndef COMMAND_SCENE_H
#define COMMAND_SCENE_H

#include "scene.h"

enum { COMMAND_SETTINGS = 64, COMMAND_SETTING_SIZE = 512 };

typedef struct command_settings {
    char text[COMMAND_SETTINGS][COMMAND_SETTING_SIZE];
    size_t count;
} command_settings;

/* Adds "key=value"; returns false where there are too many or it is too long. */
bool command_settings_add(command_settings *settings, const char *key, const char *value);

/* Reads a scene with the settings. */
status command_scene_read(scene **out, const char *path, const command_settings *settings);

#endif
