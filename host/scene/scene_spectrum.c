#include "files/file_name.h"
#include "scene/scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NOTE_SIZE 1024
#define INFRARED_UM 3.0    /* beyond, heat is emitted rather than sunlight reflected */
#define MEASURED_LEAST 0.6 /* of a weight, without a warning */

/* Adds a file, and of an ENVI spectral library both of its files. */
static const char *add_file(scene_reader *reader, const toml_node *node, const char *name)
{
    const char *const folder = scene_reader_folder(reader);
    const size_t length = strlen(name);
    char other[4096];

    if (length < sizeof other && file_name_ends(name, ".sli")) {
        snprintf(other, sizeof other, "%.*s.hdr", (int)length - 4, name);
        if (!scene_add_input(reader, node, folder, other)) return NULL;
    }
    if (length < sizeof other && file_name_ends(name, ".hdr")) {
        snprintf(other, sizeof other, "%.*s.sli", (int)length - 4, name);
        if (!scene_add_input(reader, node, folder, other)) return NULL;
    }
    return scene_add_input(reader, node, folder, name);
}

static void read_files(scene_table *t, stated_spectrum *out)
{
    const char *const *name, *one;
    char message[512];
    size_t count = 1;

    const toml_node *node = scene_table_node(t, "spectrum_file");
    if (!node) return;
    out->node = node;
    const int failed =
        toml_node_kind(out->node) == TOML_ARRAY
            ? toml_node_strings(&name, &count, out->node, message, sizeof message)
            : (name = &one, toml_node_string(&one, out->node, message, sizeof message));
    if (failed) {
        scene_took(t->reader, status_set(STATUS_FORMAT, "%s", message));
        return;
    }
    if (count < 1 || count > SPECTRUM_FILES) {
        scene_fail(t->reader, out->node, "%s: found %zu files, expected 1 to %d",
                   toml_node_name(out->node), count, SPECTRUM_FILES);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        out->path[i] = add_file(t->reader, out->node, name[i]);
        if (!out->path[i]) return;
    }
    out->count = count;
}

static void read_angles(scene_table *t, stated_spectrum *out)
{
    const toml_node *node = scene_table_node(t, "angle_deg");
    char message[512];
    size_t count;

    if (!node) return;
    if (toml_node_numbers(&out->angle_deg, &count, node, message, sizeof message) != 0) {
        scene_took(t->reader, status_set(STATUS_FORMAT, "%s", message));
        return;
    }
    bool is_right = count == out->count && count >= 2;
    for (size_t i = 0; is_right && i < count; i++)
        is_right = out->angle_deg[i] >= 0.0 && out->angle_deg[i] <= 90.0 &&
                   (i == 0 || out->angle_deg[i] > out->angle_deg[i - 1]);
    if (!is_right && out->count > 0)
        scene_fail(t->reader, node,
                   "%s: found %s, expected an angle of 0 to 90 degrees for each of 2 files or "
                   "more, rising",
                   toml_node_name(node), toml_node_text(node));
    out->law = EMISSIVITY_MEASURED;
}

/* "hold" or a number. */
static void read_outside(scene_table *t, stated_spectrum *out)
{
    static const char *const words[] = {"hold"};
    const toml_node *node = scene_table_node(t, "outside");
    int word;

    if (!node) return;
    out->states_outside = true;
    out->outside = NAN;
    if (toml_node_kind(node) == TOML_NUMBER)
        scene_table_number(t, "outside", 0.0, 1.0, &out->outside);
    else
        scene_table_word(t, "outside", words, 1, &word);
}

stated_spectrum stated_spectrum_default(void)
{
    return (stated_spectrum){.outside = NAN};
}

void scene_read_spectrum(scene_table *t, stated_spectrum *out)
{
    static const char *const laws[] = {"constant", "fresnel", "rough", "thesis"};
    static const char *const others[] = {"record",    "wavelength_file", "angular",
                                         "angle_deg", "accept_geometry", "outside"};

    read_files(t, out);
    if (out->node && scene_table_has(t, "emissivity_file"))
        scene_fail(t->reader, out->node, "%s: found emissivity_file too, expected one of them",
                   toml_node_name(out->node));
    read_outside(t, out);
    scene_table_string(t, "record", &out->record);
    scene_table_file(t, "wavelength_file", &out->wavelength_path);
    scene_table_word(t, "angular", laws, sizeof laws / sizeof *laws, &out->law);
    if (scene_table_has(t, "angular") && scene_table_has(t, "angle_deg"))
        scene_fail(t->reader, toml_node_get(t->node, "angle_deg"),
                   "%s: found angular too, expected one of them", toml_node_name(t->node));
    read_angles(t, out);
    scene_table_bool(t, "accept_geometry", &out->accepts_geometry);
    for (size_t i = 0; !out->node && i < sizeof others / sizeof *others; i++)
        if (scene_table_has(t, others[i]))
            scene_fail(t->reader, toml_node_get(t->node, others[i]),
                       "%s: is stated without spectrum_file",
                       toml_node_name(toml_node_get(t->node, others[i])));
}

/* Warns of what tells reflectance between two directions only; where heat is emitted, refuses it. */
static status check_geometry(const spectral_curve *c, const char *path,
                             const stated_spectrum *stated)
{
    status rc = STATUS_OK;
    const double last_um = c->grid.wavelength_um[c->grid.count - 1];

    NEED(c->quantity != SPECTRAL_TRANSMITTANCE, STATUS_FORMAT,
         "%s: found transmittance, expected emissivity, reflectance or optical constants", path);
    if (!c->is_directional) goto out;
    NEED(stated->accepts_geometry || last_um <= INFRARED_UM, STATUS_FORMAT,
         "%s: found reflectance between two directions (%s) to %g um, expected "
         "directional-hemispherical "
         "one beyond %g um, or accept_geometry = true",
         path, c->measurement, last_um, INFRARED_UM);
    status_warn("%s: its reflectance was measured between two directions (%s): 1 - r is no "
                "emissivity unless "
                "the surface reflects alike in all directions",
                path, c->measurement);
out:
    return rc;
}

static status join(spectral_curve **all, spectral_curve **next, const stated_spectrum *stated,
                   size_t index)
{
    status rc = STATUS_OK;
    double overlap_um[2];

    NEED((*all)->quantity == (*next)->quantity, STATUS_FORMAT, "%s: found %s, expected %s as of %s",
         stated->path[index], spectral_curve_quantity_name((*next)->quantity),
         spectral_curve_quantity_name((*all)->quantity), stated->path[0]);
    TRY(spectral_curve_join(*all, *next, overlap_um));
    if (!isnan(overlap_um[0]))
        status_warn(
            "%s: from %.4g to %.4g um the files before it have values too, and theirs are taken",
            stated->path[index], overlap_um[0], overlap_um[1]);
    spectral_curve_free(*next);
    *next = NULL;
out:
    return rc;
}

/* Reads all files: curves of angles, or one that they join to.
 *   out   shape (SPECTRUM_FILES), NULL where there is no more */
static status read_curves(spectral_curve **out, const stated_spectrum *stated, bool *out_reflects)
{
    status rc = STATUS_OK;
    size_t count = 0;

    for (size_t i = 0; i < stated->count; i++) {
        const spectral_source source = {stated->path[i], stated->record, stated->wavelength_path};
        TRY(spectral_curve_read(&out[count], &source));
        TRY(check_geometry(out[count], stated->path[i], stated));
        *out_reflects |= out[count]->quantity == SPECTRAL_REFLECTANCE;
        spectral_curve_take_kirchhoff(out[count]);
        if (count > 0 && !stated->angle_deg)
            TRY(join(&out[0], &out[count], stated, i));
        else
            count++;
    }
    NEED(!stated->angle_deg || out[0]->quantity == SPECTRAL_EMISSIVITY, STATUS_FORMAT,
         "%s: found optical constants, expected emissivity or reflectance for angle_deg",
         stated->path[0]);
out:
    return rc;
}

/* Fails where a band needs what was not measured. */
static void check_bands(scene_reader *reader, const scene_material *m,
                        const stated_spectrum *stated)
{
    char ranges[NOTE_SIZE];
    const band *b = NULL;
    const double um = scene_uncovered(reader->s, &m->table->grid, &b);

    if (!stated->states_outside && !isnan(um))
        scene_fail(reader, stated->node,
                   "material %s: band %s needs %.4g um, the spectrum has %s um, and a tenth of a "
                   "wavelength beyond: expected a further file, or outside = \"hold\" or a number",
                   m->name, b->name, um,
                   wavelength_grid_text(&m->table->grid, ranges, sizeof ranges));
}

/* Sets what heat exchange takes of the spectrum where nothing else is stated. */
static void take_heat(scene_reader *reader, const scene_material *m, const stated_spectrum *stated,
                      const heat_mean *mean, float *out, const char *key, const char *weight)
{
    if (!isnan(*out)) return;
    *out = (float)mean->value;
    if (reader->s->thermal == SCENE_THERMAL_FIXED) return;
    if (mean->missing_share > HEAT_WEIGHT_MISSING && !stated->states_outside)
        scene_fail(reader, stated->node,
                   "material %s: the spectrum lacks %.0f %% of %s: expected a further file, %s, or "
                   "outside = "
                   "\"hold\" or a number",
                   m->name, 100.0 * mean->missing_share, weight, key);
    else if (mean->measured_share < MEASURED_LEAST)
        status_warn("%s: material %s: %s is %.3f by %.0f %% of %s, the rest was not measured",
                    toml_node_where(stated->node), m->name, key, mean->value,
                    100.0 * mean->measured_share, weight);
}

static status describe(scene_material *m, const stated_spectrum *stated, bool reflects)
{
    static const char *const laws[] = {
        "the same at all angles", "Fresnel of the normal one", "rough", "as in 1994",
        "measured at angles",     "Fresnel of n and k"};
    status rc = STATUS_OK;
    char text[NOTE_SIZE], ranges[NOTE_SIZE / 2];

    snprintf(text, sizeof text, "%zu wavelengths, %s um, %s%s; outside %s", m->table->grid.count,
             wavelength_grid_text(&m->table->grid, ranges, sizeof ranges),
             reflects ? "1 - reflectance (Kirchhoff), " : "", laws[m->table->law],
             !stated->states_outside  ? "held for a tenth of a wavelength"
             : isnan(stated->outside) ? "held"
                                      : "a number");
    m->spectrum = strdup(text);
    NEED(m->spectrum, STATUS_MEMORY, "no memory for a material");
out:
    return rc;
}

void scene_take_spectrum(scene_reader *reader, scene_material *m, const stated_spectrum *stated)
{
    spectral_curve *curve[SPECTRUM_FILES + 1] = {NULL};
    bool reflects = false;
    const size_t count = stated->angle_deg ? stated->count : 1;

    if (stated->count == 0) return;
    if (!scene_took(reader, read_curves(curve, stated, &reflects)) ||
        !scene_took(reader, emissivity_make(&m->table, curve, stated->angle_deg, count,
                                            (emissivity_law)stated->law)))
        goto out;
    m->table->outside = stated->outside;
    m->record.emissivity_angles = emissivity_rows(m->table);
    if (!scene_took(reader, describe(m, stated, reflects))) goto out;
    check_bands(reader, m, stated);
    m->sun = heat_weight_sun(m->table);
    m->body = heat_weight_300k(m->table);
    take_heat(reader, m, stated, &m->sun, &m->record.solar_absorptance, "solar_absorptance",
              "sunlight");
    take_heat(reader, m, stated, &m->body, &m->record.thermal_emissivity, "emissivity",
              "what a body of 300 K emits");
out:
    for (size_t i = 0; i < SPECTRUM_FILES; i++) spectral_curve_free(curve[i]);
}
