/* Geometry builder: collects the faces of all files and turns them into facets. */
#ifndef GEOMETRY_BUILDER_H
#define GEOMETRY_BUILDER_H

#include "mesh/geometry.h"
#include "mesh/geometry_source.h"

typedef struct geometry_builder geometry_builder;

status geometry_builder_open(geometry_builder **out);
void geometry_builder_free(geometry_builder *builder);

uint32_t geometry_builder_vertex_count(const geometry_builder *builder);
uint32_t geometry_builder_face_count(const geometry_builder *builder);

/* Begins a file: makes room for its `count` vertices; the caller fills out_position, ENU m, before
 * the next call. */
status geometry_builder_add_vertices(geometry_builder *builder, uint32_t count,
                                     double (**out_position)[3]);

/* Adds a face, cut into triangles if it has more than four corners; corners count from
 * first_vertex. A part is told apart by the names of part and object within one file. */
status geometry_builder_add_face(geometry_builder *builder, const geometry_source_face *face,
                                 uint32_t first_vertex, const char *path);

/* Moves everything into a geometry: local origin, float positions, normals, neighbours. */
status geometry_builder_finish(geometry_builder *builder, geometry **out);

#endif
