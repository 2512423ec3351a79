/* Motion: how a camera moves. All keep the lens, the size and the twist of the view. */
#ifndef MOTION_H
#define MOTION_H

#include "scene/view.h"

/* Turns the camera about its target: to its right, and up to straight above or below it. */
void motion_orbit(view *v, double right_deg, double up_deg);

/* Turns the head: the target moves about the camera. */
void motion_turn(view *v, double right_deg, double up_deg);

/* Moves camera and target by shares of their distance: along the picture's columns and rows. */
void motion_pan(view *v, double right, double up);

/* Moves camera and target by shares of their distance: forward and right at one height, and up. */
void motion_fly(view *v, double forward, double right, double up);

/* Brings the camera nearer to its target, above 1, or away from it. */
void motion_approach(view *v, double factor);

/* Makes the lens longer, above 1, or shorter; it stays between 0.1 and 1e6 mm. */
void motion_lens(view *v, double factor);

/* The unit direction of a pixel's ray. column, row   from the top left corner, centres at 0.5 */
void motion_ray(const view *v, double column, double row, double out_enu[3]);

/* Looks at the point that a pixel shows at a range: it becomes the target. */
void motion_look_at(view *v, double column, double row, double range_m);

/* Sets where north points in the picture at its centre: right and down, not both 0 unless the camera
 * looks along a meridian of no length (level to the north or south). */
void motion_north(const view *v, double *out_right, double *out_down);

#endif
