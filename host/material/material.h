/* Material: what facets are made of. Thesis 2.5.1, Appendix A item 10 (.mat), Table D-1. */
#ifndef MATERIAL_H
#define MATERIAL_H

#include "base/spelling.h"
#include "base/status.h"

enum { MATERIAL_NAME_SIZE = 64, MATERIAL_FILE_SIZE = 256 };

typedef struct material {
    char name[MATERIAL_NAME_SIZE];
    int code; /* as facets and the material plane name it, 0 .. 2^24 */
    double specific_heat_j_kg_k;
    double conductivity_w_m_k;
    double density_kg_m3;
    double specular_share;     /* 0 diffuse .. 1 specular */
    double solar_absorptance;  /* the file's visible emissivity */
    double thermal_emissivity; /* broad band */
    double exposed_area; /* -1..1; |A|: exposed fraction of both sides; negative: conductive slab */
    char emissivity_file[MATERIAL_FILE_SIZE]; /* .ems, as the file names it */
    char extinction_file[MATERIAL_FILE_SIZE]; /* .ext */
} material;

typedef struct material_library {
    int count;
    material *items; /* shape (count) */
} material_library;

/* Reads a .mat file. A name or code that came before is an error at its second line; names that
 * differ by case only are different. */
status material_library_read(material_library **out, const char *path);
void material_library_free(material_library *library);

/* NULL if no material has that name or code. */
const material *material_by_name(const material_library *library, const char *name);
const material *material_by_code(const material_library *library, int code);

/* Offers the names of a library in place of one that it lacks. */
void material_offer_names(const material_library *library, spelling *near);

#endif
