/* Polygon meshes read from .obj .ply .stl .off files, with the names that their faces carry.
 * Thesis 2.3. */
#ifndef MESHIO_MESH_FILE_H
#define MESHIO_MESH_FILE_H

#include <stddef.h>
#include <stdint.h>

/* No coordinate lies beyond, but for nan and inf: squares of areas must fit a float. */
#define MESH_FILE_LIMIT_M 1e9

/* A polygon soup: nothing is welded, split, turned or dropped, and face i is the file's face number
 * i counted from 0. Face i has the corners corner[first[i]] to corner[first[i + 1] - 1], at least
 * three, all of them below vertex_count. Coordinates are as in the file, in its unit; nan and inf
 * are kept. */
typedef struct mesh_file {
    uint32_t vertex_count;
    double (*position)[3]; /* shape (vertex_count) */
    uint32_t face_count;   /* at least 1 */
    uint32_t *first;       /* shape (face_count + 1) */
    uint32_t *corner;      /* shape (first[face_count]) */

    /* Shape (face_count), numbers of names: OBJ `o`, else the file's stem; OBJ `g`, else "part";
     * OBJ `usemtl` or the integer PLY face property `material` in decimal, else "". */
    uint32_t *object, *part, *material;
    float *thickness_cm; /* shape (face_count): PLY face property `thickness`; NULL without it */

    /* In the order of their first face; no name stands twice in a table. */
    uint32_t object_count, part_count, material_count;
    char **object_name, **part_name, **material_name;

    const char *warnings; /* what was odd, and what was left out: lines without the path; "" */
} mesh_file;

/* Reads the mesh at `path`; its extension, in any case, says which format. Time is linear in the
 * size of the file. The caller releases *out with mesh_file_free; on failure *out is left as it
 * was. Habits of writers that leave no
 * doubt are taken with a warning, as docs/file-formats.md lists them. Refused are coordinates beyond MESH_FILE_LIMIT_M and a thickness that is neither 0, not
 * stated, nor 1e-4 to 1e4 cm.
 * Returns 0, or non-zero with a message in `message`: `path:line: what stood there, what was
 * expected`, or `path: ...` where there is no line (binary files, no faces, no such file). */
int mesh_file_read(mesh_file **out, const char *path, char *message, size_t message_size);

void mesh_file_free(mesh_file *mesh);

#endif
