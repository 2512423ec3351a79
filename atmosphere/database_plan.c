#include "database_plan.h"

#include "scene/scene_parts.h"

#include <stdlib.h>
#include <string.h>

static status set_path(scene *s, const char *path)
{
    const char *slash = strrchr(path, '/');

    s->path = strdup(path);
    s->folder = strndup(path, slash ? (size_t)(slash - path + 1) : 0);
    return s->path && s->folder ? STATUS_OK
                                : status_set(STATUS_MEMORY, "%s: no memory to read it", path);
}

static void read_name(scene_reader *reader)
{
    scene_table t = scene_table_open(reader, reader->root, "scene");
    const char *name = "";

    scene_table_name(&t, "name", "", "a name", &name);
    reader->s->name = strdup(name);
    if (!reader->s->name)
        scene_took(reader, status_set(STATUS_MEMORY, "no memory for the scene's name"));
}

static void read_parts(database_plan *g, scene_reader *reader)
{
    const toml_node *place = toml_node_get(reader->root, "site");
    const toml_node *node = toml_node_get(toml_node_get(reader->root, "atmosphere"), "generate");
    const char *ground_material = NULL;

    if (!place)
        scene_fail(reader, NULL,
                   "[site]: the table is missing: state latitude_deg, longitude_deg "
                   "and time, or node = a .snd file");
    if (!node)
        scene_fail(reader, NULL,
                   "[atmosphere.generate]: the table is missing: state model, wavenumber_cm1 and "
                   "wavenumber_step_cm1 at least");
    read_name(reader);
    scene_read_site(reader, &ground_material);
    scene_read_camera(reader);
    if (reader->failure_count > 0) return;
    atmosphere_plan_read(&g->plan, reader, node);
    if (g->plan.inversion_altitude_m <= 0.0) return;
    scene_read_weather(reader);
    if (reader->failure_count == 0 && !g->s->history)
        scene_fail(
            reader, NULL,
            "[weather]: the table is missing, inversion_altitude_m needs the hour's weather");
}

status database_plan_read(database_plan **out, const char *path)
{
    status rc = STATUS_OK;
    char message[2048];
    toml_file *file = NULL;
    scene_reader reader = {0};
    database_plan *g = calloc(1, sizeof *g);

    NEED(g, STATUS_MEMORY, "%s: no memory to read it", path);
    g->s = calloc(1, sizeof *g->s);
    NEED(g->s, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(set_path(g->s, path));
    NEED(toml_file_read(&file, path, NULL, 0, message, sizeof message) == 0, STATUS_FORMAT, "%s",
         message);
    reader.s = g->s;
    reader.root = toml_file_root(file);
    read_parts(g, &reader);
    if (reader.failure_count > 0) {
        rc = reader.ending ? reader.ending : STATUS_FORMAT;
        goto out;
    }
    *out = g;
    g = NULL;
out:
    toml_file_free(file);
    database_plan_free(g);
    return rc;
}

void database_plan_free(database_plan *g)
{
    if (!g) return;
    scene_free(g->s);
    free(g);
}
