/* Plug-ins: parts of the program that bring large libraries, loaded by those runs alone that need them. */
#ifndef MESHIO_PLUGIN_H
#define MESHIO_PLUGIN_H

#include <stddef.h>

/* Every plug-in exports one, called radsig_plugin. */
typedef struct plugin_export {
    const char *version;   /* of the program that it was built with */
    const void *functions; /* a table that the plug-in's header declares */
} plugin_export;

/* Loads NAME.so from plugins/ beside the program or, where that holds none, from ../lib/radsig/ (an
 * installed program), unless it is loaded; it stays loaded. May be called by several threads.
 * Returns its table, or NULL with `PATH: ...`: missing, damaged, lacking a library, of another version. */
const void *plugin_load(const char *name, char *message, size_t message_size);

#endif
