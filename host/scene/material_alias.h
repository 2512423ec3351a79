/* Material alias: what the materials of meshes are called in the scene and its library. Modelling programs
 * give names of their own, such as Material.001. */
#ifndef MATERIAL_ALIAS_H
#define MATERIAL_ALIAS_H

#include "scene/scene_table.h"

typedef struct material_alias {
    char *pattern, *material;
    const toml_node *node; /* that states it, or names its file */
    int line;              /* of the file; 0: the scene states it */
    bool is_used;
} material_alias;

typedef struct material_aliases {
    size_t count;
    material_alias *item; /* shape (count), in the order in which they are tried */
    const char *path;     /* of the file; NULL: none */
} material_aliases;

/* Reads [materials]: the table alias, then the CSV alias_file; alias may name the CSV itself. Failures are
 * kept by the reader. */
void material_aliases_read(material_aliases *out, scene_reader *reader);
void material_aliases_free(material_aliases *aliases);

/* Finds the first alias for a name, and marks it as used; NULL: none.
 *   is_known   the name is one of the scene's own: only a pattern that is the name itself replaces it;
 *              else `*`, `?` and `[..]` match as in names of files */
const material_alias *material_aliases_find(material_aliases *aliases, const char *name,
                                            bool is_known);

/* Writes where an alias stands, for messages. Returns out. */
const char *material_alias_where(const material_aliases *aliases, const material_alias *alias,
                                 char *out, size_t size);

/* Warns of aliases that no name of the meshes matched, with the nearest name. */
void material_aliases_warn(const material_aliases *aliases, const geometry *g);

#endif
