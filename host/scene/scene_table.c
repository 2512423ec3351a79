#include "scene/scene_table.h"

#include "base/array.h"
#include "base/spelling.h"
#include "base/terminal_text.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void scene_fail(scene_reader *reader, const toml_node *node, const char *format, ...)
{
    char text[2048];
    va_list arguments;

    reader->failure_count++;
    if (reader->ending) return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    status_keep(
        status_set(STATUS_FORMAT, "%s: %s", node ? toml_node_where(node) : reader->s->path, text));
}

bool scene_took(scene_reader *reader, status rc)
{
    if (rc == STATUS_OK) return true;
    reader->failure_count++;
    if (!reader->ending) status_keep(rc);
    if (rc == STATUS_MEMORY || rc == STATUS_INTERRUPTED) reader->ending = rc;
    return false;
}

bool scene_took_at(scene_reader *reader, const toml_node *node, status rc)
{
    if (rc == STATUS_OK || rc == STATUS_MEMORY || rc == STATUS_INTERRUPTED)
        return scene_took(reader, rc);
    scene_fail(reader, node, "%s", status_last());
    return false;
}

scene_table scene_table_open(scene_reader *reader, const toml_node *node, const char *name)
{
    scene_table t = {.reader = reader, .node = node};

    if (node && toml_node_kind(node) != TOML_TABLE) {
        scene_fail(reader, node, "%s: found %s, expected a table", name, toml_node_text(node));
        t.node = NULL;
    }
    return t;
}

const toml_node *scene_table_node(scene_table *t, const char *key)
{
    assert(t->asked_count < SCENE_TABLE_KEYS);
    t->asked[t->asked_count++] = key;
    return t->node ? toml_node_get(t->node, key) : NULL;
}

bool scene_table_has(scene_table *t, const char *key)
{
    return scene_table_node(t, key) != NULL;
}

/* Keeps what a getter of meshio said if it failed. */
static bool took_value(scene_table *t, int failed, const char *message)
{
    if (failed) scene_took(t->reader, status_set(STATUS_FORMAT, "%s", message));
    return !failed;
}

static bool in_range(scene_table *t, const toml_node *node, double value, double low, double high)
{
    if (value >= low && value <= high) return true;
    scene_fail(t->reader, node, "%s: found %s, expected a number from %g to %g",
               toml_node_name(node), toml_node_text(node), low, high);
    return false;
}

bool scene_table_number(scene_table *t, const char *key, double low, double high, double *out)
{
    char message[512];
    double value;
    const toml_node *node = scene_table_node(t, key);

    if (!node) return false;
    if (!took_value(t, toml_node_number(&value, node, message, sizeof message), message))
        return false;
    if (!in_range(t, node, value, low, high)) return false;
    *out = value;
    return true;
}

bool scene_table_whole(scene_table *t, const char *key, double low, double high, double *out)
{
    double value = 0.0;

    if (!scene_table_number(t, key, low, high, &value)) return false;
    if (value == floor(value)) {
        *out = value;
        return true;
    }
    const toml_node *node = toml_node_get(t->node, key);
    scene_fail(t->reader, node, "%s: found %g, expected a whole number", toml_node_name(node),
               value);
    return false;
}

bool scene_table_numbers(scene_table *t, const char *key, size_t count, double low, double high,
                         double *out)
{
    char message[512];
    const double *values;
    size_t found;
    const toml_node *node = scene_table_node(t, key);

    if (!node) return false;
    if (!took_value(t, toml_node_numbers(&values, &found, node, message, sizeof message), message))
        return false;
    if (found != count) {
        scene_fail(t->reader, node, "%s: found %s, expected %zu numbers", toml_node_name(node),
                   toml_node_text(node), count);
        return false;
    }
    for (size_t i = 0; i < count; i++)
        if (!in_range(t, node, values[i], low, high)) return false;
    memcpy(out, values, count * sizeof *out);
    return true;
}

bool scene_table_whole_numbers(scene_table *t, const char *key, size_t count, double low,
                               double high, double *out)
{
    const toml_node *node = toml_node_get(t->node, key);

    if (!scene_table_numbers(t, key, count, low, high, out)) return false;
    for (size_t i = 0; i < count; i++) {
        if (out[i] == floor(out[i])) continue;
        scene_fail(t->reader, node, "%s: found %s, expected whole numbers", toml_node_name(node),
                   toml_node_text(node));
        return false;
    }
    return true;
}

bool scene_table_string(scene_table *t, const char *key, const char **out)
{
    char message[512];
    const toml_node *node = scene_table_node(t, key);

    if (!node) return false;
    if (!took_value(t, toml_node_string(out, node, message, sizeof message), message)) return false;
    if (**out) return true;
    scene_fail(t->reader, node, "%s: is empty", toml_node_name(node));
    return false;
}

static bool is_name(const char *text)
{
    return terminal_text_is_clean(text) && !strchr(text, '\t') && strlen(text) <= SCENE_NAME_LENGTH;
}

bool scene_table_name(scene_table *t, const char *key, const char *not_in_it, const char *expected,
                      const char **out)
{
    if (!scene_table_string(t, key, out)) return false;
    if (is_name(*out) && !strpbrk(*out, not_in_it)) return true;
    const toml_node *node = toml_node_get(t->node, key);
    scene_fail(t->reader, node,
               "%s: found %s, expected %s, without control characters, of at most %d bytes",
               toml_node_name(node), toml_node_text(node), expected, SCENE_NAME_LENGTH);
    return false;
}

bool scene_table_bool(scene_table *t, const char *key, bool *out)
{
    char message[512];
    int value;
    const toml_node *node = scene_table_node(t, key);

    if (!node) return false;
    if (!took_value(t, toml_node_bool(&value, node, message, sizeof message), message))
        return false;
    *out = value != 0;
    return true;
}

bool scene_table_word(scene_table *t, const char *key, const char *const *words, int count,
                      int *out)
{
    char expected[256] = "";
    const char *text;

    if (!scene_table_string(t, key, &text)) return false;
    for (int i = 0; i < count; i++) {
        if (!strcmp(text, words[i])) {
            *out = i;
            return true;
        }
        snprintf(expected + strlen(expected), sizeof expected - strlen(expected), "%s\"%s\"",
                 i ? " or " : "", words[i]);
    }
    const toml_node *node = toml_node_get(t->node, key);
    scene_fail(t->reader, node, "%s: found \"%s\", expected %s", toml_node_name(node), text,
               expected);
    return false;
}

void scene_table_require(scene_table *t, const char *key, const char *expected)
{
    if (!t->node || toml_node_get(t->node, key)) return;
    scene_fail(t->reader, t->node, "%s%s%s: missing, expected %s", toml_node_name(t->node),
               *toml_node_name(t->node) ? "." : "", key, expected);
}

static bool was_asked(const scene_table *t, const char *key)
{
    for (int i = 0; i < t->asked_count; i++)
        if (!strcmp(t->asked[i], key)) return true;
    return false;
}

/* The shortest asked key that is this one and a unit, as latitude_deg is for latitude. */
static const char *with_unit(const scene_table *t, const char *key)
{
    const size_t length = strlen(key);
    const char *best = NULL;

    for (int i = 0; i < t->asked_count; i++)
        if (!strncmp(t->asked[i], key, length) && t->asked[i][length] == '_' &&
            (!best || strlen(t->asked[i]) < strlen(best)))
            best = t->asked[i];
    return best;
}

static void fail_unknown(const scene_table *t, const toml_node *child)
{
    spelling near = spelling_of(toml_node_key(child));
    char hint[SPELLING_HINT_SIZE];

    for (int i = 0; i < t->asked_count; i++) spelling_offer(&near, t->asked[i]);
    scene_fail(t->reader, child, "%s: unknown key%s", toml_node_name(child),
               spelling_hint(&near, "", hint));
}

void scene_table_close(scene_table *t)
{
    for (size_t i = 0; t->node && i < toml_node_count(t->node); i++) {
        const toml_node *child = toml_node_at(t->node, i);
        if (was_asked(t, toml_node_key(child))) continue;
        const char *better = with_unit(t, toml_node_key(child));
        if (better)
            scene_fail(t->reader, child, "%s: the unit is missing, expected the key %s",
                       toml_node_name(child), better);
        else
            fail_unknown(t, child);
    }
}

/* Adds an input unless an earlier one is the same file.
 *   out_path   belongs to the scene */
static status add_input(scene *s, const char *folder, const char *name, const char **out_path)
{
    status rc = STATUS_OK;
    const size_t size = strlen(folder) + strlen(name) + 1;
    scene_input input = {.name = strdup(name), .path = malloc(size)};
    uint32_t number;

    NEED(input.name && input.path && array_add(&s->inputs, s->input_count, sizeof *s->inputs),
         STATUS_MEMORY, "%s: no memory for its name", name);
    snprintf(input.path, size, "%s%s", *name == '/' ? "" : folder, name);
    if (!s->input_numbers) TRY(name_table_open(&s->input_numbers));
    TRY(name_table_number(s->input_numbers, 0, input.path, &number));
    if (number == s->input_count) {
        input.stamp = file_stamp_of(input.path);
        s->inputs[s->input_count++] = input;
        input = (scene_input){0};
    }
    *out_path = s->inputs[number].path;
out:
    free(input.name);
    free(input.path);
    return rc;
}

const char *scene_add_input(scene_reader *reader, const toml_node *node, const char *folder,
                            const char *name)
{
    const size_t count = reader->s->input_count;
    const char *path = NULL;

    if (!scene_took(reader, add_input(reader->s, folder, name, &path))) return NULL;
    if (reader->s->input_count == count || access(path, R_OK) == 0) return path;
    scene_fail(reader, node, "%s: %s", path, strerror(errno));
    return NULL;
}

const char *scene_reader_folder(const scene_reader *reader)
{
    return reader->folder ? reader->folder : reader->s->folder;
}

bool scene_table_file(scene_table *t, const char *key, const char **out_path)
{
    const char *name;

    if (!scene_table_string(t, key, &name)) return false;
    *out_path = scene_add_input(t->reader, toml_node_get(t->node, key),
                                scene_reader_folder(t->reader), name);
    return *out_path != NULL;
}
