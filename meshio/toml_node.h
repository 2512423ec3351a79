/* A value of a TOML document, with the line and the dotted name under which it stands. Nodes live
 * as long as their toml_file. */
#ifndef MESHIO_TOML_NODE_H
#define MESHIO_TOML_NODE_H

#include <stddef.h>

typedef struct toml_node toml_node;

typedef enum toml_kind {
    TOML_TABLE,
    TOML_ARRAY,
    TOML_STRING,
    TOML_NUMBER,
    TOML_BOOL,
    TOML_TIME
} toml_kind;

toml_kind toml_node_kind(const toml_node *node);

/* The line of the key or table header, counted from 1; 0 for the root and what --set stated. */
int toml_node_line(const toml_node *node);

/* `path:line`, `--set` for what --set stated, `path` for the root: where a message about the node
 * begins. */
const char *toml_node_where(const toml_node *node);

/* The key in its table; "" for the root and for the elements of an array. */
const char *toml_node_key(const toml_node *node);

/* The dotted name, as --set takes it: `site.latitude_deg`, `band.0.name`; "" for the root. */
const char *toml_node_name(const toml_node *node);

/* What stands there, as TOML, cut after 60 bytes: for messages. A table is "a table". */
const char *toml_node_text(const toml_node *node);

/* The number of keys of a table or of elements of an array; 0 for every other kind. */
size_t toml_node_count(const toml_node *node);

/* Child number `index` of a table, in the order of the file and --set's last, or of an array; NULL
 * beyond the end. */
const toml_node *toml_node_at(const toml_node *node, size_t index);

/* The value of a key of a table; NULL where there is none, where `node` is no table, and where it
 * is NULL. */
const toml_node *toml_node_get(const toml_node *node, const char *key);

/* The getters return 0, or non-zero with `path:line: name: what stood there, expected ...`
 * where the kind is another one. What they point to belongs to the toml_file. */
int toml_node_string(const char **out, const toml_node *node, char *message, size_t message_size);

/* An integer or a decimal number; nan and inf are refused. */
int toml_node_number(double *out, const toml_node *node, char *message, size_t message_size);

int toml_node_bool(int *out, const toml_node *node, char *message, size_t message_size);

/* A date and time as ISO 8601 with seconds and offset (`1987-06-24T10:00:00-05:00`, UTC as `Z`);
 * one without offset is refused. */
int toml_node_time(const char **out, const toml_node *node, char *message, size_t message_size);

/* An array of numbers, none of them nan or inf; an empty one is allowed. */
int toml_node_numbers(const double **out, size_t *out_count, const toml_node *node, char *message,
                      size_t message_size);

/* An array of strings; an empty one is allowed. */
int toml_node_strings(const char *const **out, size_t *out_count, const toml_node *node,
                      char *message, size_t message_size);

#endif
