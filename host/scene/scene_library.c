#include "scene/scene_library.h"

#include "base/array.h"
#include "files/file_name.h"

#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 64 };

static const char *path_of(const scene_library *library, const library_entry *entry)
{
    return library->file[entry->file].path;
}

/* Adds a material unless another one has its name or its code. */
static void add(scene_library *library, scene_reader *reader, const library_entry *entry)
{
    const library_entry *same = scene_library_by_name(library, entry->name);
    const char *const path = path_of(library, entry);

    if (same) {
        scene_fail(reader, entry->node ? entry->node : library->node,
                   "%s: material \"%s\" stands in %s too, expected every name once", path,
                   entry->name, path_of(library, same));
        return;
    }
    same = entry->known ? scene_library_by_code(library, entry->known->code) : NULL;
    if (same) {
        scene_fail(
            reader, library->node,
            "%s: code %d of material \"%s\" is that of \"%s\" in %s, expected every code once",
            path, entry->known->code, entry->name, same->name, path_of(library, same));
        return;
    }
    if (!array_add(&library->entry, library->count, sizeof *library->entry)) {
        scene_took(reader, status_set(STATUS_MEMORY, "no memory for a library"));
        return;
    }
    library->entry[library->count++] = *entry;
}

static void add_known(scene_library *library, scene_reader *reader, size_t file)
{
    const material_library *mat = library->file[file].mat;

    for (int i = 0; i < mat->count; i++) {
        const library_entry entry = {
            .name = mat->items[i].name, .file = file, .known = &mat->items[i]};
        add(library, reader, &entry);
        if (entry.known->code > library->highest_code) library->highest_code = entry.known->code;
    }
}

static void add_stated(scene_library *library, scene_reader *reader, size_t file)
{
    const toml_node *root = toml_file_root(library->file[file].toml);
    const toml_node *list = toml_node_get(root, "material");

    for (size_t i = 0; i < toml_node_count(root); i++)
        if (toml_node_at(root, i) != list)
            scene_fail(reader, toml_node_at(root, i),
                       "%s: found this, expected [[material]] tables alone",
                       toml_node_name(toml_node_at(root, i)));
    if (!list || toml_node_kind(list) != TOML_ARRAY) {
        scene_fail(reader, list ? list : root, "material: expected [[material]] tables");
        return;
    }
    for (size_t i = 0; i < toml_node_count(list); i++) {
        library_entry entry = {
            .file = file, .node = toml_node_at(list, i), .number = library->stated_count++};
        const toml_node *name = toml_node_get(entry.node, "name");
        char message[512];
        if (!name)
            scene_fail(reader, entry.node, "%s: name is missing, expected that of the material",
                       toml_node_name(entry.node));
        else if (toml_node_string(&entry.name, name, message, sizeof message) != 0)
            scene_took(reader, status_set(STATUS_FORMAT, "%s", message));
        else
            add(library, reader, &entry);
    }
}

static status read_toml(toml_file **out, const char *path)
{
    status rc = STATUS_OK;
    char message[2048];

    NEED(toml_file_read(out, path, NULL, 0, message, sizeof message) == 0, STATUS_FORMAT, "%s",
         message);
out:
    return rc;
}

void scene_library_add(scene_library *library, scene_reader *reader, const char *path)
{
    const char *slash = strrchr(path, '/');
    const size_t index = library->file_count;
    library_file file = {.path = path};

    file.folder = strndup(path, slash ? (size_t)(slash - path + 1) : 0);
    if (!file.folder || !array_add(&library->file, index, sizeof *library->file)) {
        free(file.folder);
        scene_took(reader, status_set(STATUS_MEMORY, "%s: no memory to read it", path));
        return;
    }
    library->file[library->file_count++] = file;
    if (file_name_ends(path, ".toml")) {
        if (scene_took(reader, read_toml(&library->file[index].toml, path)))
            add_stated(library, reader, index);
    } else if (scene_took(reader, material_library_read(&library->file[index].mat, path))) {
        add_known(library, reader, index);
    }
}

/* Reads a path, or each of a list. */
static void read_files(scene_library *library, scene_reader *reader)
{
    const char *const *name, *one;
    char message[512];
    size_t count = 1;
    const int failed =
        toml_node_kind(library->node) == TOML_ARRAY
            ? toml_node_strings(&name, &count, library->node, message, sizeof message)
            : (name = &one, toml_node_string(&one, library->node, message, sizeof message));

    if (failed) {
        scene_took(reader, status_set(STATUS_FORMAT, "%s", message));
    } else if (count < 1 || count > FILE_LIMIT) {
        scene_fail(reader, library->node, "%s: found %zu files, expected 1 to %d",
                   toml_node_name(library->node), count, FILE_LIMIT);
    } else {
        for (size_t i = 0; i < count; i++) {
            const char *path =
                scene_add_input(reader, library->node, scene_reader_folder(reader), name[i]);
            if (path) scene_library_add(library, reader, path);
        }
    }
}

void scene_library_read(scene_library *out, scene_reader *reader)
{
    const int failures = reader->failure_count;
    scene_table t = scene_table_open(reader, toml_node_get(reader->root, "library"), "library");

    if (!t.node) return;
    scene_table_require(&t, "materials", "a .mat or .toml file, or a list of them");
    out->node = scene_table_node(&t, "materials");
    if (out->node) read_files(out, reader);
    scene_table_close(&t);
    out->is_read = reader->failure_count == failures;
}

void scene_library_free(scene_library *library)
{
    for (size_t i = 0; i < library->file_count; i++) {
        free(library->file[i].folder);
        material_library_free(library->file[i].mat);
        toml_file_free(library->file[i].toml);
    }
    free(library->file);
    free(library->entry);
}

const library_entry *scene_library_by_name(const scene_library *library, const char *name)
{
    for (size_t i = 0; i < library->count; i++)
        if (strcmp(library->entry[i].name, name) == 0) return &library->entry[i];
    return NULL;
}

const library_entry *scene_library_by_code(const scene_library *library, int code)
{
    for (size_t i = 0; i < library->count; i++)
        if (library->entry[i].known && library->entry[i].known->code == code)
            return &library->entry[i];
    return NULL;
}

stated_material scene_library_stated(const scene_library *library, const library_entry *entry,
                                     scene_reader *reader)
{
    const char *const before = reader->folder;

    reader->folder = library->file[entry->file].folder;
    stated_material m = stated_material_read(reader, entry->node, NULL);
    reader->folder = before;
    m.number = entry->number;
    return m;
}

void scene_library_offer(const scene_library *library, spelling *near)
{
    for (size_t i = 0; i < library->count; i++) spelling_offer(near, library->entry[i].name);
}
