/* Image header: the ENVI header (.hdr) of an image. The keys are those of ENVI 5, and `data units`
 * and `radsig ...` besides, which readers keep as they are. */
#ifndef IMAGE_HEADER_H
#define IMAGE_HEADER_H

#include "image/image.h"

/* Writes the header under the temporary path of `place`, which stays to be committed. */
status image_header_write(output_file *place, const image *img, const image_header *header);

#endif
