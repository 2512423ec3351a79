/* Scene table: reads the keys of one table of scene.toml; remembers which were asked for, so that
 * unknown ones are found, and goes on after errors. */
#ifndef SCENE_TABLE_H
#define SCENE_TABLE_H

#include "meshio/toml_file.h"
#include "scene/scene.h"

/* What reading a scene needs. Failures are counted; their messages are kept (status_keep). */
typedef struct scene_reader {
    scene *s;
    const toml_node *root;
    const char *
        folder; /* with a final slash: where files are looked for that tables name; NULL: the scene's */
    int failure_count;
    status ending; /* STATUS_MEMORY, STATUS_INTERRUPTED: what fails then is told no more */
} scene_reader;

enum { SCENE_TABLE_KEYS = 64 };

typedef struct scene_table {
    scene_reader *reader;
    const toml_node *node; /* NULL: the table is not there, and every key is absent */
    const char *asked[SCENE_TABLE_KEYS];
    int asked_count;
} scene_table;

/* Bytes of the longest name of a scene, a band or a material: the file `SCENE_PLANE.png` can exist, and
 * no header, legend or channel cuts it. */
enum { SCENE_NAME_LENGTH = 100 };

/* Keeps a failure `where: ...` for a node, or for the file where node is NULL. */
__attribute__((format(printf, 3, 4))) void scene_fail(scene_reader *reader, const toml_node *node,
                                                      const char *format, ...);

/* Keeps the failure of another room's reader, if rc is one; returns true if it is STATUS_OK. */
bool scene_took(scene_reader *reader, status rc);

/* The same for a failure that names no file: it is told at a node. */
bool scene_took_at(scene_reader *reader, const toml_node *node, status rc);

/* Opens a table; a value of another kind is a failure. node may be NULL. */
scene_table scene_table_open(scene_reader *reader, const toml_node *node, const char *name);

/* True if the key is there. */
bool scene_table_has(scene_table *t, const char *key);

/* Each returns true if the key is there and holds what it must; a wrong value is a failure, an
 * absent key is not. */
bool scene_table_number(scene_table *t, const char *key, double low, double high, double *out);
bool scene_table_whole(scene_table *t, const char *key, double low, double high, double *out);
bool scene_table_numbers(scene_table *t, const char *key, size_t count, double low, double high,
                         double *out);
bool scene_table_whole_numbers(scene_table *t, const char *key, size_t count, double low,
                               double high, double *out);
bool scene_table_string(scene_table *t, const char *key, const char **out);
/* A name that is not too long, without control characters and those in `not_in_it`; `expected` says so. */
bool scene_table_name(scene_table *t, const char *key, const char *not_in_it, const char *expected,
                      const char **out);
bool scene_table_bool(scene_table *t, const char *key, bool *out);
/* One of `count` words; sets its index. */
bool scene_table_word(scene_table *t, const char *key, const char *const *words, int count,
                      int *out);
const toml_node *scene_table_node(scene_table *t, const char *key);

/* Fails for a key that must be there and is not; `expected` says what it holds. */
void scene_table_require(scene_table *t, const char *key, const char *expected);

/* Fails for every key that was never asked for. A key without its unit is told the one with it. */
void scene_table_close(scene_table *t);

/* Where files are looked for that tables name, with a final slash. */
const char *scene_reader_folder(const scene_reader *reader);

/* A key that names a file, relative to that folder: true if the file can be read; it is then
 * one of the scene's inputs, and its path belongs to the scene. */
bool scene_table_file(scene_table *t, const char *key, const char **out_path);

/* Adds an input. Returns its path, or NULL after a failure: no memory, or it cannot be read.
 *   node     that names it, for the message
 *   folder   where it is looked for unless the name is absolute, with a final slash */
const char *scene_add_input(scene_reader *reader, const toml_node *node, const char *folder,
                            const char *name);

#endif
