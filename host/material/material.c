#include "material/material.h"

#include "base/utf8_text.h"
#include "files/record_file.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define CALORIE_J 4.184                                 /* thermochemical */
#define HEAT_J_KG_K (CALORIE_J * 1000.0)                /* of 1 cal/(g C) */
#define CONDUCTIVITY_W_M_K (CALORIE_J * 100.0 / 3600.0) /* of 1 cal/(cm h C) */
#define DENSITY_KG_M3 1000.0                            /* of 1 g/cm3 */

static bool has_control(const char *text)
{
    while (*text && !iscntrl((unsigned char)*text)) text++;
    return *text != '\0';
}

static status read_name(record_file *file, char *out, size_t size, const char *expected)
{
    status rc = STATUS_OK;
    const char *text;

    TRY(record_file_text(file, &text, expected));
    if (strlen(text) >= size)
        rc = record_file_reject(file, "%s of fewer than %zu letters", expected, size);
    else if (has_control(text))
        rc = record_file_reject(file, "%s without control characters", expected);
    else
        strcpy(out, text);
out:
    return rc;
}

/* Whatever the file is in, the name is UTF-8. */
static status set_utf8(char *name, size_t size, const record_file *file)
{
    status rc = STATUS_OK;
    char *copy = utf8_text_copy(name);

    NEED(copy, STATUS_MEMORY, "no memory for a material's name");
    if (strlen(copy) >= size)
        rc = record_file_reject(file, "a material's name of fewer than %zu bytes in UTF-8", size);
    else
        strcpy(name, copy);
out:
    free(copy);
    return rc;
}

static status read_identity(material *m, const material_library *before, record_file *file)
{
    status rc = STATUS_OK;
    long code;

    TRY(read_name(file, m->name, sizeof m->name, "a material's name"));
    TRY(set_utf8(m->name, sizeof m->name, file));
    if (material_by_name(before, m->name)) {
        rc = record_file_reject(file, "a name that no earlier material has");
        goto out;
    }
    TRY(record_file_count(file, 0, 1 << 24, &code, "a material's code"));
    m->code = (int)code;
    if (material_by_code(before, m->code))
        rc = record_file_reject(file, "a code that no earlier material has");
out:
    return rc;
}

static status read_material(material *m, const material_library *before, record_file *file)
{
    status rc = STATUS_OK;
    double heat, conductivity, density;

    TRY(read_identity(m, before, file));
    TRY(record_file_number(file, .001, 10.0, &heat, "the specific heat in cal/g/C"));
    TRY(record_file_number(file, 0.0, 3e4, &conductivity, "the conductivity in cal/(cm h C)"));
    TRY(record_file_number(file, 1e-6, 25.0, &density, "the density in g/cm3"));
    TRY(record_file_number(file, 0.0, 1.0, &m->specular_share, "the specularity"));
    TRY(record_file_number(file, 0.0, 1.0, &m->solar_absorptance, "the visible emissivity"));
    TRY(record_file_number(file, 0.0, 1.0, &m->thermal_emissivity, "the thermal emissivity"));
    TRY(record_file_number(file, -1.0, 1.0, &m->exposed_area, "the exposed area"));
    TRY(read_name(file, m->emissivity_file, sizeof m->emissivity_file, "the name of a .ems file"));
    TRY(read_name(file, m->extinction_file, sizeof m->extinction_file, "the name of a .ext file"));
    m->specific_heat_j_kg_k = heat * HEAT_J_KG_K;
    m->conductivity_w_m_k = conductivity * CONDUCTIVITY_W_M_K;
    m->density_kg_m3 = density * DENSITY_KG_M3;
out:
    return rc;
}

status material_library_read(material_library **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    long count;
    material_library *library = calloc(1, sizeof *library);

    NEED(library, STATUS_MEMORY, "no memory for a material library");
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
    TRY(record_file_count(file, 1, 100000, &count, "the number of materials"));
    library->items = calloc((size_t)count, sizeof *library->items);
    NEED(library->items, STATUS_MEMORY, "no memory for %ld materials", count);
    for (; library->count < count; library->count++)
        TRY(read_material(&library->items[library->count], library, file));
    TRY(record_file_finish(file));
    *out = library;
    library = NULL;
out:
    record_file_free(file);
    material_library_free(library);
    return rc;
}

void material_library_free(material_library *library)
{
    if (!library) return;
    free(library->items);
    free(library);
}

const material *material_by_name(const material_library *library, const char *name)
{
    for (int i = 0; i < library->count; i++)
        if (strcmp(library->items[i].name, name) == 0) return &library->items[i];
    return NULL;
}

const material *material_by_code(const material_library *library, int code)
{
    for (int i = 0; i < library->count; i++)
        if (library->items[i].code == code) return &library->items[i];
    return NULL;
}

void material_offer_names(const material_library *library, spelling *near)
{
    for (int i = 0; i < library->count; i++) spelling_offer(near, library->items[i].name);
}
