#include "motion.h"

#include <math.h>

#define DEGREES (M_PI / 180.0)

static const double steepest_deg = 89.9, nearest_m = 0.01;

/* A line of sight as distance, elevation above the horizon and azimuth clockwise from north. */
typedef struct sight {
    double distance_m, elevation_deg, azimuth_deg;
} sight;

static sight sight_of(const double from[3], const double to[3])
{
    const double east = to[0] - from[0], north = to[1] - from[1], up = to[2] - from[2];
    const double level = hypot(east, north);

    return (sight){hypot(level, up), atan2(up, level) / DEGREES, atan2(east, north) / DEGREES};
}

static void place(const double from[3], sight s, double out[3])
{
    const double level = s.distance_m * cos(s.elevation_deg * DEGREES);

    out[0] = from[0] + level * sin(s.azimuth_deg * DEGREES);
    out[1] = from[1] + level * cos(s.azimuth_deg * DEGREES);
    out[2] = from[2] + s.distance_m * sin(s.elevation_deg * DEGREES);
}

static void turn(sight *s, double azimuth_deg, double elevation_deg)
{
    s->azimuth_deg += azimuth_deg;
    s->elevation_deg = fmax(-steepest_deg, fmin(steepest_deg, s->elevation_deg + elevation_deg));
}

void motion_orbit(view *v, double right_deg, double up_deg)
{
    sight s = sight_of(v->target_m, v->position_m);

    turn(&s, -right_deg, up_deg);
    place(v->target_m, s, v->position_m);
}

void motion_turn(view *v, double right_deg, double up_deg)
{
    sight s = sight_of(v->position_m, v->target_m);

    turn(&s, right_deg, up_deg);
    place(v->position_m, s, v->target_m);
}

static void shift(view *v, const double by[3], double fraction)
{
    const double distance_m = sight_of(v->position_m, v->target_m).distance_m;

    for (int i = 0; i < 3; i++) {
        v->position_m[i] += by[i] * fraction * distance_m;
        v->target_m[i] += by[i] * fraction * distance_m;
    }
}

/* The camera as the render has it, about its own place. */
static camera_record camera_at(const view *v)
{
    view whole = *v;

    whole.crop = (view_crop){0};
    return view_camera(&whole, v->position_m);
}

static void unit(const float along[3], double out[3])
{
    const double x = (double)along[0], y = (double)along[1], z = (double)along[2];
    const double length = sqrt(x * x + y * y + z * z);

    out[0] = x / length;
    out[1] = y / length;
    out[2] = z / length;
}

void motion_pan(view *v, double right, double up)
{
    const camera_record c = camera_at(v);
    double across[3], down[3];

    unit(c.across, across);
    unit(c.down, down);
    shift(v, across, right);
    shift(v, down, -up);
}

void motion_fly(view *v, double forward, double right, double up)
{
    const double azimuth = sight_of(v->position_m, v->target_m).azimuth_deg * DEGREES;
    const double by[3] = {forward * sin(azimuth) + right * cos(azimuth),
                          forward * cos(azimuth) - right * sin(azimuth), up};

    shift(v, by, 1.0);
}

void motion_approach(view *v, double factor)
{
    sight s = sight_of(v->target_m, v->position_m);

    s.distance_m = fmax(nearest_m, s.distance_m / factor);
    place(v->target_m, s, v->position_m);
}

void motion_lens(view *v, double factor)
{
    v->focal_length_mm = fmax(0.1, fmin(1e6, v->focal_length_mm * factor));
    v->width_m /= factor;
}

void motion_ray(const view *v, double column, double row, double out_enu[3])
{
    const camera_record c = camera_at(v);
    double length = 0.0;

    for (int i = 0; i < 3; i++) {
        const double aside = column * (double)c.across[i] + row * (double)c.down[i];
        out_enu[i] = (double)c.corner[i] + (c.is_orthographic ? 0.0 : aside);
        length = hypot(length, out_enu[i]);
    }
    for (int i = 0; i < 3; i++) out_enu[i] /= length;
}

void motion_look_at(view *v, double column, double row, double range_m)
{
    double ray[3];

    const camera_record c = camera_at(v);

    motion_ray(v, column, row, ray);
    for (int i = 0; i < 3; i++) {
        const double aside = (double)c.position[i] + column * (double)c.across[i] +
                             row * (double)c.down[i]; /* of the ray's origin */
        v->target_m[i] = v->position_m[i] + (c.is_orthographic ? aside : 0.0) + range_m * ray[i];
    }
}

void motion_north(const view *v, double *out_right, double *out_down)
{
    const camera_record c = camera_at(v);
    double across[3], down[3];

    unit(c.across, across);
    unit(c.down, down);
    *out_right = across[1];
    *out_down = down[1];
}
