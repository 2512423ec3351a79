/* Geometry: the facets of a scene, put together from mesh files. Thesis 2.3, 2.5.1. */
#ifndef GEOMETRY_H
#define GEOMETRY_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* A mesh file and where it stands in the scene. A vertex goes through scale, the rotations about
 * x, y and z in this order (right-handed), and the translation. */
typedef struct geometry_instance {
    const char *path; /* .obj .ply .stl .off .gdb */
    double translate_m[3];
    double rotate_deg[3];
    double scale;         /* above 0 */
    const char *material; /* for faces that name none; NULL: such faces are an error */
    double thickness_m;   /* for faces that state none; 0: not stated */
    double power_w_m2;    /* for faces that state none */
} geometry_instance;

/* Names of objects, parts and materials are UTF-8 whatever the file is in. A material as the files name it: .gdb by code and name, the others by name. */
typedef struct geometry_material {
    char *name;
    int code;             /* -1: not stated */
    uint32_t first_facet; /* the first facet of it */
    const char *path;     /* its file; belongs to the instance */
} geometry_material;

/* A facet has three or four corners; larger polygons are cut into triangles that share an id.
 * Corners run counterclockwise seen from outside. */
typedef struct geometry {
    uint32_t facet_count, vertex_count;
    double origin_m[3];    /* ENU; positions are relative to it */
    float (*position)[3];  /* shape (vertex_count), m */
    uint32_t (*corner)[4]; /* shape (facet_count), indices of vertices; fourth UINT32_MAX: none */
    uint32_t *facet_id;    /* face number in its file, counted on over all files in order */
    uint32_t *part;        /* index of the part */
    uint32_t *material;    /* index of the geometry_material */
    float (*normal)[3];    /* unit, outward; 0 for a facet without area */
    float *area_m2, *slope_rad, *azimuth_rad; /* azimuth clockwise from north, 0..2 pi */
    float *thickness_m;                       /* 0: not stated */
    float *power_w_m2;
    float *stated_temperature_k; /* 0: to be computed */
    int32_t (*neighbour)[4];     /* facet beyond the edge from corner k to the next, -1: none */

    uint32_t object_count, part_count, material_count;
    char **object_name;       /* shape (object_count) */
    const char **object_path; /* shape (object_count): their files; belong to the instances */
    char **part_name;         /* shape (part_count) */
    uint32_t *part_object;    /* index of the part's object */
    geometry_material *materials;
    float low[3], high[3]; /* box of the finite positions, relative to the origin */
    uint32_t non_manifold_count, degenerate_count, duplicate_count, non_finite_count;
} geometry;

/* Reads the files and builds the facets. Paths and texts of the instances must outlive the
 * geometry. Every file that cannot be read adds its message; the first failure is returned. Fails
 * with STATUS_ARGUMENT beyond 2^24 faces, whose ids no float plane can hold. */
status geometry_read(geometry **out, const geometry_instance *instances, size_t instance_count);
void geometry_free(geometry *g);

#endif
