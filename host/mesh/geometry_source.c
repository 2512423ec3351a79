#include "mesh/geometry_source.h"

#include "base/interrupt.h"
#include "files/file_name.h"
#include "mesh/geometry_file.h"
#include "meshio/cancel.h"
#include "meshio/mesh_file.h"

#include <stdlib.h>
#include <string.h>

struct geometry_source {
    geometry_file *file;    /* of a .gdb */
    uint32_t *file_corners; /* 0, 1, 2, ...: its polygons share no vertices */
    mesh_file *mesh;        /* of all others */
};

static status read_geometry_file(geometry_source *source, const char *path)
{
    status rc = STATUS_OK;

    TRY(geometry_file_read(&source->file, path));
    source->file_corners = malloc((source->file->vertex_count + 1) * sizeof(uint32_t));
    NEED(source->file_corners, STATUS_MEMORY, "%s: no memory to read it", path);
    for (uint32_t i = 0; i < source->file->vertex_count; i++) source->file_corners[i] = i;
out:
    return rc;
}

/* Warns line by line. */
static void warn_of(const char *path, const char *warnings)
{
    for (const char *line = warnings; *line;) {
        const size_t length = strcspn(line, "\n");
        status_warn("%s: %.*s", path, (int)length, line);
        line += length + (line[length] == '\n');
    }
}

static status read_mesh(geometry_source *source, const char *path)
{
    status rc = STATUS_OK;
    char message[1024];

    cancel_ask(interrupt_is_set);
    const int failed = mesh_file_read(&source->mesh, path, message, sizeof message);
    TRY(interrupt_check());
    NEED(!failed, STATUS_FORMAT, "%s", message);
    warn_of(path, source->mesh->warnings);
out:
    return rc;
}

status geometry_source_read(geometry_source **out, const char *path)
{
    status rc = STATUS_OK;
    geometry_source *source = calloc(1, sizeof *source);

    NEED(source, STATUS_MEMORY, "%s: no memory to read it", path);
    if (file_name_ends(path, ".gdb"))
        TRY(read_geometry_file(source, path));
    else
        TRY(read_mesh(source, path));
    *out = source;
    source = NULL;
out:
    geometry_source_free(source);
    return rc;
}

void geometry_source_free(geometry_source *source)
{
    if (!source) return;
    geometry_file_free(source->file);
    mesh_file_free(source->mesh);
    free(source->file_corners);
    free(source);
}

uint32_t geometry_source_face_count(const geometry_source *source)
{
    return source->file ? source->file->facet_count : source->mesh->face_count;
}

static geometry_source_face look_file(const geometry_source *source, uint32_t face)
{
    const geometry_file *file = source->file;
    const geometry_facet *facet = &file->facets[face];
    const geometry_part *part = &file->parts[facet->part];

    return (geometry_source_face){
        .corner_count = facet->vertex_count,
        .corner = source->file_corners + facet->first_vertex,
        .object = file->objects[part->object].name,
        .part = part->name,
        .material = facet->material_name,
        .material_code = facet->material_code,
        .thickness_m = facet->thickness_m,
        .power_w_m2 = facet->power_w_m2,
        .stated_temperature_k = facet->stated_temperature_k,
    };
}

static geometry_source_face look_mesh(const geometry_source *source, uint32_t face)
{
    const mesh_file *mesh = source->mesh;

    return (geometry_source_face){
        .corner_count = mesh->first[face + 1] - mesh->first[face],
        .corner = mesh->corner + mesh->first[face],
        .object = mesh->object_name[mesh->object[face]],
        .part = mesh->part_name[mesh->part[face]],
        .material = mesh->material_name[mesh->material[face]],
        .material_code = -1,
        .thickness_m = mesh->thickness_cm ? .01 * (double)mesh->thickness_cm[face] : 0.0,
    };
}

geometry_source_face geometry_source_look(const geometry_source *source, uint32_t face)
{
    return source->file ? look_file(source, face) : look_mesh(source, face);
}

const double (*geometry_source_positions(const geometry_source *source, uint32_t *out_count))[3]
{
    if (source->mesh) {
        *out_count = source->mesh->vertex_count;
        return (const double(*)[3])source->mesh->position;
    }
    *out_count = source->file->vertex_count;
    return (const double(*)[3])source->file->position_m;
}
