/* Which face lies beyond each edge of a face: needed for lateral conduction, and what is wrong with
 * a polygon soup. Thesis 2.3. */
#ifndef MESHIO_MESH_CONNECT_H
#define MESHIO_MESH_CONNECT_H

#include <stddef.h>
#include <stdint.h>

/* A face is counted once, under the first that fits, and then has no neighbours.
 *   non-finite     a nan or inf coordinate
 *   degenerate     fewer than three distinct vertices, or no area beyond rounding
 *   duplicate      the same vertices as an earlier face, in any order, and facing as one of these does
 *   reversed       the same vertices as an earlier face, facing the other way: the back of a sheet
 *   non-manifold   the third face at an edge, a face that disagrees with its neighbour on which
 *                  side is out, one that meets a vertex which earlier faces surround, or one that
 *                  comes back to a vertex */
typedef struct mesh_connection {
    int32_t *neighbour; /* shape (first[face_count]): [first[i] + k] is the face beyond the edge
                         * from corner k of face i to the next one, -1 at a border */
    uint32_t non_finite_count, degenerate_count, duplicate_count, reversed_count,
        non_manifold_count;
} mesh_connection;

/* Welds vertices whose coordinates are the same bits (-0 is 0) and finds the neighbours; faces keep
 * their numbers.
 *   position   shape (vertex_count), `first` and `corner` as in mesh_file
 * The caller releases *out with mesh_connect_free; on failure *out is left as it was.
 * Returns 0, or non-zero with a message: a corner that is no vertex, offsets that fall, no memory. */
int mesh_connect(mesh_connection **out, uint32_t vertex_count, const double (*position)[3],
                 uint32_t face_count, const uint32_t *first, const uint32_t *corner, char *message,
                 size_t message_size);

void mesh_connect_free(mesh_connection *connection);

#endif
