/* Geometry source: the polygons of one file, whatever its format, as the geometry takes them. */
#ifndef GEOMETRY_SOURCE_H
#define GEOMETRY_SOURCE_H

#include "base/status.h"

#include <stdint.h>

typedef struct geometry_source geometry_source;

/* What a file says of one face; texts belong to the source. */
typedef struct geometry_source_face {
    uint32_t corner_count;
    const uint32_t *corner;               /* shape (corner_count) */
    const char *object, *part, *material; /* material "": not stated */
    int material_code;                    /* -1: not stated */
    double thickness_m;                   /* 0: not stated */
    double power_w_m2;                    /* 0: not stated */
    double stated_temperature_k;          /* 0: to be computed */
} geometry_source_face;

/* Reads .gdb through geometry_file and all else through meshio, whose warnings are told. */
status geometry_source_read(geometry_source **out, const char *path);
void geometry_source_free(geometry_source *source);

uint32_t geometry_source_face_count(const geometry_source *source);
geometry_source_face geometry_source_look(const geometry_source *source, uint32_t face);

/* shape (out_count), m */
const double (*geometry_source_positions(const geometry_source *source, uint32_t *out_count))[3];

#endif
