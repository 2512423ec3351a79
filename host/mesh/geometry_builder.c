#include "mesh/geometry_builder.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/name_table.h"
#include "base/utf8_text.h"
#include "mesh/facet_shape.h"
#include "mesh/polygon.h"
#include "meshio/mesh_connect.h"

#include <stdlib.h>
#include <string.h>

/* Corners of all facets, and facets that know their neighbours by a signed number. */
enum { VERTEX_LIMIT = 1 << 30, FACET_LIMIT = 1 << 28 };

struct geometry_builder {
    geometry *g;
    name_table *objects;   /* by the first object of their file */
    name_table *parts;     /* by object */
    name_table *materials; /* by code */
    double (*position)[3]; /* shape (vertex_capacity) */
    uint32_t vertex_capacity, facet_capacity, face_count;
    uint32_t file_object, file_part; /* the first object and part of the present file */
    uint32_t last_part, last_material;
};

status geometry_builder_open(geometry_builder **out)
{
    status rc = STATUS_OK;
    geometry_builder *builder = calloc(1, sizeof *builder);

    NEED(builder, STATUS_MEMORY, "no memory for the geometry");
    builder->g = calloc(1, sizeof *builder->g);
    NEED(builder->g, STATUS_MEMORY, "no memory for the geometry");
    TRY(name_table_open(&builder->objects));
    TRY(name_table_open(&builder->parts));
    TRY(name_table_open(&builder->materials));
    *out = builder;
    builder = NULL;
out:
    geometry_builder_free(builder);
    return rc;
}

void geometry_builder_free(geometry_builder *builder)
{
    if (!builder) return;
    geometry_free(builder->g);
    name_table_free(builder->materials);
    name_table_free(builder->parts);
    name_table_free(builder->objects);
    free(builder->position);
    free(builder);
}

uint32_t geometry_builder_vertex_count(const geometry_builder *builder)
{
    return builder->g->vertex_count;
}

uint32_t geometry_builder_face_count(const geometry_builder *builder)
{
    return builder->face_count;
}

status geometry_builder_add_vertices(geometry_builder *builder, uint32_t count,
                                     double (**out_position)[3])
{
    status rc = STATUS_OK;
    geometry *g = builder->g;

    NEED(count <= VERTEX_LIMIT - g->vertex_count, STATUS_ARGUMENT,
         "more than %d vertices in the scene", VERTEX_LIMIT);
    NEED(array_resize(&builder->position, (size_t)g->vertex_count + count + 1,
                      sizeof *builder->position),
         STATUS_MEMORY, "no memory for %u vertices", g->vertex_count + count);
    *out_position = builder->position + g->vertex_count;
    g->vertex_count += count;
    builder->file_object = g->object_count;
    builder->file_part = g->part_count;
out:
    return rc;
}

static status reserve_facets(geometry_builder *builder, uint32_t count)
{
    status rc = STATUS_OK;
    geometry *g = builder->g;
    uint32_t room = builder->facet_capacity ? builder->facet_capacity : 1024;

    NEED(count <= FACET_LIMIT - g->facet_count, STATUS_ARGUMENT, "more than %d facets in the scene",
         FACET_LIMIT);
    if (g->facet_count + count <= builder->facet_capacity) return STATUS_OK;
    while (room < g->facet_count + count) room *= 2;
    NEED(array_resize(&g->corner, room, sizeof *g->corner) &&
             array_resize(&g->facet_id, room, sizeof *g->facet_id) &&
             array_resize(&g->part, room, sizeof *g->part) &&
             array_resize(&g->material, room, sizeof *g->material) &&
             array_resize(&g->thickness_m, room, sizeof *g->thickness_m) &&
             array_resize(&g->power_w_m2, room, sizeof *g->power_w_m2) &&
             array_resize(&g->stated_temperature_k, room, sizeof *g->stated_temperature_k),
         STATUS_MEMORY, "no memory for %u facets", room);
    builder->facet_capacity = room;
out:
    return rc;
}

static status add_name(char ***names, uint32_t *count, const char *name)
{
    status rc = STATUS_OK;

    NEED(array_add(names, *count, sizeof **names), STATUS_MEMORY, "no memory for names");
    (*names)[*count] = utf8_text_copy(name);
    NEED((*names)[*count], STATUS_MEMORY, "no memory for names");
    ++*count;
out:
    return rc;
}

static int is_part(const geometry *g, uint32_t part, const geometry_source_face *face)
{
    return !strcmp(g->part_name[part], face->part) &&
           !strcmp(g->object_name[g->part_object[part]], face->object);
}

/* Adds an object of a file. */
static status add_object(geometry *g, const char *name, const char *path)
{
    status rc = STATUS_OK;

    NEED(array_add(&g->object_path, g->object_count, sizeof *g->object_path), STATUS_MEMORY,
         "no memory for objects");
    g->object_path[g->object_count] = path;
    TRY(add_name(&g->object_name, &g->object_count, name));
out:
    return rc;
}

static status find_part(geometry_builder *builder, const geometry_source_face *face,
                        const char *path)
{
    status rc = STATUS_OK;
    geometry *g = builder->g;
    uint32_t object;

    if (g->part_count > builder->file_part && is_part(g, builder->last_part, face))
        return STATUS_OK;
    TRY(name_table_number(builder->objects, builder->file_object, face->object, &object));
    if (object == g->object_count) TRY(add_object(g, face->object, path));
    TRY(name_table_number(builder->parts, object, face->part, &builder->last_part));
    if (builder->last_part < g->part_count) return STATUS_OK;
    NEED(array_add(&g->part_object, g->part_count, sizeof *g->part_object), STATUS_MEMORY,
         "no memory for parts");
    g->part_object[g->part_count] = object;
    TRY(add_name(&g->part_name, &g->part_count, face->part));
out:
    return rc;
}

static int is_material(const geometry_material *material, const geometry_source_face *face)
{
    return material->code == face->material_code && !strcmp(material->name, face->material);
}

static status find_material(geometry_builder *builder, const geometry_source_face *face,
                            const char *path)
{
    status rc = STATUS_OK;
    geometry *g = builder->g;
    geometry_material *added;

    if (g->material_count && is_material(&g->materials[builder->last_material], face))
        return STATUS_OK;
    TRY(name_table_number(builder->materials, (uint32_t)face->material_code, face->material,
                          &builder->last_material));
    if (builder->last_material < g->material_count) return STATUS_OK;
    NEED(array_add(&g->materials, g->material_count, sizeof *g->materials), STATUS_MEMORY,
         "no memory for materials");
    added = &g->materials[g->material_count];
    *added = (geometry_material){utf8_text_copy(face->material), face->material_code,
                                 g->facet_count, path};
    NEED(added->name, STATUS_MEMORY, "no memory for materials");
    g->material_count++;
out:
    return rc;
}

static void add_facet(geometry_builder *builder, const geometry_source_face *face,
                      const uint32_t *corner, uint32_t corner_count)
{
    geometry *g = builder->g;
    const uint32_t i = g->facet_count++;

    for (uint32_t k = 0; k < 4; k++) g->corner[i][k] = k < corner_count ? corner[k] : UINT32_MAX;
    g->facet_id[i] = builder->face_count;
    g->part[i] = builder->last_part;
    g->material[i] = builder->last_material;
    g->thickness_m[i] = (float)face->thickness_m;
    g->power_w_m2[i] = (float)face->power_w_m2;
    g->stated_temperature_k[i] = (float)face->stated_temperature_k;
}

static status add_polygon(geometry_builder *builder, const geometry_source_face *face,
                          const uint32_t *corner)
{
    status rc = STATUS_OK;
    uint32_t(*triangle)[3] = malloc((face->corner_count - 2) * sizeof *triangle);

    NEED(triangle, STATUS_MEMORY, "no memory for a polygon");
    TRY(reserve_facets(builder, face->corner_count - 2));
    TRY(polygon_split(face->corner_count, corner, (const double(*)[3])builder->position, triangle));
    for (uint32_t i = 0; i < face->corner_count - 2; i++) add_facet(builder, face, triangle[i], 3);
out:
    free(triangle);
    return rc;
}

status geometry_builder_add_face(geometry_builder *builder, const geometry_source_face *face,
                                 uint32_t first_vertex, const char *path)
{
    status rc = STATUS_OK;
    uint32_t few[4], *corner = few;

    TRY(interrupt_check());
    TRY(find_part(builder, face, path));
    TRY(find_material(builder, face, path));
    if (face->corner_count > 4) corner = malloc(face->corner_count * sizeof *corner);
    NEED(corner, STATUS_MEMORY, "no memory for a polygon");
    for (uint32_t k = 0; k < face->corner_count; k++) corner[k] = first_vertex + face->corner[k];
    TRY(reserve_facets(builder, 1));
    if (face->corner_count > 4)
        TRY(add_polygon(builder, face, corner));
    else
        add_facet(builder, face, corner, face->corner_count);
    builder->face_count++;
out:
    if (corner != few) free(corner);
    return rc;
}

/* Corners of all facets in a row, as meshio takes them: first[i] .. first[i + 1]. */
static status connect(geometry_builder *builder)
{
    status rc = STATUS_OK;
    geometry *g = builder->g;
    char message[512];
    mesh_connection *connection = NULL;
    uint32_t *first = malloc((g->facet_count + 1) * sizeof *first);
    uint32_t *corner = malloc((4 * (size_t)g->facet_count + 1) * sizeof *corner);
    uint32_t used = 0;

    g->neighbour = malloc((g->facet_count + 1) * sizeof *g->neighbour);
    NEED(first && corner && g->neighbour, STATUS_MEMORY, "no memory for the facets' neighbours");
    for (uint32_t i = 0; i < g->facet_count; i++) {
        first[i] = used;
        for (int k = 0; k < 4 && g->corner[i][k] != UINT32_MAX; k++)
            corner[used++] = g->corner[i][k];
    }
    first[g->facet_count] = used;
    const int failed =
        mesh_connect(&connection, g->vertex_count, (const double(*)[3])builder->position,
                     g->facet_count, first, corner, message, sizeof message);
    TRY(interrupt_check());
    NEED(!failed, STATUS_MEMORY, "no memory for %s", message);
    for (uint32_t i = 0; i < g->facet_count; i++)
        for (uint32_t k = 0; k < 4; k++)
            g->neighbour[i][k] =
                k < first[i + 1] - first[i] ? connection->neighbour[first[i] + k] : -1;
    g->non_finite_count = connection->non_finite_count;
    g->degenerate_count = connection->degenerate_count;
    g->duplicate_count = connection->duplicate_count;
    g->non_manifold_count = connection->non_manifold_count;
out:
    mesh_connect_free(connection);
    free(first);
    free(corner);
    return rc;
}

status geometry_builder_finish(geometry_builder *builder, geometry **out)
{
    status rc = STATUS_OK;

    TRY(connect(builder));
    TRY(facet_shape_set(builder->g, (const double(*)[3])builder->position));
    *out = builder->g;
    builder->g = NULL;
out:
    return rc;
}
