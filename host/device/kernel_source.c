#include "device/kernel_source.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct assembly {
    FILE *stream;
    bool *included; /* shape (file_count()) */
} assembly;

static size_t file_count(void)
{
    size_t count = 0;

    while (kernel_files[count].name) count++;
    return count;
}

static int find_file(const char *name, size_t length)
{
    for (int i = 0; kernel_files[i].name; i++)
        if (strlen(kernel_files[i].name) == length && !strncmp(kernel_files[i].name, name, length))
            return i;
    return -1;
}

/* Returns the index of kernels/.../NAME.cl, or -1. */
static int find_kernel(const char *name)
{
    char file_name[96];

    snprintf(file_name, sizeof file_name, "/%s.cl", name);
    for (int i = 0; kernel_files[i].name; i++)
        if (!strcmp(strrchr(kernel_files[i].name, '/'), file_name)) return i;
    return -1;
}

/* Returns the index of the file that a line includes, or -1 for any other line. */
static int included_file(const char *line)
{
    static const char directive[] = "#include \"";

    if (strncmp(line, directive, sizeof directive - 1)) return -1;
    const char *name = line + sizeof directive - 1;
    return find_file(name, strcspn(name, "\"\n"));
}

static void append_file(assembly *all, int file)
{
    int line_number = 1;

    if (all->included[file]) return;
    all->included[file] = true;
    fprintf(all->stream, "#line 1 \"%s\"\n", kernel_files[file].name);
    for (const char *line = kernel_files[file].text; *line; line_number++) {
        const size_t length = strcspn(line, "\n") + 1;
        const int header = included_file(line);
        if (header >= 0) {
            append_file(all, header);
            fprintf(all->stream, "#line %d \"%s\"\n", line_number + 1, kernel_files[file].name);
        } else {
            fwrite(line, 1, length, all->stream);
        }
        line += length;
    }
}

status kernel_source_read(char **out, const char *name)
{
    status rc = STATUS_OK;
    assembly all = {0};
    char *text = NULL;
    size_t size = 0;
    const int file = find_kernel(name);

    all.included = calloc(file_count() + 1, sizeof *all.included);
    NEED(all.included, STATUS_MEMORY, "kernel %s: no memory for its text", name);
    NEED(file >= 0, STATUS_DEVICE, "kernel %s: %s.cl is not part of this program", name, name);
    all.stream = open_memstream(&text, &size);
    NEED(all.stream, STATUS_MEMORY, "kernel %s: no memory for its text", name);
    append_file(&all, file);
    NEED(fclose(all.stream) == 0, STATUS_MEMORY, "kernel %s: no memory for its text", name);
    *out = text;
out:
    free(all.included);
    return rc;
}
