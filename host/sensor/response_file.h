/* Response file: response and gain of a band. Thesis 2.4 (eq. 2.4-3), 2.5.3, Appendix A item 5 (.sen). */
#ifndef RESPONSE_FILE_H
#define RESPONSE_FILE_H

#include "base/status.h"

/* counts = gain x radiance + offset. */
typedef struct response_file {
    double gain;      /* per W m-2 sr-1 */
    double offset;    /* counts */
    int count;        /* points of the radiance database */
    double *response; /* shape (count), 0..1, in the database's order: ascending wavelength */
} response_file;

/* Reads a .sen file; its gain is per W cm-2 sr-1. Too few responses are an error; further ones,
 * as in the printed sample, are a warning and are not used. */
status response_file_read(response_file **out, const char *path);
void response_file_free(response_file *s);

#endif
