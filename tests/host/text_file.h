/* Text files that tests write and read, in a folder of their own that is removed at the end. */
#ifndef TEXT_FILE_H
#define TEXT_FILE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/status.h"

static char text_file_folder[64], text_file_at[128];

static inline int text_file_setup(void **state)
{
    (void)state;
    strcpy(text_file_folder, P_tmpdir "/radsig-test-XXXXXX");
    if (!mkdtemp(text_file_folder)) return -1;
    snprintf(text_file_at, sizeof text_file_at, "%s/file", text_file_folder);
    return 0;
}

static inline int text_file_teardown(void **state)
{
    (void)state;
    unlink(text_file_at);
    return rmdir(text_file_folder);
}

/* Writes the text and returns the file's path; the next one replaces it. */
static inline const char *text_file(const char *text)
{
    FILE *stream = fopen(text_file_at, "wb");

    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    return text_file_at;
}

/* The same with the first `old` replaced. */
static inline const char *text_file_with(const char *text, const char *old, const char *new)
{
    const char *at = strstr(text, old);
    char *changed = malloc(strlen(text) + strlen(new) + 1);

    assert_non_null(at);
    assert_non_null(changed);
    sprintf(changed, "%.*s%s%s", (int)(at - text), text, new, at + strlen(old));
    text_file(changed);
    free(changed);
    return text_file_at;
}

/* Asserts that a reader refused the file at that line, and that the message names what it expected. */
static inline void assert_refused(status rc, int line, const char *expected)
{
    char start[256];

    snprintf(start, sizeof start, "%s:%d: ", text_file_at, line);
    assert_int_equal(rc, STATUS_FORMAT);
    if (strncmp(status_message(), start, strlen(start)) != 0 || !strstr(status_message(), expected))
        fail_msg("'%s', expected it to start with '%s' and to hold '%s'", status_message(), start,
                 expected);
}

#endif
