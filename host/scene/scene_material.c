#include "scene/scene_parts.h"

#include "base/name_table.h"
#include "scene/material_alias.h"
#include "scene/scene_library.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* So many failures tell of the nearest name. */
enum { HINTS = 100 };

/* Where materials are looked up. */
typedef struct material_sources {
    scene_reader *reader;
    scene_library library;
    stated_material *stated;
    size_t stated_count;
    name_table *stated_numbers; /* of the stated, then of what was looked up among them */
    name_table *used_numbers;   /* of the scene's materials */
    material_aliases *aliases;
} material_sources;

/* Numbers a name; UINT32_MAX after a failure. */
static uint32_t number_of(const material_sources *from, name_table *names, const char *name)
{
    uint32_t number = UINT32_MAX;

    scene_took(from->reader, name_table_number(names, 0, name, &number));
    return number;
}

/* A table of the scene, which may change a material of the library. */
static stated_material read_stated(const material_sources *from, const toml_node *node,
                                   uint32_t index)
{
    const char *name = "";
    char message[512];
    const toml_node *named = toml_node_get(node, "name");
    const bool has_name = named && toml_node_string(&name, named, message, sizeof message) == 0;
    const library_entry *entry = has_name ? scene_library_by_name(&from->library, name) : NULL;
    stated_material base, m;

    if (entry && entry->node)
        base = scene_library_stated(&from->library, entry, from->reader);
    else
        entry = NULL;
    m = stated_material_read(from->reader, node, entry ? &base : NULL);
    m.number = entry ? entry->number : from->library.stated_count + index;
    return m;
}

static void read_all_stated(material_sources *from)
{
    const toml_node *list = toml_node_get(from->reader->root, "material");
    const size_t count = list ? toml_node_count(list) : 0;

    if (list && toml_node_kind(list) != TOML_ARRAY) {
        scene_fail(from->reader, list, "material: expected [[material]] tables");
        return;
    }
    from->stated = calloc(count + 1, sizeof *from->stated);
    if (!from->stated) {
        scene_took(from->reader, status_set(STATUS_MEMORY, "no memory for %zu materials", count));
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const stated_material m = read_stated(from, toml_node_at(list, i), (uint32_t)i);
        if (number_of(from, from->stated_numbers, m.name) == from->stated_count)
            from->stated[from->stated_count++] = m;
        else
            scene_fail(from->reader, m.node, "%s: two materials are named \"%s\"",
                       toml_node_name(m.node), m.name);
    }
}

static const stated_material *find_stated(const material_sources *from, const char *name)
{
    const uint32_t number = number_of(from, from->stated_numbers, name);

    return number < from->stated_count ? &from->stated[number] : NULL;
}

static float either(double stated, double otherwise)
{
    return (float)(isnan(stated) ? otherwise : stated);
}

/* Thesis mode knows 0 and 1 alone. */
static float specular_share(const scene *s, const stated_material *stated, const material *known)
{
    const float fraction = either(stated->specular_share, known->specular_share);

    return s->thesis ? (fraction < 0.5f ? 0.0f : 1.0f) : fraction;
}

/* 0: it does not; in thesis mode nothing does. */
static float melts_k(const scene *s, const stated_material *stated)
{
    return s->thesis || isnan(stated->melting_c) ? 0.0f : (float)(stated->melting_c + 273.15);
}

static material_record make_record(const material_sources *from, const material *known,
                                   const stated_material *stated)
{
    static const material unknown = {.density_kg_m3 = 0.0, .exposed_area = .5};
    const stated_material nothing = stated_material_default();
    const material *base = known ? known : &unknown;
    const stated_material *over = stated ? stated : &nothing;
    const bool has_spectrum = over->spectrum.count > 0;
    /* Grey means the same in sunlight unless the scene says more; a spectrum tells both. */
    const double solar = has_spectrum              ? (double)NAN
                         : isnan(over->emissivity) ? base->solar_absorptance
                                                   : over->emissivity;
    const double thermal = has_spectrum ? (double)NAN : base->thermal_emissivity;

    return (material_record){
        .density_kg_m3 = either(over->density_kg_m3, base->density_kg_m3),
        .specific_heat_j_kg_k = either(over->specific_heat_j_kg_k, base->specific_heat_j_kg_k),
        .conductivity_w_m_k = either(over->conductivity_w_m_k, base->conductivity_w_m_k),
        .solar_absorptance = either(over->solar_absorptance, solar),
        .thermal_emissivity = either(over->emissivity, thermal),
        .exposed_area = either(over->exposed_area, base->exposed_area),
        .specular_share = specular_share(from->reader->s, over, base),
        .roughness = from->reader->s->thesis ? 0.0f : either(over->roughness, 0.0),
        .melts_k = melts_k(from->reader->s, over),
        /* Numbers of other materials follow the codes of .mat files. */
        .number = known ? (uint32_t)known->code
                        : (uint32_t)from->library.highest_code + 1u + over->number,
    };
}

/* A file that a .mat names. */
static const char *add_known_file(const material_sources *from, const library_entry *entry,
                                  const char *name)
{
    return scene_add_input(from->reader, from->library.node, from->library.file[entry->file].folder,
                           name);
}

/* Sets table or grey emissivity: the scene's file, the scene's number, the library's file. */
static void read_emissivity(const material_sources *from, scene_material *m,
                            const library_entry *entry, const stated_material *stated)
{
    const material *known = entry ? entry->known : NULL;
    scene_reader *reader = from->reader;
    const char *path = NULL;

    if (stated && stated->spectrum.node) {
        scene_take_spectrum(reader, m, &stated->spectrum);
        /* Fresnel's formulas are those of a smooth surface. */
        if (isnan(stated->specular_share) && m->table &&
            (m->table->law == EMISSIVITY_FRESNEL || m->table->law == EMISSIVITY_OPTICAL))
            m->record.specular_share = 1.0f;
        return;
    } else if (stated && stated->emissivity_path) {
        path = stated->emissivity_path;
    } else if (stated && !isnan(stated->emissivity)) {
        m->grey_emissivity = stated->emissivity;
        return;
    } else if (!known || !strcmp(known->emissivity_file, "null")) {
        scene_fail(reader, stated ? stated->node : from->library.node,
                   "material %s: has no emissivity, expected emissivity, emissivity_file or "
                   "spectrum_file in "
                   "[[material]]",
                   m->name);
        return;
    } else {
        path = add_known_file(from, entry, known->emissivity_file);
    }
    if (path && scene_took(reader, emissivity_read(&m->table, path)))
        m->record.emissivity_angles = EMISSIVITY_ANGLES;
}

/* The scene's file, the scene's number, the library's file. */
static void read_extinction(const material_sources *from, scene_material *m,
                            const library_entry *entry, const stated_material *stated)
{
    const material *known = entry ? entry->known : NULL;
    const toml_node *node = stated ? stated->node : from->library.node;
    const char *path = stated ? stated->extinction_path : NULL;
    const double per_km = stated ? stated->extinction_per_km : (double)NAN;

    if (!path && isnan(per_km) && known && strcmp(known->extinction_file, "null") != 0)
        path = add_known_file(from, entry, known->extinction_file);
    scene_read_medium(from->reader, m, node, path, per_km);
    if (stated && stated->scattering_path)
        scene_read_scattering(from->reader, m, node, stated->scattering_path);
}

static void check_material(scene_reader *reader, const scene_material *m,
                           const stated_material *stated, const toml_node *node)
{
    const material_record *r = &m->record;

    if (reader->s->thermal == SCENE_THERMAL_FIXED) return;
    const char *model = scene_thermal_name(reader->s->thermal);
    if (!(r->density_kg_m3 > 0.0f) || !(r->specific_heat_j_kg_k > 0.0f))
        scene_fail(reader, node,
                   "material %s: thermal = \"%s\" needs density_kg_m3, specific_heat_j_kg_k and "
                   "conductivity_w_m_k",
                   m->name, model);
    if (stated && stated->emissivity_path && !(r->thermal_emissivity > 0.0f))
        scene_fail(reader, node,
                   "material %s: thermal = \"%s\" needs emissivity, the broad-band one, beside "
                   "emissivity_file",
                   m->name, model);
}

/* Returns the new material's index, or RECORD_NONE without memory. */
static uint32_t add_material(const material_sources *from, const char *name,
                             const library_entry *entry, const stated_material *stated)
{
    scene *s = from->reader->s;
    scene_material *m = &s->materials[s->material_count];

    m->name = strdup(name);
    if (!m->name) {
        scene_took(from->reader, status_set(STATUS_MEMORY, "%s: no memory for the material", name));
        return RECORD_NONE;
    }
    m->record = make_record(from, entry ? entry->known : NULL, stated);
    read_extinction(from, m, entry, stated);
    m->record.emissivity_angles = 1;
    if (m->medium == RECORD_NONE)
        read_emissivity(from, m, entry, stated);
    else if (stated && stated->spectrum.node)
        scene_fail(from->reader, stated->spectrum.node,
                   "material %s: states spectrum_file and is transmissive, expected one of them",
                   m->name);
    m->layered = stated ? stated->layered : layered_matter_default();
    if (stated) {
        m->thickness_m = isnan(stated->thickness_cm) ? 0.0 : .01 * stated->thickness_cm;
        m->temperature_k = isnan(stated->temperature_k) ? 0.0 : stated->temperature_k;
        m->two_sided = stated->two_sided;
        m->power = stated->power;
    }
    if (m->medium == RECORD_NONE)
        check_material(from->reader, m, stated, stated ? stated->node : from->library.node);
    return s->material_count++;
}

/* The known name that is nearest to one that is not, as spelling_hint writes it. */
static const char *hint_for(const material_sources *from, const char *name,
                            char hint[SPELLING_HINT_SIZE])
{
    spelling near = spelling_of(name);

    for (size_t i = 0; from->reader->failure_count < HINTS && i < from->stated_count; i++)
        spelling_offer(&near, from->stated[i].name);
    scene_library_offer(&from->library, &near);
    return spelling_hint(&near, "", hint);
}

static void fail_unknown(const material_sources *from, const char *name, const char *user)
{
    char hint[SPELLING_HINT_SIZE];

    scene_fail(from->reader, from->library.node,
               "%s: material \"%s\" is neither in the library nor a [[material]]%s%s", user, name,
               from->aliases->count ? ", and no alias matches it" : "", hint_for(from, name, hint));
}

/* A material of the library: by its code in a .mat, or else, where the code is -1 or no .mat has it, by its name. */
static const library_entry *find_known(const material_sources *from, const char *name, int code)
{
    const library_entry *entry = code >= 0 ? scene_library_by_code(&from->library, code)
                                           : scene_library_by_name(&from->library, name);

    if (entry || code < 0) return entry;
    entry = scene_library_by_name(&from->library, name);
    return entry && entry->node ? entry : NULL;
}

static bool is_known(const material_sources *from, const char *name, int code)
{
    if (find_stated(from, name)) return true;
    return find_known(from, name, code) != NULL;
}

/* Every alias leads to a material, whether a mesh needs it or not. */
static void check_aliases(const material_sources *from)
{
    char where[512], hint[SPELLING_HINT_SIZE];

    if (from->library.node && !from->library.is_read) return; /* that has been told */
    for (size_t i = 0; i < from->aliases->count; i++) {
        const material_alias *a = &from->aliases->item[i];
        if (is_known(from, a->material, -1)) continue;
        material_alias_where(from->aliases, a, where, sizeof where);
        scene_took(from->reader,
                   status_set(STATUS_FORMAT,
                              "%s: alias \"%s\": material \"%s\" is neither in the library nor a "
                              "[[material]]%s",
                              where, a->pattern, a->material, hint_for(from, a->material, hint)));
    }
}

/* Finds a material by code, or by name where the code is -1; adds it at its first use.
 *   user   what names it, for the message */
static uint32_t use_material(const material_sources *from, const char *name, int code,
                             const char *user)
{
    scene *s = from->reader->s;
    const library_entry *known = NULL;
    stated_material own;
    const material_alias *alias =
        material_aliases_find(from->aliases, name, is_known(from, name, code));

    if (alias) {
        name = alias->material;
        code = -1;
    }
    const stated_material *stated = find_stated(from, name);
    known = find_known(from, name, stated ? -1 : code);
    if (!known && !stated) {
        if (alias) return RECORD_NONE; /* check_aliases tells it */
        if (from->library.node && !from->library.is_read)
            return RECORD_NONE; /* that has been told */
        if (code >= 0)
            scene_fail(from->reader, from->library.node,
                       "%s: material %d (%s) is not in the library", user, code, name);
        else
            fail_unknown(from, name, user);
        return RECORD_NONE;
    }
    const char *called = known ? known->name : name;
    const uint32_t number = number_of(from, from->used_numbers, called);
    if (number != s->material_count) return number;
    if (!stated && known->node) {
        own = scene_library_stated(&from->library, known, from->reader);
        stated = &own;
    }
    return add_material(from, called, known, stated);
}

/* Rows of the emissivity table: of all materials, then of all their diffuse lobes. */
static void place_rows(scene *s)
{
    uint32_t row = 0;

    for (uint32_t i = 0; i < s->material_count; i++) {
        s->materials[i].record.emissivity_first = row;
        row += s->materials[i].record.emissivity_angles;
    }
    for (uint32_t i = 0; i < s->material_count; i++) {
        const uint32_t rows = scene_lobe_rows(s, i);
        s->materials[i].record.lobe_first = rows > 0 ? row : RECORD_NONE;
        row += rows;
    }
}

static void use_all(const material_sources *from, const char *ground_material)
{
    scene *s = from->reader->s;
    const geometry *g = s->shape;

    s->ground_material = RECORD_NONE;
    s->materials = calloc(g->material_count + 1, sizeof *s->materials);
    s->material_of = calloc(g->material_count + 1, sizeof *s->material_of);
    if (!s->materials || !s->material_of) {
        scene_took(from->reader,
                   status_set(STATUS_MEMORY, "no memory for %u materials", g->material_count));
        return;
    }
    for (uint32_t i = 0; i < g->material_count; i++)
        s->material_of[i] =
            use_material(from, g->materials[i].name, g->materials[i].code, g->materials[i].path);
    if (ground_material)
        s->ground_material = use_material(from, ground_material, -1, "ground_material");
    material_aliases_warn(from->aliases, g);
    place_rows(s);
}

void scene_read_materials(scene_reader *reader, const char *ground_material)
{
    material_aliases aliases = {0};
    material_sources from = {.reader = reader, .aliases = &aliases};

    if (!scene_took(reader, name_table_open(&from.stated_numbers)) ||
        !scene_took(reader, name_table_open(&from.used_numbers)))
        goto out;
    scene_library_read(&from.library, reader);
    read_all_stated(&from);
    material_aliases_read(&aliases, reader);
    check_aliases(&from);
    if (reader->s->shape) use_all(&from, ground_material);
out:
    name_table_free(from.used_numbers);
    name_table_free(from.stated_numbers);
    scene_library_free(&from.library);
    material_aliases_free(&aliases);
    free(from.stated);
}

/* Keeps the named material of a library, or all. */
static void use_library(const material_sources *from, const char *name)
{
    scene *s = from->reader->s;

    s->materials = calloc(from->library.count + 1, sizeof *s->materials);
    if (!s->materials) {
        scene_took(from->reader, status_set(STATUS_MEMORY, "no memory for materials"));
        return;
    }
    for (size_t i = 0; i < from->library.count; i++) {
        s->medium_count = 0; /* a scene has few, a library any number */
        if (!name || !strcmp(name, from->library.entry[i].name))
            use_material(from, from->library.entry[i].name, -1, "library");
    }
    if (name && s->material_count == 0 && from->reader->failure_count == 0) {
        char hint[SPELLING_HINT_SIZE];
        scene_fail(from->reader, NULL, "unknown material '%s'%s", name, hint_for(from, name, hint));
    }
}

status scene_read_libraries(scene **out, const char *const *path, size_t count, const char *name,
                            scene_thermal thermal)
{
    status rc = STATUS_OK;
    scene_reader reader = {.s = calloc(1, sizeof(scene))};
    material_aliases aliases = {0};
    material_sources from = {.reader = &reader, .aliases = &aliases};

    NEED(reader.s, STATUS_MEMORY, "no memory for materials");
    reader.s->thermal = thermal;
    reader.s->path = strdup(path[0]);
    reader.s->folder = strdup("");
    NEED(reader.s->path && reader.s->folder, STATUS_MEMORY, "no memory for materials");
    TRY(name_table_open(&from.stated_numbers));
    TRY(name_table_open(&from.used_numbers));
    for (size_t i = 0; i < count; i++) {
        const char *own = scene_add_input(&reader, NULL, "", path[i]);
        if (own) scene_library_add(&from.library, &reader, own);
    }
    use_library(&from, name);
    if (reader.failure_count > 0) rc = reader.ending ? reader.ending : STATUS_FORMAT;
    if (rc != STATUS_OK) goto out;
    *out = reader.s;
    reader.s = NULL;
out:
    name_table_free(from.used_numbers);
    name_table_free(from.stated_numbers);
    scene_library_free(&from.library);
    scene_free(reader.s);
    return status_finish(rc);
}
