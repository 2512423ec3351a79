#include "scene/view.h"

#include "base/vector.h"
#include "files/output_file.h"
#include "files/record_file.h"

#include <math.h>
#include <string.h>

#define DEGREES (M_PI / 180.0)

static const double film_width_mm = 36.0, angle_tolerance_deg = 0.1;

bool view_fits(int columns, int rows)
{
    return (int64_t)columns * rows <= VIEW_PIXELS;
}

static void to_enu(const double north_west_up[3], double out[3])
{
    out[0] = -north_west_up[1];
    out[1] = north_west_up[0];
    out[2] = north_west_up[2];
}

/* Elevation and azimuth (counterclockwise from north) of the sensor, seen from the target. */
static void check_angles(const view *v, const double angles_deg[3], const char *path, int line)
{
    const double east = v->position_m[0] - v->target_m[0],
                 north = v->position_m[1] - v->target_m[1];
    const double level = hypot(east, north), up = v->position_m[2] - v->target_m[2];
    const double elevation = atan2(up, level) / DEGREES, azimuth = atan2(-east, north) / DEGREES;
    const int steep = level < 1e-9 * fabs(up);

    if (fabs(angles_deg[0] - elevation) > angle_tolerance_deg ||
        (!steep && fabs(remainder(angles_deg[1] - azimuth, 360.0)) > angle_tolerance_deg))
        status_warn("%s:%d: found elevation %g and azimuth %g, target and position give %.3f and "
                    "%.3f, which are used",
                    path, line, angles_deg[0], angles_deg[1], elevation, azimuth);
}

static status read_pixels(view *v, record_file *file)
{
    status rc = STATUS_OK;
    double pixels[2];

    TRY(record_file_numbers(file, 2, pixels, "the numbers of columns and rows"));
    for (int i = 0; i < 2; i++) {
        if (pixels[i] >= 1.0 && pixels[i] <= VIEW_SIDE && pixels[i] == floor(pixels[i])) continue;
        rc = record_file_reject(file, "columns and rows, whole numbers from 1 to %d", VIEW_SIDE);
        goto out;
    }
    v->columns = (int)pixels[0];
    v->rows = (int)pixels[1];
out:
    return rc;
}

static status read_view(view *v, record_file *file, const char *path)
{
    status rc = STATUS_OK;
    double target[3], position[3], angles_deg[3];

    TRY(record_file_numbers(file, 3, target, "the target's x, y and z in m"));
    TRY(record_file_numbers(file, 3, position, "the sensor's x, y and z in m"));
    if (memcmp(target, position, sizeof target) == 0) {
        rc = record_file_reject(file, "a sensor away from its target");
        goto out;
    }
    to_enu(target, v->target_m);
    to_enu(position, v->position_m);
    TRY(record_file_numbers(file, 3, angles_deg, "elevation, azimuth and twist in degrees"));
    v->twist_deg = angles_deg[2];
    check_angles(v, angles_deg, path, record_file_line(file));
    TRY(record_file_number(file, 0.1, 1e6, &v->focal_length_mm, "the focal length in mm"));
    TRY(read_pixels(v, file));
    TRY(record_file_finish(file));
out:
    return rc;
}

status view_read(view *out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    view v = {0};

    TRY(record_file_open(&file, path));
    TRY(read_view(&v, file, path));
    *out = v;
out:
    record_file_free(file);
    return rc;
}

status view_write(const view *v, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;
    const double east = v->position_m[0] - v->target_m[0],
                 north = v->position_m[1] - v->target_m[1];
    const double up = v->position_m[2] - v->target_m[2];

    NEED(!(v->width_m > 0.0), STATUS_ARGUMENT,
         "%s: found an orthographic view, expected a perspective one", path);
    TRY(output_file_open(&file, path));
    fprintf(output_file_stream(file), "%.17g %.17g %.17g\n%.17g %.17g %.17g\n", v->target_m[1],
            -v->target_m[0], v->target_m[2], v->position_m[1], -v->position_m[0], v->position_m[2]);
    fprintf(output_file_stream(file), "%.6f %.6f %.17g\n%.17g\n%d %d\n",
            atan2(up, hypot(east, north)) / DEGREES, atan2(-east, north) / DEGREES, v->twist_deg,
            v->focal_length_mm, v->columns, v->rows);
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

status view_write_table(const view *v, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    fprintf(output_file_stream(file),
            "[camera]\nposition_m = [%.17g, %.17g, %.17g]\ntarget_m = [%.17g, %.17g, %.17g]\n",
            v->position_m[0], v->position_m[1], v->position_m[2], v->target_m[0], v->target_m[1],
            v->target_m[2]);
    fprintf(output_file_stream(file), "twist_deg = %.17g\n", v->twist_deg);
    if (v->width_m > 0.0)
        fprintf(output_file_stream(file), "projection = \"orthographic\"\nwidth_m = %.17g\n",
                v->width_m);
    else
        fprintf(output_file_stream(file), "focal_length_mm = %.17g\n", v->focal_length_mm);
    fprintf(output_file_stream(file), "pixels = [%d, %d]\n",
            v->crop.columns ? v->crop.columns : v->columns,
            v->crop.columns ? v->crop.rows : v->rows);
    if (v->crop.columns)
        fprintf(output_file_stream(file), "crop = [%d, %d, %d, %d]\n", v->crop.column, v->crop.row,
                v->columns, v->rows);
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

static void normalise(double a[3])
{
    const double length = vector_length(a);

    for (int i = 0; i < 3; i++) a[i] /= length;
}

/* Unit vectors along the line of sight, to the right and up in the picture. The rows of the matrix
 * T of thesis 2.5.3 with omega = 90 - elevation, kappa = azimuth + 90; departs: the twist turns about
 * the line of sight, which T's middle angle leaves (docs/departures.md). */
static void view_axes(const view *v, double sight[3], double right[3], double up[3])
{
    static const double zenith[3] = {0.0, 0.0, 1.0}, north[3] = {0.0, 1.0, 0.0};
    const double cos_twist = cos(v->twist_deg * DEGREES), sin_twist = sin(v->twist_deg * DEGREES);

    for (int i = 0; i < 3; i++) sight[i] = v->target_m[i] - v->position_m[i];
    normalise(sight);
    vector_cross(sight, hypot(sight[0], sight[1]) > 1e-9 ? zenith : north, right);
    normalise(right);
    vector_cross(right, sight, up);
    for (int i = 0; i < 3; i++) {
        const double untwisted = right[i];
        right[i] = cos_twist * untwisted - sin_twist * up[i];
        up[i] = cos_twist * up[i] + sin_twist * untwisted;
    }
}

/* eq. 2.5.3-2 in lengths of the line of sight, without its last term, which would make a point. */
camera_record view_camera(const view *v, const double origin_m[3])
{
    double sight[3], right[3], up[3];
    const int columns = v->crop.columns ? v->crop.columns : v->columns;
    const int rows = v->crop.columns ? v->crop.rows : v->rows;
    const bool flat = v->width_m > 0.0;
    const double pixel = (flat ? v->width_m : film_width_mm / v->focal_length_mm) / columns;
    camera_record camera = {.first_column = (uint32_t)v->crop.column,
                            .first_row = (uint32_t)v->crop.row,
                            .is_orthographic = flat};

    view_axes(v, sight, right, up);
    for (int i = 0; i < 3; i++) {
        const double to_corner = 0.5 * pixel * (up[i] * rows - right[i] * columns);
        camera.position[i] = (float)(v->position_m[i] - origin_m[i] + (flat ? to_corner : 0.0));
        camera.across[i] = (float)(right[i] * pixel);
        camera.down[i] = (float)(-up[i] * pixel);
        camera.corner[i] = (float)(sight[i] + (flat ? 0.0 : to_corner));
    }
    return camera;
}
