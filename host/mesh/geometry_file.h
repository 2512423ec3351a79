/* Geometry file: the facets of a scene as AutoCAD's export left them. Thesis 2.5.1, Appendix A
 * item 3 (.gdb). */
#ifndef GEOMETRY_FILE_H
#define GEOMETRY_FILE_H

#include "base/status.h"
#include "files/record_file.h"

#include <stdint.h>

typedef struct geometry_object {
    const char *name;
    int id[3]; /* object, 0, 0 */
} geometry_object;

typedef struct geometry_part {
    const char *name;
    int id[3];       /* object, part, 0 */
    uint32_t object; /* index of its object */
} geometry_part;

/* Polygon `i` of the file is facet i. */
typedef struct geometry_facet {
    const char *name, *material_name, *attribute;
    const char *unused[3]; /* three fields; "null" in the sample */
    int id[3];             /* object, part, face */
    uint32_t part;         /* index of its part */
    int material_code;
    double stated_temperature_k; /* 0: to be computed */
    double thickness_m;
    double power_w_m2;   /* self-generated */
    double shape_factor; /* default, 0..1 */
    uint32_t first_vertex, vertex_count;
    double normal[3];   /* as printed, ENU, outward; its length is the area in m2 */
    double slope_deg;   /* as printed: 0 level and facing up, 180 facing down */
    double azimuth_deg; /* as printed: clockwise from north */
    double last_number; /* as printed: 0 facing down and 0.25 on a wall in the sample; not used */
} geometry_facet;

/* Facets stand in the order of their parts, parts in the order of their objects. */
typedef struct geometry_file {
    uint32_t object_count, part_count, facet_count, vertex_count;
    geometry_object *objects;
    geometry_part *parts;
    geometry_facet *facets;
    double *position_m;  /* shape (vertex_count, 3), ENU; counterclockwise seen from outside */
    record_file *source; /* holds the texts of what was read; NULL for what others built */
} geometry_file;

/* Reads a .gdb file; turns positions from the axes of 1994 (+x north, +y west) to ENU and each
 * polygon so that its right-hand normal is the printed one. Printed normals more than 5 degrees off
 * the polygon's plane are a warning with their count and first line. Polygons without area are
 * kept.
 */
status geometry_file_read(geometry_file **out, const char *path);

/* Writes the same layout: axes of 1994, clockwise seen from outside. The old file stays if writing
 * fails. */
status geometry_file_write(const geometry_file *geometry, const char *path);

/* Frees arrays and source; texts of what others built stay theirs. */
void geometry_file_free(geometry_file *geometry);

#endif
