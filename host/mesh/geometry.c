#include "mesh/geometry.h"

#include "mesh/geometry_builder.h"
#include "mesh/geometry_source.h"
#include "meshio/mesh_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Face ids are written to float planes, which hold whole numbers up to here. */
enum { FACET_ID_LIMIT = 1 << 24 };

/* Where an instance puts a vertex: scale and rotation as a matrix, then the translation. */
typedef struct placement {
    double matrix[3][3], translate_m[3];
} placement;

static void rotate_rows(double m[3][3], int row, double angle_rad)
{
    const int next = (row + 1) % 3;

    for (int column = 0; column < 3; column++) {
        const double a = m[row][column], b = m[next][column];
        m[row][column] = cos(angle_rad) * a - sin(angle_rad) * b;
        m[next][column] = sin(angle_rad) * a + cos(angle_rad) * b;
    }
}

static placement place_instance(const geometry_instance *instance)
{
    placement p = {{{instance->scale, 0, 0}, {0, instance->scale, 0}, {0, 0, instance->scale}},
                   {instance->translate_m[0], instance->translate_m[1], instance->translate_m[2]}};

    /* About x the rows y and z turn, about y the rows z and x, about z the rows x and y. */
    for (int axis = 0; axis < 3; axis++)
        if (instance->rotate_deg[axis] != 0.0)
            rotate_rows(p.matrix, (axis + 1) % 3, instance->rotate_deg[axis] * M_PI / 180.0);
    return p;
}

static void place_vertex(const placement *p, const double in[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = p->matrix[k][0] * in[0] + p->matrix[k][1] * in[1] + p->matrix[k][2] * in[2] +
                 p->translate_m[k];
}

static status append_vertices(geometry_builder *builder, const geometry_source *source,
                              const geometry_instance *instance)
{
    status rc = STATUS_OK;
    const placement p = place_instance(instance);
    uint32_t count;
    const double(*position)[3] = geometry_source_positions(source, &count);
    double(*placed)[3];

    TRY(geometry_builder_add_vertices(builder, count, &placed));
    for (uint32_t i = 0; i < count; i++) {
        place_vertex(&p, position[i], placed[i]);
        for (int k = 0; k < 3; k++)
            NEED(!(isfinite(position[i][k]) && fabs(placed[i][k]) > MESH_FILE_LIMIT_M),
                 STATUS_FORMAT,
                 "%s: vertex %u comes to (%g, %g, %g) by scale, rotate_deg and translate_m, "
                 "expected "
                 "coordinates from -%g to %g m",
                 instance->path, i, placed[i][0], placed[i][1], placed[i][2], MESH_FILE_LIMIT_M,
                 MESH_FILE_LIMIT_M);
    }
out:
    return rc;
}

static status append_file(geometry_builder *builder, const geometry_instance *instance)
{
    status rc = STATUS_OK;
    geometry_source *source = NULL;
    const uint32_t first_vertex = geometry_builder_vertex_count(builder);

    TRY(geometry_source_read(&source, instance->path));
    TRY(append_vertices(builder, source, instance));
    NEED(geometry_builder_face_count(builder) + geometry_source_face_count(source) <=
             FACET_ID_LIMIT,
         STATUS_ARGUMENT, "%s: more than %d faces in the scene", instance->path, FACET_ID_LIMIT);
    for (uint32_t i = 0; i < geometry_source_face_count(source); i++) {
        geometry_source_face face = geometry_source_look(source, i);
        if (!*face.material) face.material = instance->material;
        NEED(face.material, STATUS_FORMAT,
             "%s: face %u names no material; state `material` in its [[geometry]]", instance->path,
             i);
        if (face.thickness_m == 0.0) face.thickness_m = instance->thickness_m;
        if (face.power_w_m2 == 0.0) face.power_w_m2 = instance->power_w_m2;
        TRY(geometry_builder_add_face(builder, &face, first_vertex, instance->path));
    }
out:
    geometry_source_free(source);
    return rc;
}

status geometry_read(geometry **out, const geometry_instance *instances, size_t instance_count)
{
    status rc = STATUS_OK, failure = STATUS_OK;
    geometry_builder *builder = NULL;

    TRY(geometry_builder_open(&builder));
    for (size_t i = 0; i < instance_count; i++) {
        rc = append_file(builder, &instances[i]);
        if (rc != STATUS_OK && failure == STATUS_OK) failure = rc;
        if (rc != STATUS_OK) status_keep(rc);
        if (rc == STATUS_MEMORY) break;
    }
    TRY(failure);
    TRY(geometry_builder_finish(builder, out));
out:
    geometry_builder_free(builder);
    return rc;
}

static void free_names(char **names, uint32_t count)
{
    for (uint32_t i = 0; names && i < count; i++) free(names[i]);
    free(names);
}

void geometry_free(geometry *g)
{
    if (!g) return;
    for (uint32_t i = 0; g->materials && i < g->material_count; i++) free(g->materials[i].name);
    free(g->materials);
    free(g->object_path);
    free_names(g->object_name, g->object_count);
    free_names(g->part_name, g->part_count);
    free(g->part_object);
    free(g->position);
    free(g->corner);
    free(g->facet_id);
    free(g->part);
    free(g->material);
    free(g->normal);
    free(g->area_m2);
    free(g->slope_rad);
    free(g->azimuth_rad);
    free(g->thickness_m);
    free(g->power_w_m2);
    free(g->stated_temperature_k);
    free(g->neighbour);
    free(g);
}
