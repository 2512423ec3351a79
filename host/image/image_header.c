#include "image/image_header.h"

#include <stdio.h>
#include <string.h>

enum { LINE_LENGTH = 96, ITEM_SIZE = 256 };

/* Writes a text without what ends a list or a line. */
static void put_text(FILE *file, const char *text)
{
    for (; *text; text++) {
        const char c = *text;
        fputc(c == '{' ? '(' : c == '}' ? ')' : (unsigned char)c < ' ' ? ' ' : c, file);
    }
}

static void put_line(FILE *file, const char *key, const char *text)
{
    put_text(file, key);
    fputs(" = ", file);
    put_text(file, text);
    fputc('\n', file);
}

/* A list that is being written; its lines are broken, some readers have short buffers. */
typedef struct list {
    FILE *file;
    size_t count, column;
} list;

static list list_begin(FILE *file, const char *key)
{
    put_text(file, key);
    fputs(" = {", file);
    return (list){.file = file, .column = strlen(key) + 4};
}

static void list_add(list *to, char *item)
{
    const size_t length = strlen(item);

    for (char *comma = item; (comma = strchr(comma, ','));) *comma = ';';
    if (to->count++) {
        fputc(',', to->file);
        const bool broken = to->column + length + 2 > LINE_LENGTH;
        fputs(broken ? "\n " : " ", to->file);
        to->column = broken ? 1 : to->column + 2;
    }
    put_text(to->file, item);
    to->column += length;
}

static void list_end(const list *of)
{
    fputs("}\n", of->file);
}

static bool is_cube(const image *img)
{
    for (size_t p = 0; p < image_plane_count(img); p++)
        if (image_plane_at(img, p)->wavelength_um <= 0.0) return false;
    return true;
}

static void put_band_names(FILE *file, const image *img, bool with_unit)
{
    char item[ITEM_SIZE];
    list names = list_begin(file, "band names");

    for (size_t p = 0; p < image_plane_count(img); p++) {
        const image_plane *plane = image_plane_at(img, p);
        const bool unit = with_unit && plane->unit[0];
        snprintf(item, sizeof item, "%s%s%s%s", plane->name, unit ? " [" : "",
                 unit ? plane->unit : "", unit ? "]" : "");
        list_add(&names, item);
    }
    list_end(&names);
}

static void put_wavelengths(FILE *file, const image *img)
{
    char item[ITEM_SIZE];
    bool has_width = true;
    list centres = list_begin(file, "wavelength");

    for (size_t p = 0; p < image_plane_count(img); p++) {
        const image_plane *plane = image_plane_at(img, p);
        has_width = has_width && plane->fwhm_um > 0.0;
        snprintf(item, sizeof item, "%.9g", plane->wavelength_um);
        list_add(&centres, item);
    }
    list_end(&centres);
    fputs("wavelength units = Micrometers\n", file);
    if (!has_width) return;

    list widths = list_begin(file, "fwhm");
    for (size_t p = 0; p < image_plane_count(img); p++) {
        snprintf(item, sizeof item, "%.9g", image_plane_at(img, p)->fwhm_um);
        list_add(&widths, item);
    }
    list_end(&widths);
}

static void put_field(FILE *file, const image_field *field)
{
    char item[ITEM_SIZE];

    if (field->text) {
        put_line(file, field->key, field->text);
        return;
    }
    list labels = list_begin(file, field->key);
    for (size_t i = 0; i < field->label_count; i++) {
        snprintf(item, sizeof item, "%d %s", field->label[i].number, field->label[i].name);
        list_add(&labels, item);
    }
    list_end(&labels);
}

static void put_description(FILE *file, const image *img, const char *text, bool cube)
{
    fputs("description = {", file);
    put_text(file, text);
    if (cube) {
        fputs(", radiance in ", file);
        put_text(file, image_plane_at(img, 0)->unit);
    }
    fputs("}\n", file);
}

status image_header_write(output_file *place, const image *img, const image_header *header)
{
    const bool cube = is_cube(img);
    FILE *file = output_file_stream(place);

    fputs("ENVI\n", file);
    put_description(file, img, header->description, cube);
    fprintf(file, "samples = %u\nlines = %u\nbands = %zu\n", image_columns(img), image_rows(img),
            image_plane_count(img));
    fputs("header offset = 0\nfile type = ENVI Standard\ndata type = 4\ninterleave = bsq\n"
          "byte order = 0\n",
          file);
    put_band_names(file, img, !cube);
    if (cube) {
        put_wavelengths(file, img);
        put_line(file, "data units", image_plane_at(img, 0)->unit);
    }
    fputs("data ignore value = -9999\n", file);
    put_line(file, "acquisition time", header->time);
    for (size_t i = 0; i < header->field_count; i++) put_field(file, &header->field[i]);
    return output_file_close(place);
}
