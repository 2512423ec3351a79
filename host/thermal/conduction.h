/* Conduction: which facets pass heat to each other along a sheet of one material, and how well.
 * Thesis 4.0, item 5; solved in kernels/thermal/conduction.h. */
#ifndef CONDUCTION_H
#define CONDUCTION_H

#include "kernels/records.h"
#include "mesh/geometry.h"

/* Patches of facets that touch. A facet is coupled to a neighbour of the same material where
 * G = k d w / distance, in series over both, is at least 0.02 W m-2 K-1 of the smaller one's area;
 * with 0.02 K more than ten kelvin between them change less than 0.03 K (departs). */
typedef struct conduction_map {
    size_t count; /* places: patch after patch, each filled up to a multiple of 16 */
    uint32_t patch_count;
    uint32_t *patch_first;   /* shape (patch_count + 1) */
    uint32_t *facet;         /* shape (count): the facet of a place; fillers repeat the last one */
    conduction_record *link; /* shape (count): neighbours are places */
} conduction_map;

/* Finds them.
 *   facet, material   shape (g's facet count at least), (materials)
 * Facets of a stated temperature are in no patch, but their neighbours feel them. Distances are those
 * of a triangle's circumcentre, of a quad's mean corner: exact for what is linear between well-shaped
 * facets. Fails with STATUS_MEMORY. */
status conduction_find(conduction_map **out, const geometry *g, const facet_record *facet,
                       const material_record *material);
void conduction_free(conduction_map *map);

#endif
