#include "sensor/response_file.h"

#include "files/record_file.h"

#include <stdlib.h>

#define PER_CM2 1e-4 /* W m-2 to W cm-2 */

static status read_values(response_file *s, record_file *file)
{
    status rc = STATUS_OK;
    long count;

    TRY(record_file_count(file, 1, 1000000, &count, "the number of points"));
    TRY(record_file_number(file, -1e30, 1e30, &s->gain, "the gain"));
    TRY(record_file_number(file, -1e30, 1e30, &s->offset, "the offset"));
    s->gain *= PER_CM2;
    s->response = malloc((size_t)count * sizeof *s->response);
    NEED(s->response, STATUS_MEMORY, "no memory for %ld responses", count);
    for (; s->count < count; s->count++)
        TRY(record_file_number(file, 0.0, 1.0, &s->response[s->count], "a response"));
out:
    return rc;
}

static status pass_surplus(record_file *file, const char *path, int count)
{
    status rc = STATUS_OK;
    double value;
    int surplus = 0;

    for (; !record_file_at_end(file); surplus++)
        TRY(record_file_number(file, 0.0, 1.0, &value, "a response"));
    if (surplus)
        status_warn(
            "%s:%d: %d responses more than the %d that the first line announces are not used", path,
            record_file_line(file) - surplus + 1, surplus, count);
out:
    return rc;
}

status response_file_read(response_file **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    response_file *s = calloc(1, sizeof *s);

    NEED(s, STATUS_MEMORY, "no memory for a sensor");
    TRY(record_file_open(&file, path));
    TRY(read_values(s, file));
    TRY(pass_surplus(file, path, s->count));
    *out = s;
    s = NULL;
out:
    record_file_free(file);
    response_file_free(s);
    return rc;
}

void response_file_free(response_file *s)
{
    if (!s) return;
    free(s->response);
    free(s);
}
