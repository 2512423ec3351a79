#include "command/command_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

status command_settings_add(command_settings *settings, const char *key, const char *value)
{
    status rc = STATUS_OK;
    const size_t size = strlen(key) + strlen(value) + 2;
    char **larger = realloc(settings->text, (settings->count + 1) * sizeof *larger);
    char *text = malloc(size);

    if (larger) settings->text = larger;
    NEED(larger && text, STATUS_MEMORY, "no memory for the setting %.100s", value);
    snprintf(text, size, "%s%s%s", key, *key ? "=" : "", value);
    settings->text[settings->count++] = text;
    text = NULL;
out:
    free(text);
    return rc;
}

void command_settings_free(command_settings *settings)
{
    for (size_t i = 0; i < settings->count; i++) free(settings->text[i]);
    free(settings->text);
    *settings = (command_settings){0};
}

static status read_setting(const option *o, const char *text)
{
    status rc = STATUS_OK;

    NEED(strchr(text, '='), STATUS_ARGUMENT, "found '%s', expected TABLE.KEY=VALUE", text);
    TRY(command_settings_add(o->out, "", text));
out:
    return rc;
}

option command_set_option(command_settings *settings)
{
    return (option){.name = "set",
                    .value = "TABLE.KEY=VALUE",
                    .help = "change a value of the scene, as --set camera.twist_deg=10; may be "
                            "repeated",
                    .out = settings,
                    .read = read_setting,
                    .repeats = true};
}

status command_scene_read(scene **out, const char *path, const command_settings *settings)
{
    return scene_read(out, path, (const char *const *)settings->text, settings->count);
}
