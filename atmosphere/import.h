/* Import: a radiance database from MODTRAN's own tape7 files, whose geometry a manifest tells. */
#ifndef IMPORT_H
#define IMPORT_H

#include "sky/atmosphere.h"

/* Reads a manifest, a TOML file (docs/atmosphere.md), and the files that it names, relative to its
 * folder. Fails with a line for each mistake in the manifest; with STATUS_FORMAT where a file lacks
 * a column that its use needs, or the spectral grids differ. */
status import_read(atmosphere **out, const char *path);

#endif
