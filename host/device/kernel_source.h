/* Kernel source: the text of a kernel with its headers put in, from the files of kernels/ that were
 * made part of the program when it was built. */
#ifndef KERNEL_SOURCE_H
#define KERNEL_SOURCE_H

#include "base/status.h"

typedef struct kernel_file {
    const char *name; /* "kernels/sensor/blur.cl" */
    const char *text;
} kernel_file;

/* Ends with a NULL name; build/.../kernel_files.c is made from kernels/ by the Makefile. */
extern const kernel_file kernel_files[];

/* Text of kernels/.../NAME.cl in which every include stands once, with #line marks, so that a build
 * log names the real file and line. The caller frees it. */
status kernel_source_read(char **out, const char *name);

#endif
