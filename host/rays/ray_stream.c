#include "rays/ray_stream.h"

#include "base/number.h"
#include "files/record_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static status add_ray(ray_stream *stream, ray_batch *batch, const double ray[6])
{
    status rc = STATUS_OK;
    const char *unit = stream->binary ? "ray" : "line";
    double largest = 0, square = 0, scaled[3];
    int exponent = 0;
    float out[6];

    stream->ray_count++;
    for (int k = 0; k < 6; k++)
        NEED(isfinite(ray[k]), STATUS_FORMAT, "%s %llu: a number is not finite", unit,
             (unsigned long long)stream->ray_count);
    for (int k = 3; k < 6; k++) largest = fmax(largest, fabs(ray[k]));
    NEED(largest > 0, STATUS_FORMAT, "%s %llu: the direction is 0", unit,
         (unsigned long long)stream->ray_count);
    frexp(largest, &exponent);
    for (int k = 0; k < 3; k++) {
        out[k] = (float)(ray[k] - stream->origin_m[k]);
        scaled[k] = ldexp(ray[3 + k], -exponent);
        out[3 + k] = (float)scaled[k];
        square += (double)out[3 + k] * (double)out[3 + k];
    }
    const double length = hypot(hypot(scaled[0], scaled[1]), scaled[2]);
    for (int k = 0; k < 6; k++) {
        batch->ray[k][batch->count] = out[k];
        batch->exact[batch->count][k] =
            k < 3 ? ray[k] - stream->origin_m[k] : scaled[k - 3] / length;
    }
    batch->length[batch->count++] = sqrt(square);
out:
    return rc;
}

/* Finds exactly six numbers. */
static bool parse(const char *line, double out[6])
{
    static const char blanks[] = " \t\r\n";

    for (int k = 0; k < 6; k++) {
        line = number_take(line + strspn(line, blanks), &out[k]);
        if (!line || (*line && !strchr(blanks, *line))) return false;
    }
    return line[strspn(line, blanks)] == '\0';
}

static status read_lines(ray_stream *stream, ray_batch *out)
{
    status rc = STATUS_OK;
    char *line = NULL;
    size_t size = 0;
    double ray[6];

    while (out->count < RAY_BATCH_SIZE && getline(&line, &size, stream->file) >= 0) {
        const char *text = stream->ray_count == 0 ? record_text_begin(line) : line;
        NEED(parse(text, ray), STATUS_FORMAT,
             "line %llu: '%.*s' stands there, expected ox oy oz dx dy dz",
             (unsigned long long)stream->ray_count + 1, (int)strcspn(line, "\r\n"), line);
        TRY(add_ray(stream, out, ray));
    }
out:
    free(line);
    return rc;
}

static status read_records(ray_stream *stream, ray_batch *out)
{
    status rc = STATUS_OK;
    float record[6];
    double ray[6];
    size_t bytes = 0;

    while (out->count < RAY_BATCH_SIZE &&
           (bytes = fread(record, 1, sizeof record, stream->file)) == sizeof record) {
        for (int k = 0; k < 6; k++) ray[k] = (double)record[k];
        TRY(add_ray(stream, out, ray));
        bytes = 0;
    }
    NEED(bytes == 0, STATUS_FORMAT, "ray %llu: the input ends after %zu of its %zu bytes",
         (unsigned long long)stream->ray_count + 1, bytes, sizeof record);
out:
    return rc;
}

status ray_stream_read(ray_stream *stream, ray_batch *out)
{
    status rc = STATUS_OK;

    out->count = 0;
    TRY(stream->binary ? read_records(stream, out) : read_lines(stream, out));
    NEED(!ferror(stream->file), STATUS_FILE, "the rays cannot be read: %s", strerror(errno));
out:
    return rc;
}
