#include "image/image.h"

#include "base/interrupt.h"
#include "image/image_header.h"
#include "image/value_range.h"
#include "meshio/image_file.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the header says little endian");

struct image {
    uint32_t columns, rows;
    image_plane *plane; /* shape (plane_count); owns its texts */
    size_t plane_count;
    float *value; /* shape (plane_count, rows, columns), mapped */
    size_t bytes;
    char *stem;
    output_file *header; /* belongs to the folder, as does what `file` is of */
    int file;
};

static status copy_planes(image *img, const image_plane *plane, size_t plane_count)
{
    status rc = STATUS_OK;

    img->plane = calloc(plane_count, sizeof *img->plane);
    NEED(img->plane, STATUS_MEMORY, "%s: no memory for %zu planes", img->stem, plane_count);
    img->plane_count = plane_count;
    for (size_t p = 0; p < plane_count; p++) {
        image_plane *copy = &img->plane[p];
        *copy = plane[p];
        copy->name = strdup(plane[p].name);
        copy->unit = strdup(plane[p].unit ? plane[p].unit : "");
        NEED(copy->name && copy->unit, STATUS_MEMORY, "%s: no memory for %zu planes", img->stem,
             plane_count);
    }
out:
    return rc;
}

/* The disk is taken first: writing to a map when the disk is full kills the process. */
static status map_values(image *img, output_file *place)
{
    status rc = STATUS_OK;
    const char *path = output_file_path(place);
    int error, file;
    void *map = MAP_FAILED;

    NEED(img->columns && img->rows, STATUS_ARGUMENT, "%s: an image of %u x %u pixels", img->stem,
         img->columns, img->rows);
    NEED(img->plane_count <= SIZE_MAX / 8 / sizeof(float) / img->columns / img->rows,
         STATUS_ARGUMENT, "%s: %u x %u pixels of %zu planes are too many", img->stem, img->columns,
         img->rows, img->plane_count);
    img->bytes = (size_t)img->columns * img->rows * img->plane_count * sizeof(float);
    file = img->file = fileno(output_file_stream(place));
    error = posix_fallocate(file, 0, (off_t)img->bytes);
    NEED(error == 0, STATUS_FILE, "%s: no place for %zu bytes: %s", path, img->bytes,
         strerror(error));
    map = mmap(NULL, img->bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    NEED(map != MAP_FAILED, STATUS_FILE, "%s: %zu bytes cannot be mapped: %s", path, img->bytes,
         strerror(errno));
    img->value = map;
out:
    return rc;
}

static status add_file(output_folder *folder, const char *stem, const char *extension,
                       output_file **out)
{
    status rc = STATUS_OK;
    const size_t size = strlen(stem) + strlen(extension) + 1;
    char *name = malloc(size);

    NEED(name, STATUS_MEMORY, "%s: no memory to write it", stem);
    snprintf(name, size, "%s%s", stem, extension);
    TRY(output_folder_add(folder, name, out));
out:
    free(name);
    return rc;
}

status image_create(image **out, output_folder *folder, const char *stem, uint32_t columns,
                    uint32_t rows, const image_plane *plane, size_t plane_count)
{
    status rc = STATUS_OK;
    output_file *place = NULL;
    image *img = calloc(1, sizeof *img);

    NEED(img, STATUS_MEMORY, "%s: no memory to write it", stem);
    assert(plane_count > 0);
    img->stem = strdup(stem);
    NEED(img->stem, STATUS_MEMORY, "%s: no memory to write it", stem);
    img->columns = columns;
    img->rows = rows;
    TRY(copy_planes(img, plane, plane_count));
    TRY(add_file(folder, stem, ".img", &place));
    TRY(add_file(folder, stem, ".hdr", &img->header));
    TRY(map_values(img, place));
    *out = img;
    img = NULL;
out:
    image_free(img);
    return rc;
}

float *image_values(image *img, size_t plane)
{
    assert(plane < img->plane_count);
    return img->value + plane * img->columns * img->rows;
}

status image_write(image *img, size_t plane, size_t first, size_t count, const float *values)
{
    status rc = STATUS_OK;
    const char *from = (const char *)values;
    size_t left = count * sizeof *values;
    off_t at = (off_t)((plane * img->columns * img->rows + first) * sizeof *values);

    while (left > 0) {
        const ssize_t done = pwrite(img->file, from, left, at);
        if (done < 0 && errno == EINTR) continue;
        NEED(done > 0, STATUS_FILE, "%s.img: writing failed: %s", img->stem, strerror(errno));
        from += done;
        at += done;
        left -= (size_t)done;
    }
out:
    return rc;
}

void image_unload(image *img)
{
    madvise(img->value, img->bytes, MADV_DONTNEED); /* of a shared map: the file keeps the values */
}

uint32_t image_columns(const image *img)
{
    return img->columns;
}

uint32_t image_rows(const image *img)
{
    return img->rows;
}

size_t image_plane_count(const image *img)
{
    return img->plane_count;
}

const image_plane *image_plane_at(const image *img, size_t plane)
{
    assert(plane < img->plane_count);
    return &img->plane[plane];
}

status image_finish(image *img, const image_header *header)
{
    return image_header_write(img->header, img, header);
}

typedef char exr_name[32];

/* The texts stored in an OpenEXR file. */
typedef struct exr_texts {
    image_text *text; /* shape (count); owns keys and values */
    size_t count;
    exr_name *spectral; /* names of spectral channels */
} exr_texts;

static void exr_texts_free(exr_texts *texts)
{
    for (size_t i = 0; i < texts->count; i++) {
        free((char *)texts->text[i].key);
        free((char *)texts->text[i].value);
    }
    free(texts->text);
    free(texts->spectral);
}

static status add_text(exr_texts *to, const char *prefix, const char *key, const char *value)
{
    status rc = STATUS_OK;
    const size_t size = strlen(prefix) + strlen(key) + 1;
    char *whole = malloc(size), *copy = strdup(value);
    image_text *more = realloc(to->text, (to->count + 1) * sizeof *more);

    if (more) to->text = more;
    NEED(whole && copy && more, STATUS_MEMORY, "%s: no memory for the text", key);
    snprintf(whole, size, "%s%s", prefix, key);
    to->text[to->count++] = (image_text){whole, copy};
    whole = copy = NULL;
out:
    free(copy);
    free(whole);
    return rc;
}

static status add_labels(exr_texts *to, const image_field *field)
{
    status rc = STATUS_OK;
    char *value = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&value, &size);

    NEED(memory, STATUS_MEMORY, "%s: no memory for the text", field->key);
    for (size_t i = 0; i < field->label_count; i++)
        fprintf(memory, "%s%d %s", i ? ", " : "", field->label[i].number, field->label[i].name);
    NEED(fclose(memory) == 0, STATUS_MEMORY, "%s: no memory for the text", field->key);
    TRY(add_text(to, "", field->key, value));
out:
    free(value);
    return rc;
}

static status add_header(exr_texts *to, const image_header *header)
{
    status rc = STATUS_OK;
    char date[] = "0000:00:00 00:00:00"; /* OpenEXR's form of 0000-00-00T00:00:00Z */

    for (size_t i = 0; i < sizeof date - 1 && header->time[i]; i++)
        if (date[i] == '0') date[i] = header->time[i];
    TRY(add_text(to, "", "DateTime", date));
    TRY(add_text(to, "", "acquisition time", header->time));
    TRY(add_text(to, "", "ImageDescription", header->description));
    for (size_t i = 0; i < header->field_count; i++) {
        const image_field *field = &header->field[i];
        if (field->text)
            TRY(add_text(to, "", field->key, field->text));
        else
            TRY(add_labels(to, field));
    }
out:
    return rc;
}

/* Two channels of one name cannot be: 0.0001 nm are the least between them. */
static bool is_spectral(const image *img)
{
    if (img->plane_count <= IMAGE_SPECTRAL || img->plane[0].wavelength_um <= 0.0) return false;
    for (size_t p = 1; p < img->plane_count; p++)
        if (img->plane[p].wavelength_um < img->plane[p - 1].wavelength_um + 2e-7) return false;
    return true;
}

static status name_spectral(exr_texts *to, const image *img)
{
    status rc = STATUS_OK;

    to->spectral = calloc(img->plane_count, sizeof *to->spectral);
    NEED(to->spectral, STATUS_MEMORY, "no memory for %zu channels", img->plane_count);
    for (size_t p = 0; p < img->plane_count; p++) {
        char *name = to->spectral[p];
        snprintf(name, sizeof(exr_name), "S0.%010.4fnm", 1e3 * img->plane[p].wavelength_um);
        name[strlen("S0.00000")] = ',';
    }
    TRY(add_text(to, "", "spectralLayoutVersion", "1.0"));
    TRY(add_text(to, "", "emissiveUnits", img->plane[0].unit));
out:
    return rc;
}

/* A picture for viewers that know no spectra: the last, middle and first plane as red, green and blue,
 * each from 0 to 1 over its range.
 *   out   shape (3) */
static status add_colours(image *img, image_channel *out)
{
    status rc = STATUS_OK;
    static const char *const names[3] = {"R", "G", "B"};
    const size_t pixels = (size_t)img->columns * img->rows, last = img->plane_count - 1;
    const size_t plane[3] = {last, last / 2, 0};

    for (int c = 0; c < 3; c++) {
        const float *value = image_values(img, plane[c]);
        value_range range;
        TRY(value_range_find(&range, value, pixels, IMAGE_NO_DATA));
        out[c] = (image_channel){names[c], value, range.min, range.max};
    }
out:
    return rc;
}

static status add_channels(exr_texts *to, image_channel **out, size_t *out_count, image *const *img,
                           size_t image_count)
{
    status rc = STATUS_OK;
    size_t count = 0;

    for (size_t i = 0; i < image_count; i++) count += img[i]->plane_count;
    image_channel *channel = calloc(count + 3, sizeof *channel);
    NEED(channel, STATUS_MEMORY, "no memory for %zu channels", count);
    for (size_t i = 0, c = 0; i < image_count; i++) {
        assert(img[i]->columns == img[0]->columns && img[i]->rows == img[0]->rows);
        const bool spectral = !to->spectral && is_spectral(img[i]);
        if (spectral) {
            TRY(name_spectral(to, img[i]));
            TRY(add_colours(img[i], channel + count));
            count += 3;
        }
        for (size_t p = 0; p < img[i]->plane_count; p++, c++) {
            const image_plane *plane = &img[i]->plane[p];
            const char *name = spectral ? to->spectral[p] : plane->name;
            channel[c] = (image_channel){.name = name, .value = image_values(img[i], p)};
            if (plane->unit[0]) TRY(add_text(to, "unit.", name, plane->unit));
        }
    }
    *out = channel;
    *out_count = count;
    channel = NULL;
out:
    free(channel);
    return rc;
}

status image_write_exr(output_folder *folder, const char *name, image *const *img,
                       size_t image_count, const image_header *header)
{
    status rc = STATUS_OK;
    char message[1024] = "";
    exr_texts texts = {0};
    image_channel *channel = NULL;
    size_t channel_count = 0;
    output_file *place = NULL;

    TRY(add_header(&texts, header));
    TRY(add_channels(&texts, &channel, &channel_count, img, image_count));
    TRY(output_folder_add(folder, name, &place));
    const image_frame frame = {img[0]->columns, img[0]->rows, texts.text, texts.count,
                               interrupt_is_set};
    NEED(image_file_write_exr(output_file_stream(place), output_file_path(place), &frame, channel,
                              channel_count, IMAGE_ZIP, message, sizeof message) == 0,
         STATUS_FILE, "%s", message);
    TRY(output_file_close(place));
out:
    free(channel);
    exr_texts_free(&texts);
    return rc;
}

void image_free(image *img)
{
    if (!img) return;
    if (img->value) munmap(img->value, img->bytes);
    for (size_t p = 0; p < img->plane_count; p++) {
        free((char *)img->plane[p].name);
        free((char *)img->plane[p].unit);
    }
    free(img->plane);
    free(img->stem);
    free(img);
}
