#include "scene/scene_parts.h"

static const double LARGEST = 1e30;

/* Two keys of which neither means anything without the other. */
static void read_pair(scene_table *t, const char *one, double *out_one, const char *other,
                      double *out_other, double most)
{
    const bool has_one = scene_table_number(t, one, 1e-9, most, out_one);
    const bool has_other = scene_table_number(t, other, 1e-9, most, out_other);

    if (has_one && !has_other) scene_table_require(t, other, "a number, as the other of the two");
    if (has_other && !has_one) scene_table_require(t, one, "a number, as the other of the two");
}

static void read_spread(scene_table *t, detector_settings *d)
{
    const char *path;
    double step = 1.0;

    scene_table_number(t, "gaussian_fwhm_px", 0.0, PSF_REACH / 2, &d->gaussian_fwhm_px);
    scene_table_number(t, "box_px", 0.0, PSF_REACH, &d->box_px);
    scene_table_number(t, "motion_px", 0.0, PSF_REACH, &d->motion_px);
    scene_table_number(t, "motion_deg", -360.0, 360.0, &d->motion_deg);
    read_pair(t, "airy_f_number", &d->airy_f_number, "pixel_pitch_um", &d->pixel_pitch_um, 1e4);
    if (scene_table_file(t, "psf", &path)) scene_took(t->reader, psf_read(&d->table, path));
    scene_table_whole(t, "detector_px", 1.0, PSF_REACH, &step);
    d->step = (int)step;
}

static void read_noise(scene_table *t, detector_settings *d)
{
    d->netd_at_k = 300.0;
    scene_table_number(t, "netd_k", 0.0, 1e4, &d->netd_k);
    scene_table_number(t, "netd_at_k", 50.0, 6000.0, &d->netd_at_k);
    scene_table_number(t, "nesr_w_m2_sr_um", 0.0, LARGEST, &d->nesr);
    scene_table_number(t, "electrons_per_w_m2_sr", 0.0, LARGEST, &d->electrons);
    scene_table_number(t, "read_electrons", 0.0, LARGEST, &d->read_electrons);
    scene_table_number(t, "fixed_gain", 0.0, 1.0, &d->fixed_gain);
    scene_table_number(t, "fixed_offset_w_m2_sr_um", 0.0, LARGEST, &d->fixed_offset);
    read_pair(t, "periodic_w_m2_sr_um", &d->periodic, "periodic_px", &d->periodic_px, LARGEST);
    scene_table_number(t, "periodic_deg", -360.0, 360.0, &d->periodic_deg);
    if (d->read_electrons > 0.0 && !(d->electrons > 0.0))
        scene_table_require(t, "electrons_per_w_m2_sr", "electrons, beside read_electrons");
}

/* A count needs a gain. */
static void check_gains(scene_reader *reader, const toml_node *node)
{
    const scene *s = reader->s;

    for (uint32_t i = 0; i < s->band_count; i++)
        if (s->bands[i].gain == 0.0)
            scene_fail(reader, node, "sensor.bits: the gain of band %s is 0", s->bands[i].name);
}

static void check_size(scene_reader *reader, const toml_node *node)
{
    const scene *s = reader->s;

    if (s->sensor.step > s->camera.columns || s->sensor.step > s->camera.rows)
        scene_fail(reader, node, "sensor.detector_px: found %d, the picture has %d x %d pixels",
                   s->sensor.step, s->camera.columns, s->camera.rows);
}

void scene_read_detector(scene_reader *reader)
{
    const toml_node *node = toml_node_get(reader->root, "sensor");
    scene_table t = scene_table_open(reader, node, "sensor");
    detector_settings *d = &reader->s->sensor;
    const int failures = reader->failure_count;
    double seed = 0.0, frame = 0.0, bits = 0.0;

    d->step = 1;
    if (!t.node) return;
    d->is_wanted = true;
    scene_table_whole(&t, "seed", 0.0, UINT32_MAX, &seed);
    scene_table_whole(&t, "frame", 0.0, UINT32_MAX, &frame);
    read_spread(&t, d);
    read_noise(&t, d);
    if (scene_table_whole(&t, "bits", 1.0, 24.0, &bits)) check_gains(reader, node);
    d->seed = (uint32_t)seed;
    d->frame = (uint32_t)frame;
    d->bits = (int)bits;
    scene_table_close(&t);
    if (reader->failure_count == failures) check_size(reader, node);
}
