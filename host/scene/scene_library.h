/* Scene library: the files of [library], .mat and .toml, as one list of materials. */
#ifndef SCENE_LIBRARY_H
#define SCENE_LIBRARY_H

#include "base/spelling.h"
#include "material/material.h"
#include "scene/stated_material.h"

/* A file of it. */
typedef struct library_file {
    const char *path;      /* belongs to the scene */
    char *folder;          /* with a final slash: where the files that it names lie */
    material_library *mat; /* of a .mat */
    toml_file *toml;       /* of a .toml */
} library_file;

/* A material of it. */
typedef struct library_entry {
    const char *name;
    size_t file;           /* index into the files */
    const material *known; /* of a .mat; NULL: of a .toml */
    const toml_node *node; /* its [[material]] there */
    uint32_t number;       /* of those of .toml, from 0 */
} library_entry;

typedef struct scene_library {
    const toml_node *node; /* that names the files; NULL: there is no library */
    bool is_read;          /* all of them were */
    size_t file_count;
    library_file *file; /* shape (file_count) */
    size_t count;
    library_entry *entry;  /* shape (count), in the order of the files */
    uint32_t stated_count; /* of .toml */
    int highest_code;      /* of .mat */
} scene_library;

/* Reads the files of [library]; `out` is empty. A name or a code that two materials have is a failure that names
 * both. Failures are kept by the reader. */
void scene_library_read(scene_library *out, scene_reader *reader);
/* Reads one file; its path belongs to the scene. */
void scene_library_add(scene_library *library, scene_reader *reader, const char *path);
void scene_library_free(scene_library *library);

/* NULL if no material has that name or code. */
const library_entry *scene_library_by_name(const scene_library *library, const char *name);
const library_entry *scene_library_by_code(const scene_library *library, int code);

/* What a material of a .toml states; the files that it names become inputs of the scene. */
stated_material scene_library_stated(const scene_library *library, const library_entry *entry,
                                     scene_reader *reader);

/* Offers the names of a library in place of one that it lacks. */
void scene_library_offer(const scene_library *library, spelling *near);

#endif
