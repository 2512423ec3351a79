#include "scene/material_alias.h"

#include "base/array.h"
#include "base/name_pattern.h"
#include "base/spelling.h"
#include "base/utf8_text.h"
#include "files/csv_row.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { NAME_SIZE = 256, WHERE_SIZE = 512 };

/* Adds an alias; the texts are copied. */
static status add(material_aliases *to, const char *pattern, const char *material,
                  const toml_node *node, int line)
{
    status rc = STATUS_OK;
    material_alias a = {utf8_text_copy(pattern), utf8_text_copy(material), node, line, false};

    NEED(a.pattern && a.material && array_add(&to->item, to->count, sizeof *to->item),
         STATUS_MEMORY, "no memory for names of materials");
    to->item[to->count++] = a;
    return STATUS_OK;
out:
    free(a.pattern);
    free(a.material);
    return rc;
}

/* A key without quotes that holds dots, as Material.001, is a table in a table. */
static void read_table(material_aliases *to, scene_reader *reader, const toml_node *table,
                       const char *prefix)
{
    for (size_t i = 0; i < toml_node_count(table); i++) {
        const toml_node *child = toml_node_at(table, i);
        char name[NAME_SIZE], message[512];
        const char *material;
        snprintf(name, sizeof name, "%s%s%s", prefix, *prefix ? "." : "", toml_node_key(child));
        if (toml_node_kind(child) == TOML_TABLE)
            read_table(to, reader, child, name);
        else if (toml_node_string(&material, child, message, sizeof message) != 0)
            scene_took(reader, status_set(STATUS_FORMAT, "%s", message));
        else
            scene_took(reader, add(to, name, material, child, 0));
    }
}

static bool is_pair(const csv_row *row)
{
    return row->count == 2 && *csv_row_field(row, 0) && *csv_row_field(row, 1);
}

static status read_file(material_aliases *to, const char *path, const toml_node *node)
{
    status rc = STATUS_OK;
    static const char names[] = "the names of the columns, pattern,material";
    static const char expected[] = "a pattern and a material";
    char separator;
    csv_row row = {0};
    record_file *file = NULL;

    TRY(record_file_open(&file, path));
    TRY(csv_row_names(&row, file, &separator, names));
    if (!is_pair(&row) || strcasecmp(csv_row_field(&row, 0), "pattern") != 0 ||
        strcasecmp(csv_row_field(&row, 1), "material") != 0) {
        rc = record_file_reject(file, "%s", names);
        goto out;
    }
    while (!record_file_at_end(file)) {
        TRY(csv_row_take(&row, file, separator, expected));
        if (!is_pair(&row)) {
            rc = record_file_reject(file, "%s", expected);
            goto out;
        }
        TRY(add(to, csv_row_field(&row, 0), csv_row_field(&row, 1), node, record_file_line(file)));
    }
out:
    csv_row_free(&row);
    record_file_free(file);
    return rc;
}

void material_aliases_read(material_aliases *out, scene_reader *reader)
{
    scene_table t = scene_table_open(reader, toml_node_get(reader->root, "materials"), "materials");
    const toml_node *alias = scene_table_node(&t, "alias");
    const bool is_table = alias && toml_node_kind(alias) == TOML_TABLE;
    const char *key = "alias_file";

    if (is_table) read_table(out, reader, alias, "");
    if (alias && !is_table && scene_table_has(&t, key))
        scene_fail(reader, alias, "%s: found %s, expected a table beside alias_file",
                   toml_node_name(alias), toml_node_text(alias));
    else if (alias && !is_table)
        key = "alias";
    if (scene_table_file(&t, key, &out->path))
        scene_took(reader, read_file(out, out->path, toml_node_get(t.node, key)));
    scene_table_close(&t);
}

void material_aliases_free(material_aliases *aliases)
{
    for (size_t i = 0; i < aliases->count; i++) {
        free(aliases->item[i].pattern);
        free(aliases->item[i].material);
    }
    free(aliases->item);
}

const material_alias *material_aliases_find(material_aliases *aliases, const char *name,
                                            bool is_known)
{
    for (size_t i = 0; i < aliases->count; i++) {
        material_alias *a = &aliases->item[i];
        if (strcmp(a->pattern, name) != 0 && (is_known || !name_pattern_fits(a->pattern, name)))
            continue;
        a->is_used = true;
        return a;
    }
    return NULL;
}

const char *material_alias_where(const material_aliases *aliases, const material_alias *alias,
                                 char *out, size_t size)
{
    if (alias->line)
        snprintf(out, size, "%s:%d", aliases->path, alias->line);
    else
        snprintf(out, size, "%s", toml_node_where(alias->node));
    return out;
}

void material_aliases_warn(const material_aliases *aliases, const geometry *g)
{
    char where[WHERE_SIZE], hint[SPELLING_HINT_SIZE];

    for (size_t i = 0; i < aliases->count; i++) {
        const material_alias *a = &aliases->item[i];
        if (a->is_used) continue;
        spelling near = spelling_of(a->pattern);
        for (uint32_t k = 0; k < g->material_count; k++)
            spelling_offer(&near, g->materials[k].name);
        status_warn("%s: alias \"%s\": no material of the meshes has such a name%s",
                    material_alias_where(aliases, a, where, sizeof where), a->pattern,
                    spelling_hint(&near, "", hint));
    }
}
