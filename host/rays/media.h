/* Media: the participating media of a scene on a device, in a tree of their own. Thesis 2.4.3. */
#ifndef MEDIA_H
#define MEDIA_H

#include "launches.h"

#include <stdbool.h>

struct scene;

typedef struct media media;

/* Builds the tree; a scene without transmissive materials has none: *out is NULL. Scene and device
 * must outlive it. */
status media_open(media **out, device *dev, const struct scene *s);
void media_free(media *b);

/* Fills the facets' corners for the tree of what is opaque: those of bodies lose their area.
 *   out   shape (facet_count) */
void media_leave_out(const struct scene *s, uint32_t (*out)[4]);

/* What kernels need of it. */
medium_tables media_tables(const media *b);

/* True if light that a body takes may come out again. */
bool media_scatter(const media *b);

/* Samples extinction, albedo and asymmetry of all materials, linear in wavenumber, the last value
 * beyond their ends.
 *   wavenumber_cm1   shape (count)
 *   out              rows of `count` as CLOUD_... (kernels/media/cloud.h), per m; the last is 0 */
status media_sample(const media *b, const double *wavenumber_cm1, uint32_t count,
                    float_buffer *out);

#endif
