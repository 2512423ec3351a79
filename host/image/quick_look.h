/* Quick look: one plane as a PNG for people, with a title and either a colour bar or a legend. */
#ifndef QUICK_LOOK_H
#define QUICK_LOOK_H

#include "image/image.h"

typedef enum quick_look_colours {
    QUICK_LOOK_GREY,
    QUICK_LOOK_HEAT,   /* black, violet, orange, yellow: for temperatures */
    QUICK_LOOK_LABELS, /* a colour for each label; a legend instead of a bar */
    QUICK_LOOK_IDS     /* a colour for each whole number, without a legend */
} quick_look_colours;

typedef struct quick_look {
    uint32_t columns, rows;
    const float *value;       /* shape (rows, columns); IMAGE_NO_DATA is drawn neutral */
    const char *scene, *time; /* of the title; time as in image_header */
    const char *plane, *unit; /* unit NULL or "": none */
    quick_look_colours colours;
    const image_label *label; /* shape (label_count): QUICK_LOOK_LABELS; the legend lists those */
    size_t label_count;       /* that occur, a value without a label by its number */
} quick_look;

/* The colours that suit a plane: `facet` by id, other categories by label, degrees C and kelvin as
 * heat, all else in grey. */
quick_look_colours quick_look_colours_of(const image_plane *plane);

/* Writes the file `name`: pixels 1:1, or enlarged by a whole factor until the shorter side has 256 (the
 * longer no more than 4096);
 * the bar spans the 0.5 to 99.5 percentile of the values. Fails with STATUS_FILE if it cannot be
 * written or the font (Debian's fonts-dejavu-core) is missing. */
status quick_look_write(output_folder *folder, const char *name, const quick_look *look);

#endif
