/* Render report: NAME.json, what a render was made from and with. */
#ifndef RENDER_REPORT_H
#define RENDER_REPORT_H

#include "files/input_hash.h"
#include "image/image.h"

typedef struct render_report_band {
    const char *name;
    double wavelength_min_um, wavelength_max_um;
    double gain, offset; /* counts per W m-2 sr-1, counts */
} render_report_band;

/* A setting is a number if its text is NULL. */
typedef struct render_report_setting {
    const char *key, *text;
    double number;
} render_report_setting;

typedef struct render_report_input {
    const char *path; /* as the scene names it */
    input_hash hash;
} render_report_input;

typedef struct render_report_stage {
    const char *name;
    double seconds;
} render_report_stage;

/* Texts may be NULL and are then null in the file. */
typedef struct render_report {
    const char *scene, *scene_path; /* the path as the user gave it */
    const char *mode, *thermal;
    const char *time;                               /* ISO 8601, UTC */
    double latitude_deg, longitude_deg, altitude_m; /* longitude east-positive */
    const char *platform, *device, *device_version;
    uint32_t columns, rows;
    const render_report_band *band; /* shape (band_count); so for all that follow */
    size_t band_count;
    const image_plane *plane;
    size_t plane_count;
    const image_label *material;
    size_t material_count;
    const char *const
        *spectrum; /* shape (material_count): what was measured, NULL: nothing; NULL: of none */
    const render_report_setting *setting;
    size_t setting_count;
    const render_report_input *input;
    size_t input_count;
    const char *warnings; /* a line each, as status_warnings gives them */
    const render_report_stage *stage;
    size_t stage_count;
} render_report;

/* Writes the file `name`. Numbers read back as they were; one that is not finite is null. A text that
 * is not UTF-8 is taken for Latin-1. */
status render_report_write(output_folder *folder, const char *name, const render_report *report);

#endif
