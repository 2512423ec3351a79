#include "command/command.h"
#include "command/command_scene.h"
#include "weather/weather.h"

static const char command[] = "radsig weather";

static const char purpose[] = "Writes the weather of a scene as a .wth history: one that it "
                              "synthesises, to be edited, or one\n"
                              "that it reads from a table of measurements.\n";

/* A .wth has no column for it. */
static void warn_about_longwave(const weather *w, const char *path)
{
    size_t count = 0;

    for (size_t i = 0; i < w->count; i++) count += w->record[i].longwave_w_m2 > 0.0;
    if (count > 0)
        status_warn("%s: leaves out the measured longwave of %zu records: readers of the file will "
                    "estimate it from air temperature",
                    path, count);
}

static status run(const char *scene_path, const command_settings *settings, const char *path)
{
    status rc = STATUS_OK;
    scene *s = NULL;

    TRY(command_scene_read(&s, scene_path, settings));
    NEED(s->history, STATUS_ARGUMENT, "%s: has no [weather]", scene_path);
    TRY(weather_write(s->history, path));
    warn_about_longwave(s->history, path);
out:
    scene_free(s);
    return rc;
}

int command_weather(int argc, char **argv)
{
    command_settings settings = {0};
    const char *path = NULL;
    option list[] = {
        {"output", 'o', "FILE.wth", "the file to write", .text = &path, .is_required = true},
        command_set_option(&settings)};
    const option_table table = {command, "SCENE", 1, 1, purpose, list, sizeof list / sizeof *list};
    int code = option_table_read(&table, argc, argv, NULL);

    if (code == OPTION_TABLE_DONE) code = program_end(command, run(argv[1], &settings, path));
    command_settings_free(&settings);
    return code;
}
