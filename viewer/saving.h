/* Saving: what the preview writes: views, pages, images. Files go to the current folder, under the
 * scene's name and the first free number. */
#ifndef SAVING_H
#define SAVING_H

#include "preview.h"

/* Both tell in the preview's note what was written, or why not. */
void saving_view(preview *p);
void saving_page(preview *p);

/* Starts the render of the present view in the scene's own size; one at a time. */
void saving_full_render(preview *p);

/* Writes the page as it is drawn as PNG. */
status saving_write_page(preview *p, const char *path);

/* Writes the radiances of the picture at rest as `radsig render` does: FILE.img and FILE.hdr. */
status saving_write_image(preview *p, const char *path);

#endif
