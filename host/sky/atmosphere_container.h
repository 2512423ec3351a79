/* Atmosphere container: a radiance database in compact form, a .radc file: the line
 * `RADSIG ATMOSPHERE 1`, a JSON object of one key a line, and float32 arrays, little-endian, in the
 * order that the object's key `arrays` tells. */
#ifndef ATMOSPHERE_CONTAINER_H
#define ATMOSPHERE_CONTAINER_H

#include "sky/atmosphere.h"

#include <stdbool.h>

/* True if the file starts as a container does. */
bool atmosphere_container_is(const char *path);

/* Reads a container; fails with STATUS_FORMAT as atmosphere_read does. */
status atmosphere_container_read(atmosphere **out, const char *path);

/* Writes one, as atmosphere_write does. */
status atmosphere_container_write(const atmosphere *a, const char *path);

#endif
