/* Image: the planes of a render as an ENVI file (float32, band sequential, little endian) with its
 * header, or together as one OpenEXR. */
#ifndef IMAGE_H
#define IMAGE_H

#include "files/output_folder.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A pixel without a value; the header's `data ignore value`. */
#define IMAGE_NO_DATA (-9999.0f)

/* Cubes of more planes are hyperspectral. */
enum { IMAGE_SPECTRAL = 16 };

typedef struct image_plane {
    const char *name, *unit;       /* `temperature_c`, `C`; unit NULL or "": none */
    double wavelength_um, fwhm_um; /* centre and width of the band; 0: none */
    bool categorical;              /* the values are numbers of things */
} image_plane;

/* The name of a number in a categorical plane. */
typedef struct image_label {
    int32_t number;
    const char *name;
} image_label;

/* One more line of the header: `key = text`, or, if text is NULL, `key = {1 concrete, 22 tar}`. */
typedef struct image_field {
    const char *key, *text;
    const image_label *label; /* shape (label_count) */
    size_t label_count;
} image_field;

typedef struct image_header {
    const char *description;  /* scene and mode, one line; the unit of a cube is added to it */
    const char *time;         /* ISO 8601, UTC: `1987-06-24T15:00:00Z` */
    const image_field *field; /* shape (field_count) */
    size_t field_count;
} image_header;

typedef struct image image;

/* Opens `stem.img` and `stem.hdr` in the folder and takes all the disk they need, so that a full
 * disk is an error here. The planes are mapped: what is written to them goes to the file.
 * Copies the planes' texts. If every plane has a wavelength the image is a cube: its planes share
 * a unit, which stands in `data units` and not in the band names. */
status image_create(image **out, output_folder *folder, const char *stem, uint32_t columns,
                    uint32_t rows, const image_plane *plane, size_t plane_count);

/* Shape (rows, columns), row 0 on top; 0 until it is written. */
float *image_values(image *img, size_t plane);

/* Writes some values of a plane, from pixel `first` on. The same as through the map, without its
 * pages, which cost more time than the writing. Fails with STATUS_FILE, naming the file. */
status image_write(image *img, size_t plane, size_t first, size_t count, const float *values);

/* Takes the planes out of the process' memory, as often as wanted: the file has what was written,
 * and it is read again where it is looked at. */
void image_unload(image *img);

uint32_t image_columns(const image *img);
uint32_t image_rows(const image *img);
size_t image_plane_count(const image *img);
const image_plane *image_plane_at(const image *img, size_t plane);

/* Writes the header; output_folder_commit then renames both files. Braces, commas and line ends in
 * texts become other marks, or they would break lists. */
status image_finish(image *img, const image_header *header);

/* Releases the map; the files belong to the folder. NULL is allowed. */
void image_free(image *img);

/* Writes the planes of all the images, which have one size, as channels of the OpenEXR file `name`,
 * each under its plane's name alone; its unit is the attribute `unit.<channel>`. A cube of more
 * than IMAGE_SPECTRAL planes of ascending wavelength has spectral channels instead, `S0.00403,5000nm`,
 * and a picture, `R`, `G`, `B` (Fichet and others, JCGT 10(3), 2021). */
status image_write_exr(output_folder *folder, const char *name, image *const *img,
                       size_t image_count, const image_header *header);

#endif
