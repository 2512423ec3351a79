/* Render output: renders a scene into a folder: ENVI cube and truth, OpenEXR, pictures, report. */
#ifndef RENDER_OUTPUT_H
#define RENDER_OUTPUT_H

#include "render/render.h"

#include <stdatomic.h>

/* Above this many bands the planes per band but the radiance are left out unless they are asked
 * for, three radiances become pictures, and the OpenEXR is written on request. */
enum { RENDER_OUTPUT_BANDS = 16 };

typedef struct render_output_options {
    const char *scene_path; /* as the user gave it */
    const char *folder;
    const char *planes; /* truth planes, names with commas between; NULL: the default ones */
    bool wants_probe;   /* of pixel (column, row), counted from 0 at the top left: render_probe.h */
    uint32_t probe[2];
    bool wants_exr;      /* also above RENDER_OUTPUT_BANDS bands */
    bool shows_progress; /* on stderr */
    atomic_int *percent; /* of the pixels, as they are done; NULL: nobody asks */
} render_output_options;

/* Renders on the devices and writes NAME.img, NAME_truth.img, their headers, NAME.exr,
 * NAME_<plane>.png and NAME.json; all of them appear together at the end, or nothing does. Of a
 * scene with several times each goes into a folder of its own, named by its local time as
 * 19870624T100000-0500, identical to a render of that time alone; written in order. */
status render_output(const scene *s, device *const *dev, size_t dev_count,
                     const render_output_options *options);

#endif
