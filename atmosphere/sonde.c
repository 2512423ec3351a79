#include "sonde.h"

#include "sonde_layout.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The layout of a file, which is opened again. What is none, such as an archive's answer that there is no
 * sounding, is told by its first line. */
static status find_layout(const sonde_layout **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    const char *text = "", *first;

    TRY(record_file_open(&file, path));
    TRY(record_file_text(file, &text, "a sounding"));
    *out = &sonde_igra;
    if (sonde_igra_is_head(text)) goto out;
    while (*text == '#') TRY(record_file_text(file, &text, "a sounding"));
    first = text;
    const int line = record_file_line(file);
    *out = &sonde_wyoming;
    while (!sonde_wyoming_is_head(text) && !record_file_at_end(file))
        TRY(record_file_text(file, &text, "a sounding"));
    if (sonde_wyoming_is_head(text)) goto out;
    *out = &sonde_csv;
    NEED(strpbrk(first, ",;\t"), STATUS_FORMAT,
         "%s:%d: found '%.100s', expected the head PRES HGHT TEMP DWPT of the University of "
         "Wyoming's layout, CSV, or IGRA 2",
         path, line, first);
out:
    record_file_free(file);
    return rc;
}

/* Opens a file behind its header, which an IGRA file has not. */
static status open_file(record_file **out, const char *path, const sonde_layout *layout)
{
    status rc = STATUS_OK;

    TRY(record_file_open(out, path));
    if (layout != &sonde_igra) TRY(record_file_header(*out, NULL));
out:
    return rc;
}

status sonde_read(sonde **out, const char *path, const site *where)
{
    status rc = STATUS_OK;
    record_file *listed = NULL, *file = NULL;
    const sonde_layout *layout;
    const sonde_part *part;
    sonde_parts parts = {0};
    sonde_builder builder = {.s = calloc(1, sizeof *builder.s), .path = path};

    NEED(builder.s, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(find_layout(&layout, path));
    TRY(open_file(&listed, path, layout));
    TRY(layout->list(&parts, listed));
    NEED(parts.count > 0, STATUS_FORMAT, "%s: expected at least two levels, found none", path);
    TRY(sonde_choose(&part, &parts, where, path));
    TRY(open_file(&file, path, layout));
    TRY(layout->read(&builder, file, part));
    TRY(sonde_finish(&builder));
    *out = builder.s;
    builder.s = NULL;
out:
    free(parts.part);
    record_file_free(listed);
    record_file_free(file);
    sonde_free(builder.s);
    return rc;
}

void sonde_free(sonde *s)
{
    if (!s) return;
    free(s->level);
    free(s);
}

sonde_level sonde_at(const sonde *s, double altitude_m)
{
    size_t i = 1;

    while (i + 1 < s->count && s->level[i].altitude_m < altitude_m) i++;
    const sonde_level *a = &s->level[i - 1], *b = &s->level[i];
    const double fraction = (altitude_m - a->altitude_m) / (b->altitude_m - a->altitude_m);
    return (sonde_level){altitude_m,
                         a->pressure_hpa * pow(b->pressure_hpa / a->pressure_hpa, fraction),
                         a->temperature_k + fraction * (b->temperature_k - a->temperature_k),
                         a->dew_point_k + fraction * (b->dew_point_k - a->dew_point_k)};
}
