#include "command.h"
#include "command_scene.h"
#include "weather.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] = "usage: radsig weather SCENE -o FILE.wth [--set table.key=value]\n"
                           "\n"
                           "Writes the weather of a scene as a .wth history: one that it "
                           "synthesises, to be edited, or one\n"
                           "that it reads from a table of measurements.\n";

static const struct option options[] = {{"set", required_argument, NULL, 'S'},
                                        {"output", required_argument, NULL, 'o'},
                                        {"help", no_argument, NULL, 'h'},
                                        {NULL, 0, NULL, 0}};

/* Returns 0, -1 where help is asked for, or the exit code of a misuse. */
static int take_arguments(command_settings *settings, const char **out_scene, const char **out_path,
                          int argc, char **argv)
{
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, ":o:", options, NULL)) != -1) {
        if (option == 'h') return -1;
        if (option == '?')
            return command_misuse("weather", "unknown option '%s'", argv[optind - 1]);
        if (option == ':') return command_misuse("weather", "%s needs a value", argv[optind - 1]);
        if (option == 'o')
            *out_path = optarg;
        else if (!strchr(optarg, '=') || !command_settings_add(settings, "", optarg))
            return command_misuse("weather", "'%s' is no value for --set", optarg);
    }
    if (optind + 1 != argc) return command_misuse("weather", "needs one scene");
    if (!*out_path) return command_misuse("weather", "needs -o FILE.wth");
    *out_scene = argv[optind];
    return 0;
}

/* A .wth has no column for it. */
static void warn_about_longwave(const weather *w, const char *path)
{
    size_t count = 0;

    for (size_t i = 0; i < w->count; i++) count += w->record[i].longwave_w_m2 > 0.0;
    if (count > 0)
        status_warn("%s: leaves out the measured longwave of %zu records: who reads it takes the "
                    "sky's from the air",
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
    command_settings *settings = calloc(1, sizeof *settings);
    const char *scene_path = NULL, *path = NULL;
    int code;

    if (!settings) return command_end("weather", status_set(STATUS_MEMORY, "no memory"));
    code = take_arguments(settings, &scene_path, &path, argc, argv);
    if (code < 0) fputs(help, stdout);
    if (code == 0) code = command_end("weather", run(scene_path, settings, path));
    free(settings);
    return code < 0 ? 0 : code;
}
