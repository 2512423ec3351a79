/* A folder for what a test writes; it is removed with all it holds. */
#ifndef SCRATCH_FOLDER_H
#define SCRATCH_FOLDER_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char scratch[64];

static inline int scratch_setup(void **state)
{
    (void)state;
    strcpy(scratch, P_tmpdir "/radsig-test-XXXXXX");
    return mkdtemp(scratch) ? 0 : -1;
}

static inline int scratch_remove(const char *path)
{
    DIR *folder = opendir(path);

    if (!folder) return unlink(path);
    for (struct dirent *entry; (entry = readdir(folder));) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        char *inner = malloc(strlen(path) + strlen(entry->d_name) + 2);
        assert_non_null(inner);
        sprintf(inner, "%s/%s", path, entry->d_name);
        scratch_remove(inner);
        free(inner);
    }
    closedir(folder);
    return rmdir(path);
}

static inline int scratch_teardown(void **state)
{
    (void)state;
    return scratch_remove(scratch);
}

/* A path in the folder; valid until the fourth call after this one. */
static inline const char *scratch_path(const char *name)
{
    static char path[4][256];
    static int now;

    now = (now + 1) % 4;
    snprintf(path[now], sizeof path[now], "%s/%s", scratch, name);
    return path[now];
}

/* The bytes of a file, with a 0 behind them; the caller frees them. */
static inline char *scratch_read(const char *name, size_t *out_size)
{
    FILE *file = fopen(scratch_path(name), "rb");
    char *bytes;
    long size;

    if (!file) fail_msg("%s was not written", name);
    fseek(file, 0, SEEK_END);
    size = ftell(file);
    rewind(file);
    bytes = calloc(1, (size_t)size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, (size_t)size, file), size);
    fclose(file);
    if (out_size) *out_size = (size_t)size;
    return bytes;
}

static inline void scratch_assert_text(const char *name, const char *expected)
{
    char *text = scratch_read(name, NULL);

    assert_string_equal(text, expected);
    free(text);
}

static inline void scratch_assert_same(const char *name, const char *other)
{
    size_t size, other_size;
    char *bytes = scratch_read(name, &size), *other_bytes = scratch_read(other, &other_size);

    assert_int_equal(size, other_size);
    assert_memory_equal(bytes, other_bytes, size);
    free(bytes);
    free(other_bytes);
}

/* How many entries a folder of the scratch folder has; -1 if it does not exist. */
static inline int scratch_count(const char *name)
{
    DIR *folder = opendir(scratch_path(name));
    int count = -2; /* . and .. */

    if (!folder) return -1;
    while (readdir(folder)) count++;
    closedir(folder);
    return count;
}

#endif
