#include "scene/scene_parts.h"

#include <stdlib.h>
#include <string.h>

enum { INSTANCE_LIMIT = 100000 };

static bool read_instance(scene_reader *reader, const toml_node *node, geometry_instance *out)
{
    scene_table t = scene_table_open(reader, node, "geometry");
    double thickness_cm = 0.0;
    const int failures = reader->failure_count;

    *out = (geometry_instance){.scale = 1.0};
    scene_table_require(&t, "file", "a .obj .ply .stl .off or .gdb file");
    scene_table_file(&t, "file", &out->path);
    scene_table_numbers(&t, "translate_m", 3, -1e9, 1e9, out->translate_m);
    scene_table_numbers(&t, "rotate_deg", 3, -360.0, 360.0, out->rotate_deg);
    scene_table_number(&t, "scale", 1e-6, 1e6, &out->scale);
    scene_table_string(&t, "material", &out->material);
    scene_table_number(&t, "thickness_cm", 1e-4, 1e4, &thickness_cm);
    scene_table_number(&t, "power_w_m2", -1e6, 1e6, &out->power_w_m2);
    out->thickness_m = .01 * thickness_cm;
    scene_table_close(&t);
    return reader->failure_count == failures;
}

void scene_read_geometry(scene_reader *reader)
{
    const toml_node *list = toml_node_get(reader->root, "geometry");
    const size_t count = list && toml_node_kind(list) == TOML_ARRAY ? toml_node_count(list) : 0;
    geometry_instance *instances = NULL;
    size_t good = 0;

    if (count == 0 || count > INSTANCE_LIMIT) {
        scene_fail(reader, list,
                   "[[geometry]]: expected one to %d of them, each with file = a mesh",
                   INSTANCE_LIMIT);
        return;
    }
    instances = calloc(count, sizeof *instances);
    if (!instances) {
        scene_took(reader, status_set(STATUS_MEMORY, "no memory for %zu instances", count));
        return;
    }
    for (size_t i = 0; i < count; i++)
        if (read_instance(reader, toml_node_at(list, i), &instances[good])) good++;
    scene_took(reader, geometry_read(&reader->s->shape, instances, good));
    free(instances);
}
