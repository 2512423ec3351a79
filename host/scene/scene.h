/* Scene: everything that a render is made from, read from scene.toml and the files that it names.
 * Read-only once it is read. Thesis 2.5. */
#ifndef SCENE_H
#define SCENE_H

#include "base/name_table.h"
#include "files/file_stamp.h"
#include "files/input_hash.h"
#include "kernels/media/transmission.h"
#include "material/emissivity.h"
#include "material/extinction.h"
#include "material/heat_schedule.h"
#include "material/heat_weight.h"
#include "material/layered.h"
#include "material/scattering.h"
#include "mesh/geometry.h"
#include "scene/view.h"
#include "sensor/band.h"
#include "sensor/detector_settings.h"
#include "sky/atmosphere.h"
#include "sky/site.h"
#include "weather/forcing.h"
#include "weather/weather.h"

#include <stdbool.h>

/* Times of one scene, at most: a day by quarters of an hour. */
enum { SCENE_TIMES = 96 };

typedef enum scene_thermal {
    SCENE_THERMAL_FIXED, /* every facet keeps its stated temperature */
    SCENE_THERMAL_THERM,
    SCENE_THERMAL_LAYERED
} scene_thermal;

/* A material that the scene uses. */
typedef struct scene_material {
    char *name;
    material_record record; /* emissivity_first counts rows of all materials in their order */
    emissivity *table;      /* NULL: grey */
    char *spectrum;      /* what was measured and how it is used, a line; NULL: no spectrum_file */
    heat_mean sun, body; /* what heat exchange takes of a spectrum; unused without one */
    double grey_emissivity; /* at all angles and wavelengths; unused with a table */
    double thickness_m;     /* of facets that state none; 0: not stated */
    double temperature_k;   /* for thermal fixed and of bodies; 0: not stated */
    bool two_sided;
    layered_matter layered;
    uint32_t medium; /* index among the transmissive materials; RECORD_NONE: opaque */
    extinction *extinction;
    scattering *scattering;       /* NULL: does not scatter */
    double grey_extinction_per_m; /* without a table */
    heat_schedule power;
} scene_material;

/* "fixed", "therm", "layered". */
const char *scene_thermal_name(scene_thermal thermal);

/* A file that the scene was read from, and the hash of what was read. */
typedef struct scene_input {
    char *name;       /* as the scene states it */
    char *path;       /* where it was found */
    file_stamp stamp; /* before it was opened */
    input_hash hash;
} scene_input;

typedef struct scene {
    char *path, *folder, *name;
    site place;        /* its time is the first of the times */
    size_t time_count; /* 1 or more */
    double *time_s;    /* shape (time_count): UTC since 1970, all of one local day */
    weather *history;  /* NULL with thermal fixed and no [weather] */
    forcing_laws laws;
    atmosphere *air;
    bool is_uniform; /* the sky goes all round, below the horizon too */
    geometry *shape;
    uint32_t material_count;
    scene_material *materials; /* shape (material_count) */
    uint32_t *material_of;     /* shape (shape->material_count), index into materials */
    uint32_t medium_count;     /* transmissive materials */
    uint32_t medium_material[TRANSMISSION_MEDIA]; /* index into materials */
    uint32_t ground_material; /* index into materials; RECORD_NONE: no ground plane */
    double ground_thickness_m;
    double ground_z_m; /* ENU: of the largest level facet of its material, else the lowest point */
    view camera;
    uint32_t band_count;
    band *bands; /* shape (band_count) */
    detector_settings sensor;
    bool thesis;
    uint32_t
        samples_per_side; /* a pixel is the mean of so many samples across and down; 1: its middle */
    uint32_t seed;        /* of random numbers */
    scene_thermal thermal;
    /* With thermal layered heat passes from facet to facet: along a material, by longwave. */
    bool lateral_conduction, facet_longwave;
    uint32_t
        depth; /* facets that light meets behind a pixel's: interreflection.h; 0: as it takes */
    double hemisphere_zenith_step_deg, hemisphere_azimuth_step_deg;
    size_t input_count;
    scene_input *inputs;
    name_table *input_numbers; /* by path: indices into inputs; NULL: there are none yet */
} scene;

/* Reads a scene.
 *   setting   shape (setting_count): "table.key=value", as --set takes them
 * Goes on after an error to find the others: status_message then holds a line for each, with file
 * and line. What is odd but usable is warned about. */
status scene_read(scene **out, const char *path, const char *const *setting, size_t setting_count);
void scene_free(scene *s);

/* Reads materials of libraries (.mat, .toml) as a scene of nothing else.
 *   name      of the only one that is kept; NULL: all
 *   thermal   what they must have the heat for
 * Fails as scene_read does, and where no material has that name. */
status scene_read_libraries(scene **out, const char *const *path, size_t count, const char *name,
                            scene_thermal thermal);

/* Drops all bands but those named in a list with commas between. Fails with STATUS_ARGUMENT if there
 * is no band of a name. */
status scene_keep_bands(scene *s, const char *names);

/* How bands are integrated: over the database's points in thesis mode, if there is a database. */
band_quadrature scene_quadrature(const scene *s);

/* Number of rows in the emissivity table of all materials: 91 or 1 each, and behind them all the
 * rows of diffuse lobes (lobe.h). */
uint32_t scene_emissivity_rows(const scene *s);

/* Whether a material has a specular fraction that is rough. */
bool scene_is_rough(const scene *s);

/* Rows of a material's diffuse lobe: 0 in thesis mode and where the emissivity has no angles. */
uint32_t scene_lobe_rows(const scene *s, uint32_t material);

/* Rings of these lobes: those of the hemisphere, joined where they or the sky's directions are many; 1
 * where no emissivity has angles. */
uint32_t scene_lobe_rings(const scene *s);

/* Writes what a facet is, for messages: its file, object, part and material; the ground's is facet_count.
 * Returns out. */
const char *scene_facet_text(const scene *s, uint32_t facet, char *out, size_t size);

/* Fills the records of the facets and, behind them, of the ground plane if there is one.
 *   out   shape (facet_count + 1) */
void scene_facet_records(const scene *s, facet_record *out);

#endif
