#include "command_scene.h"

#include <stdio.h>
#include <string.h>

bool command_settings_add(command_settings *settings, const char *key, const char *value)
{
    if (settings->count == COMMAND_SETTINGS) return false;
    const int length = snprintf(settings->text[settings->count], COMMAND_SETTING_SIZE, "%s%s%s",
                                key, *key ? "=" : "", value);
    if (length >= COMMAND_SETTING_SIZE) return false;
    settings->count++;
    return true;
}

status command_scene_read(scene **out, const char *path, const command_settings *settings)
{
    const char *texts[COMMAND_SETTINGS];

    for (size_t i = 0; i < settings->count; i++) texts[i] = settings->text[i];
    return scene_read(out, path, texts, settings->count);
}
