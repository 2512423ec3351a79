/* Render sensor: NAME_sensor, the radiance as a real sensor would give it, beside the clean one. */
#ifndef RENDER_SENSOR_H
#define RENDER_SENSOR_H

#include "device/device.h"
#include "image/image.h"
#include "scene/scene.h"

/* Degrades the radiances of a cube as the scene's [sensor] says and writes NAME_sensor.img and
 * .hdr, planes `sensor_<band>`, into the folder.
 *   cube     one plane a band
 *   out      with the planes, for pictures; the caller frees it */
status render_sensor_write(image **out, output_folder *folder, const scene *s, device *dev,
                           image *cube, const image_header *header);

#endif
