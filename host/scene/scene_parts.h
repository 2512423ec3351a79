/* Scene parts: the tables of scene.toml, one function each, in the order in which they need each
 * other. Failures are counted in the reader. */
#ifndef SCENE_PARTS_H
#define SCENE_PARTS_H

#include "scene/scene_table.h"

/* [site] and [weather]; the name of the ground's material is set where there is one. */
void scene_read_site(scene_reader *reader, const char **out_ground_material);
void scene_read_weather(scene_reader *reader);

/* [camera], [[band]], [render]. */
void scene_read_camera(scene_reader *reader);
void scene_read_bands(scene_reader *reader);
void scene_read_render(scene_reader *reader);

/* [sensor]; after camera and bands. */
void scene_read_detector(scene_reader *reader);

/* [atmosphere]; after the bands. */
void scene_read_atmosphere(scene_reader *reader);

/* [[geometry]]. */
void scene_read_geometry(scene_reader *reader);

/* The keys of a [[material]] that thermal = "layered" uses; without them `out` is left as it is. */
void scene_read_layered(scene_table *t, layered_matter *out);

/* Makes a material transmissive where it has an extinction: a file, or a number unless that is
 * not-a-number. Extinction per m, at most TRANSMISSION_MEDIA materials.
 *   node   what the message about a material too many names */
void scene_read_medium(scene_reader *reader, scene_material *m, const toml_node *node,
                       const char *path, double per_km);

/* Makes a transmissive material scatter by a table.
 *   node   what the message about an opaque one names */
void scene_read_scattering(scene_reader *reader, scene_material *m, const toml_node *node,
                           const char *path);

enum { SPECTRUM_FILES = 16 };

/* What a [[material]] states of its spectrum. */
typedef struct stated_spectrum {
    const toml_node *node; /* of spectrum_file */
    size_t count;          /* 0: it states none */
    const char *path[SPECTRUM_FILES], *record, *wavelength_path;
    const double *angle_deg; /* shape (count); NULL: the files join */
    int law;                 /* emissivity_law */
    double outside;          /* not-a-number: held, if that is stated */
    bool states_outside, accepts_geometry;
} stated_spectrum;

/* States no spectrum. */
stated_spectrum stated_spectrum_default(void);

/* The keys of a [[material]] that tell of its spectrum; without them `out` is left as it is. */
void scene_read_spectrum(scene_table *t, stated_spectrum *out);

/* Reads the files and gives the material the emissivity that they make, and with it what heat exchange takes of
 * it where that is not a number yet; after the bands. */
void scene_take_spectrum(scene_reader *reader, scene_material *m, const stated_spectrum *stated);

/* The first wavelength that a band needs and a grid does not cover, and the band; not-a-number: there is none. */
double scene_uncovered(const scene *s, const wavelength_grid *grid, const band **out_band);

/* Gives bands the samples that they need beside their own, so that their integrals of the materials' spectra are
 * right; when all else is read. */
void scene_place_samples(scene_reader *reader);

/* Checks that bodies are closed, face outwards and have a temperature; when all else is read. */
void scene_check_media(scene_reader *reader);

/* The power by the clock of a [[material]]; `out` is empty. */
void scene_read_power(scene_table *t, heat_schedule *out);

/* [library] and [[material]]; after geometry and render: only what is used is kept. */
void scene_read_materials(scene_reader *reader, const char *ground_material);

#endif
