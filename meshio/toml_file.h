/* A TOML document read from a file, such as scene.toml, with what the command line's --set changes
 * in it. */
#ifndef MESHIO_TOML_FILE_H
#define MESHIO_TOML_FILE_H

#include "toml_node.h"

typedef struct toml_file toml_file;

/* Reads `path` and applies the settings in order.
 *   setting   shape (setting_count): `table.key=value`, elements of an array by index, as in
 *             `band.0.name=lwir`; the value is TOML, and a word that is none is a string; missing
 *             tables are made, arrays do not grow
 * The caller releases *out with toml_file_free; on failure *out is left as it was.
 * Returns 0, or non-zero with a message that begins with `path:line:`, `path:` or
 * `--set table.key=value:`. */
int toml_file_read(toml_file **out, const char *path, const char *const *setting,
                   size_t setting_count, char *message, size_t message_size);

/* The document itself, a table. */
const toml_node *toml_file_root(const toml_file *file);

void toml_file_free(toml_file *file);

#endif
