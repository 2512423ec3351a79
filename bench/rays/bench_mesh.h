/* Meshes that the ray bench traces: the airport, terrains of any size, the inside of a hall. */
#ifndef BENCH_MESH_H
#define BENCH_MESH_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct bench_mesh {
    char name[32];
    uint32_t facet_count, vertex_count;
    uint32_t (*corner)[4];           /* shape (facet_count), as bvh_build takes them */
    float (*position)[3];            /* shape (vertex_count), m */
    uint32_t (*triangle)[3], *facet; /* shape (triangle_count): the same, quads cut as bvh.c does */
    uint32_t triangle_count;
    float reach_m; /* random rays begin and end within this of the middle; 0: anywhere in the box */
    float eye[3], target[3]; /* of the camera of the primary rays, 45 degrees wide */
} bench_mesh;

/* Makes a mesh by its name: `airport` (scenes/airport/airport.gdb), `terrain-N` with about N
 * triangles, `hall`: a closed room full of shelves and columns, `walls`: 20 km long. Fails with
 * STATUS_ARGUMENT for any other name, and where the airport cannot be read. */
status bench_mesh_make(bench_mesh **out, const char *name);
void bench_mesh_free(bench_mesh *mesh);

#endif
