#include "files/record_file.h"

#include "base/interrupt.h"
#include "base/number.h"
#include "files/text_encoding.h"
#include "meshio/cancel.h"
#include "meshio/input_file.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct record_file {
    char *path, *text;
    bool is_whole;     /* ends with a line end */
    char *next;        /* the first character that was not taken */
    int next_line;     /* its line number, from 1 */
    const char *taken; /* the line that was taken last */
    int taken_line;
};

const char *record_text_begin(const char *text)
{
    return text + (strncmp(text, "\xef\xbb\xbf", 3) ? 0 : 3);
}

static status read_whole(record_file *file)
{
    status rc = STATUS_OK;
    char message[1024];
    size_t size;

    cancel_ask(interrupt_is_set);
    NEED(input_file_read(&file->text, &size, file->path, INPUT_FILE_TEXT_LIMIT, message,
                         sizeof message) == 0,
         STATUS_FILE, "%s", message);
    TRY(text_encoding_unify(&file->text, &size));
    file->is_whole = size == 0 || file->text[size - 1] == '\n';
    NEED(strlen(file->text) == size, STATUS_FILE, "%s: is binary, expected text", file->path);
out:
    return rc;
}

status record_file_open(record_file **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = calloc(1, sizeof *file);

    NEED(file, STATUS_MEMORY, "%s: no memory to read it", path);
    file->path = strdup(path);
    NEED(file->path, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(read_whole(file));
    file->next = file->text;
    file->next_line = 1;
    file->taken = "";
    *out = file;
    file = NULL;
out:
    record_file_free(file);
    return rc;
}

void record_file_free(record_file *file)
{
    if (!file) return;
    free(file->path);
    free(file->text);
    free(file);
}

static void skip_blank_lines(record_file *file)
{
    while (isspace((unsigned char)*file->next)) {
        if (*file->next == '\n') file->next_line++;
        file->next++;
    }
}

bool record_file_at_end(const record_file *file)
{
    const char *c = file->next;

    while (isspace((unsigned char)*c)) c++;
    return *c == '\0';
}

const char *record_file_peek(record_file *file)
{
    skip_blank_lines(file);
    return *file->next ? file->next : NULL;
}

status record_file_text(record_file *file, const char **out_text, const char *expected)
{
    status rc = STATUS_OK;
    char *end;

    TRY(interrupt_check());
    skip_blank_lines(file);
    NEED(*file->next, STATUS_FORMAT, "%s:%d: the file ends, expected %s", file->path,
         file->next_line, expected);
    file->taken = file->next;
    file->taken_line = file->next_line;
    end = strchr(file->next, '\n');
    file->next = end ? end + 1 : file->next + strlen(file->next);
    if (end)
        file->next_line++;
    else
        end = file->next;
    while (end > file->taken && isspace((unsigned char)end[-1])) end--;
    *end = '\0';
    *out_text = file->taken;
out:
    return rc;
}

status record_file_header(record_file *file, char **out_text)
{
    status rc = STATUS_OK;
    const char *line, *next;
    char *text = calloc(1, strlen(file->next) + 2);
    size_t length = 0;

    NEED(text, STATUS_MEMORY, "%s: no memory for its header", file->path);
    while ((next = record_file_peek(file)) && *next == '#') {
        TRY(record_file_text(file, &line, "a header"));
        length += (size_t)sprintf(text + length, "%s\n", line);
    }
    if (out_text) {
        char *fitted = realloc(text, length + 1);
        *out_text = fitted ? fitted : text;
        text = NULL;
    }
out:
    free(text);
    return rc;
}

size_t record_file_column(const record_file *file)
{
    const char *start = file->taken;

    while (start > file->text && (start[-1] == ' ' || start[-1] == '\t')) start--;
    return (size_t)(file->taken - start);
}

status record_file_numbers(record_file *file, size_t count, double *out, const char *expected)
{
    status rc = STATUS_OK;
    const char *text;

    TRY(record_file_text(file, &text, expected));
    if (record_numbers(text, count, out) != (int)count)
        rc = record_file_reject(file, "%s", expected);
out:
    return rc;
}

status record_file_number(record_file *file, double low, double high, double *out,
                          const char *expected)
{
    status rc = STATUS_OK;

    TRY(record_file_numbers(file, 1, out, expected));
    if (*out < low || *out > high)
        rc = record_file_reject(file, "%s from %g to %g", expected, low, high);
out:
    return rc;
}

status record_file_count(record_file *file, long low, long high, long *out, const char *expected)
{
    status rc = STATUS_OK;
    double value;

    TRY(record_file_number(file, (double)low, (double)high, &value, expected));
    if (value != floor(value)) rc = record_file_reject(file, "%s, a whole number", expected);
    *out = (long)value;
out:
    return rc;
}

status record_file_reject(const record_file *file, const char *expected, ...)
{
    char wanted[512];
    va_list arguments;

    va_start(arguments, expected);
    vsnprintf(wanted, sizeof wanted, expected, arguments);
    va_end(arguments);
    return status_set(STATUS_FORMAT, "%s:%d: found '%.100s', expected %s", file->path,
                      file->taken_line, file->taken, wanted);
}

status record_file_finish(record_file *file)
{
    status rc = STATUS_OK;
    const char *text;

    if (record_file_at_end(file)) return STATUS_OK;
    TRY(record_file_text(file, &text, "the end of the file"));
    rc = record_file_reject(file, "the end of the file");
out:
    return rc;
}

bool record_file_is_whole(const record_file *file)
{
    return file->is_whole;
}

int record_file_line(const record_file *file)
{
    return file->taken_line;
}

int record_numbers(const char *text, size_t limit, double *out)
{
    int count = 0;

    for (;;) {
        while (isspace((unsigned char)*text) || *text == ',') text++;
        if (!*text) return count;
        double value;
        text = number_take(text, &value);
        if (!text) return -1;
        if ((size_t)count < limit) out[count] = value;
        count++;
    }
}
