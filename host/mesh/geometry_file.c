#include "mesh/geometry_file.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/number.h"
#include "base/vector.h"
#include "files/output_file.h"
#include "kernels/constants.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define KELVIN ((double)ZERO_CELSIUS_K)
#define CENTIMETRE 0.01 /* m */
#define LANGLEY_PER_HOUR ((double)LANGLEY_PER_HOUR_W_M2)
#define COMPUTED_C (-1.0)                 /* a default temperature that is none */
#define COS_TOLERANCE 0.99619469809174555 /* of 5 degrees */
#define AREA_TOLERANCE 1e-9               /* of the longest edge squared */
#define POSITION_LIMIT_M 1e7

enum { NULL_FIELDS = 3, VERTEX_LIMIT = 10000, FACET_LIMIT = 1 << 28 };

/* What reading needs beside the result: room in its arrays, and normals that are off. */
typedef struct reading {
    geometry_file *out;
    record_file *file;
    uint32_t objects, parts, facets, vertices; /* room */
    uint32_t off_count;
    int off_line;
} reading;

/* +x north, +y west to ENU. */
static void to_enu(const double in[3], double out[3])
{
    out[0] = -in[1];
    out[1] = in[0];
    out[2] = in[2];
}

static void to_1994(const double in[3], double out[3])
{
    out[0] = in[1];
    out[1] = -in[0];
    out[2] = in[2];
}

/* Makes room for `more` items after `count`. */
static status reserve(void *array, uint32_t *room, uint32_t count, uint32_t more, size_t item_size)
{
    status rc = STATUS_OK;
    uint32_t wanted = *room ? *room : 256;

    NEED(count <= FACET_LIMIT, STATUS_ARGUMENT, "more than %d facets or vertices", FACET_LIMIT);
    while (wanted < count + more) wanted *= 2;
    if (wanted == *room) return STATUS_OK;
    NEED(array_resize(array, wanted, item_size), STATUS_MEMORY,
         "no memory for %u facets or vertices", wanted);
    *room = wanted;
out:
    return rc;
}

/* Takes an id such as 1-2-3. */
static status read_id(record_file *file, int id[3])
{
    status rc = STATUS_OK;
    const char *text;
    int64_t number;

    TRY(record_file_text(file, &text, "an id such as 1-1-1"));
    for (int i = 0; i < 3; i++, text++) {
        const bool has_digit = *text >= '0' && *text <= '9';
        text = has_digit ? number_take_whole(text, 0, FACET_LIMIT, &number) : NULL;
        if (!text || *text != (i < 2 ? '-' : '\0')) {
            rc = record_file_reject(file, "an id such as 1-1-1");
            goto out;
        }
        id[i] = (int)number;
    }
out:
    return rc;
}

static status read_object(reading *r)
{
    status rc = STATUS_OK;
    geometry_file *g = r->out;

    TRY(reserve(&g->objects, &r->objects, g->object_count, 1, sizeof *g->objects));
    geometry_object *object = &g->objects[g->object_count];
    TRY(record_file_text(r->file, &object->name, "the object's name"));
    TRY(read_id(r->file, object->id));
    g->object_count++;
out:
    return rc;
}

static status read_part(reading *r)
{
    status rc = STATUS_OK;
    geometry_file *g = r->out;

    if (g->object_count == 0) return record_file_reject(r->file, "OBJECT before the first PART");
    TRY(reserve(&g->parts, &r->parts, g->part_count, 1, sizeof *g->parts));
    geometry_part *part = &g->parts[g->part_count];
    part->object = g->object_count - 1;
    TRY(record_file_text(r->file, &part->name, "the part's name"));
    TRY(read_id(r->file, part->id));
    if (part->id[0] != g->objects[part->object].id[0])
        rc = record_file_reject(r->file, "an id of object %d", g->objects[part->object].id[0]);
    g->part_count++;
out:
    return rc;
}

static status read_facet_identity(geometry_facet *f, reading *r)
{
    status rc = STATUS_OK;
    const geometry_part *part = &r->out->parts[f->part];
    long code;

    TRY(record_file_text(r->file, &f->name, "the face's name"));
    TRY(read_id(r->file, f->id));
    if (f->id[0] != part->id[0] || f->id[1] != part->id[1]) {
        rc = record_file_reject(r->file, "an id of part %d-%d", part->id[0], part->id[1]);
        goto out;
    }
    TRY(record_file_text(r->file, &f->material_name, "a material's name"));
    TRY(record_file_count(r->file, 0, 1 << 24, &code, "a material's code"));
    f->material_code = (int)code;
    TRY(record_file_text(r->file, &f->attribute, "an attribute's name"));
out:
    return rc;
}

static status read_facet_values(geometry_facet *f, record_file *file)
{
    status rc = STATUS_OK;
    double temperature_c, thickness_cm, power_ly_h;

    TRY(record_file_number(file, -200.0, 5700.0, &temperature_c,
                           "the default temperature in C, -1 to compute it,"));
    TRY(record_file_number(file, 1e-4, 1e6, &thickness_cm, "the thickness in cm"));
    TRY(record_file_number(file, -1e5, 1e5, &power_ly_h, "the self-generated power in ly/h"));
    TRY(record_file_number(file, 0.0, 1.0, &f->shape_factor, "the default shape factor"));
    for (int i = 0; i < NULL_FIELDS; i++)
        TRY(record_file_text(file, &f->unused[i], "a field that holds null"));
    f->stated_temperature_k = temperature_c == COMPUTED_C ? 0.0 : temperature_c + KELVIN;
    f->thickness_m = thickness_cm * CENTIMETRE;
    f->power_w_m2 = power_ly_h * LANGLEY_PER_HOUR;
out:
    return rc;
}

static status read_vertices(geometry_facet *f, reading *r)
{
    status rc = STATUS_OK;
    geometry_file *g = r->out;
    double point[3];
    long count;

    TRY(record_file_count(r->file, 3, VERTEX_LIMIT, &count, "the number of vertices"));
    f->first_vertex = g->vertex_count;
    f->vertex_count = (uint32_t)count;
    TRY(reserve(&g->position_m, &r->vertices, g->vertex_count, f->vertex_count,
                3 * sizeof *g->position_m));
    for (long i = 0; i < count; i++, g->vertex_count++) {
        TRY(record_file_numbers(r->file, 3, point, "x, y and z of a vertex in m"));
        if (fabs(point[0]) > POSITION_LIMIT_M || fabs(point[1]) > POSITION_LIMIT_M ||
            fabs(point[2]) > POSITION_LIMIT_M) {
            rc = record_file_reject(r->file, "a vertex within %g m", POSITION_LIMIT_M);
            goto out;
        }
        to_enu(point, &g->position_m[3 * (size_t)g->vertex_count]);
    }
out:
    return rc;
}

static status read_orientation(geometry_facet *f, record_file *file)
{
    status rc = STATUS_OK;
    double normal[3];

    TRY(record_file_numbers(file, 3, normal, "the outward normal"));
    to_enu(normal, f->normal);
    TRY(record_file_number(file, 0.0, 180.0, &f->slope_deg, "the slope in degrees"));
    TRY(record_file_number(file, 0.0, 360.0, &f->azimuth_deg, "the azimuth in degrees"));
    TRY(record_file_numbers(file, 1, &f->last_number, "the number that ends a face"));
out:
    return rc;
}

/* Sets the right-hand normal of a polygon (Newell; its length is the area) and returns the square
 * of its longest edge. */
static double polygon_normal(const double *position, uint32_t count, double out[3])
{
    double longest = 0.0;

    memset(out, 0, 3 * sizeof *out);
    for (uint32_t i = 0; i < count; i++) {
        const double *a = &position[3 * (size_t)i], *b = &position[3 * (size_t)((i + 1) % count)];
        const double edge[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const double from[3] = {a[0] - position[0], a[1] - position[1], a[2] - position[2]};
        out[0] += 0.5 * (from[1] * edge[2] - from[2] * edge[1]);
        out[1] += 0.5 * (from[2] * edge[0] - from[0] * edge[2]);
        out[2] += 0.5 * (from[0] * edge[1] - from[1] * edge[0]);
        longest = fmax(longest, vector_dot(edge, edge));
    }
    return longest;
}

/* Turns the polygon around its first vertex. */
static void reverse(double *position, uint32_t count)
{
    for (uint32_t i = 1, j = count - 1; i < j; i++, j--)
        for (int axis = 0; axis < 3; axis++) {
            const double kept = position[3 * (size_t)i + (size_t)axis];
            position[3 * (size_t)i + (size_t)axis] = position[3 * (size_t)j + (size_t)axis];
            position[3 * (size_t)j + (size_t)axis] = kept;
        }
}

/* The printed normal decides which side is out; without one, clockwise seen from outside does. */
static void turn_outward(reading *r, const geometry_facet *f, int normal_line)
{
    double *position = &r->out->position_m[3 * (size_t)f->first_vertex], normal[3];
    const double longest = polygon_normal(position, f->vertex_count, normal);
    const double area = vector_length(normal), printed = vector_length(f->normal);
    const double along = vector_dot(normal, f->normal);

    if (area <= AREA_TOLERANCE * longest || along <= 0.0) reverse(position, f->vertex_count);
    if (area <= AREA_TOLERANCE * longest) return;
    if (printed > 0.0 && fabs(along) >= COS_TOLERANCE * area * printed) return;
    if (r->off_count++ == 0) r->off_line = normal_line;
}

static status read_facet(reading *r)
{
    status rc = STATUS_OK;
    geometry_file *g = r->out;

    if (g->part_count == 0 || g->parts[g->part_count - 1].object != g->object_count - 1)
        return record_file_reject(r->file, "PART before the first FACE of an object");
    TRY(reserve(&g->facets, &r->facets, g->facet_count, 1, sizeof *g->facets));
    geometry_facet *f = &g->facets[g->facet_count];
    f->part = g->part_count - 1;
    TRY(read_facet_identity(f, r));
    TRY(read_facet_values(f, r->file));
    TRY(read_vertices(f, r));
    const int normal_line = record_file_line(r->file) + 1;
    TRY(read_orientation(f, r->file));
    turn_outward(r, f, normal_line);
    g->facet_count++;
out:
    return rc;
}

static status read_block(reading *r)
{
    status rc = STATUS_OK;
    const char *keyword;

    TRY(record_file_text(r->file, &keyword, "OBJECT, PART or FACE"));
    if (strcmp(keyword, "FACE") == 0)
        rc = read_facet(r);
    else if (strcmp(keyword, "PART") == 0)
        rc = read_part(r);
    else if (strcmp(keyword, "OBJECT") == 0)
        rc = read_object(r);
    else
        rc = record_file_reject(r->file, "OBJECT, PART or FACE");
out:
    return rc;
}

status geometry_file_read(geometry_file **out, const char *path)
{
    status rc = STATUS_OK;
    reading r = {0};

    r.out = calloc(1, sizeof *r.out);
    NEED(r.out, STATUS_MEMORY, "no memory for a geometry");
    TRY(record_file_open(&r.file, path));
    r.out->source = r.file;
    do {
        TRY(interrupt_check());
        TRY(read_block(&r));
    } while (!record_file_at_end(r.file));
    NEED(r.out->facet_count > 0, STATUS_FORMAT, "%s:%d: the file ends, expected FACE", path,
         record_file_line(r.file) + 1);
    if (r.off_count)
        status_warn(
            "%s:%d: here the printed normal is more than 5 degrees off its polygon's plane; "
            "faces like that: %u",
            path, r.off_line, r.off_count);
    *out = r.out;
    r.out = NULL;
out:
    geometry_file_free(r.out);
    return rc;
}

static void write_polygon(FILE *stream, const geometry_file *g, const geometry_facet *f)
{
    double point[3];

    fprintf(stream, "%u\n", f->vertex_count);
    for (uint32_t i = 0; i < f->vertex_count; i++) {
        const uint32_t backwards = i ? f->vertex_count - i : 0;
        to_1994(&g->position_m[3 * (size_t)(f->first_vertex + backwards)], point);
        fprintf(stream, "%.9e %.9e %.9e\n", point[0], point[1], point[2]);
    }
    to_1994(f->normal, point);
    fprintf(stream, "%.20e %.20e %.20e\n", point[0], point[1], point[2]);
    fprintf(stream, "%.6e\n%.6e\n%.6e\n", f->slope_deg, f->azimuth_deg, f->last_number);
}

static void write_facet(FILE *stream, const geometry_file *g, const geometry_facet *f)
{
    const double temperature_c =
        f->stated_temperature_k > 0.0 ? f->stated_temperature_k - KELVIN : COMPUTED_C;

    fprintf(stream, "FACE\n%s\n%d-%d-%d\n", f->name, f->id[0], f->id[1], f->id[2]);
    fprintf(stream, "%s\n%d\n%s\n", f->material_name, f->material_code, f->attribute);
    fprintf(stream, "%.10g\n%.10g\n%.10g\n%.10g\n", temperature_c, f->thickness_m / CENTIMETRE,
            f->power_w_m2 / LANGLEY_PER_HOUR, f->shape_factor);
    fprintf(stream, "%s\n%s\n%s\n", f->unused[0], f->unused[1], f->unused[2]);
    write_polygon(stream, g, f);
}

/* Facets stand in the order of their parts, parts in the order of their objects. */
static void write_all(FILE *stream, const geometry_file *g)
{
    uint32_t part = 0, facet = 0;

    for (uint32_t object = 0; object < g->object_count; object++) {
        const geometry_object *o = &g->objects[object];
        fprintf(stream, "OBJECT\n%s\n%d-%d-%d\n", o->name, o->id[0], o->id[1], o->id[2]);
        for (; part < g->part_count && g->parts[part].object == object; part++) {
            const geometry_part *p = &g->parts[part];
            fprintf(stream, "PART\n%s\n%d-%d-%d\n", p->name, p->id[0], p->id[1], p->id[2]);
            for (; facet < g->facet_count && g->facets[facet].part == part; facet++)
                write_facet(stream, g, &g->facets[facet]);
        }
    }
}

status geometry_file_write(const geometry_file *geometry, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    write_all(output_file_stream(file), geometry);
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

void geometry_file_free(geometry_file *geometry)
{
    if (!geometry) return;
    free(geometry->objects);
    free(geometry->parts);
    free(geometry->facets);
    free(geometry->position_m);
    record_file_free(geometry->source);
    free(geometry);
}
