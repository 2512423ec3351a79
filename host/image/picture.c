#include "image/picture.h"

#include "base/interrupt.h"
#include "meshio/image_file.h"
#include "meshio/lettering.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE_SIZE = 1024, STRIP_BYTES = 1 << 22 };

struct picture {
    lettering_page page; /* rows first .. first + page.height - 1 */
    uint32_t first, height;
    picture_painter *paint;
    const void *self;
    status rc; /* of the last strip */
};

status picture_prepare(void)
{
    status rc = STATUS_OK;
    char message[MESSAGE_SIZE] = "";

    NEED(image_file_prepare(message, sizeof message) == 0, STATUS_FILE, "%s", message);
out:
    return rc;
}

void picture_fill(picture *pic, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                  const uint8_t rgb[3])
{
    uint32_t end;
    const uint32_t first = picture_rows(pic, &end), below = y + height;

    assert(x + width <= pic->page.width && below <= pic->height);
    for (uint32_t row = y > first ? y : first; row < (below < end ? below : end); row++) {
        uint8_t *pixel = pic->page.rgb + ((size_t)(row - first) * pic->page.width + x) * 3;
        for (uint32_t column = 0; column < width; column++, pixel += 3) memcpy(pixel, rgb, 3);
    }
}

uint32_t picture_rows(const picture *pic, uint32_t *out_end)
{
    const uint32_t left = pic->height - pic->first;

    *out_end = pic->first + (left < pic->page.height ? left : pic->page.height);
    return pic->first;
}

status picture_text(picture *pic, uint32_t x, uint32_t y, const char *text, int size)
{
    status rc = STATUS_OK;
    static const uint8_t ink[3] = {25, 25, 25};
    char message[MESSAGE_SIZE] = "";
    const int64_t top = (int64_t)y - pic->first, reach = 2 * size; /* of letters, up and down */

    if (top + reach < 0 || top - reach > (int64_t)pic->page.height) goto out;
    NEED(lettering_draw(&pic->page, (int)x, (int)top, text, size, ink, message, sizeof message) ==
             0,
         STATUS_FILE, "%s", message);
out:
    return rc;
}

status picture_text_width(uint32_t *out_width, const char *text, int size)
{
    status rc = STATUS_OK;
    char message[MESSAGE_SIZE] = "";
    int width = 0;

    NEED(lettering_width(&width, text, size, message, sizeof message) == 0, STATUS_FILE, "%s",
         message);
    *out_width = (uint32_t)width;
out:
    return rc;
}

/* Draws the strip that begins with row `first`. */
static status draw_strip(picture *pic, uint32_t first)
{
    status rc = STATUS_OK;

    TRY(interrupt_check());
    pic->first = first;
    memset(pic->page.rgb, 255, (size_t)pic->page.width * pic->page.height * 3);
    TRY(pic->paint(pic, pic->self));
out:
    return rc;
}

static const uint8_t *row_of(void *self, uint32_t y)
{
    picture *pic = self;
    const uint32_t row = y % pic->page.height;

    if (row == 0) pic->rc = draw_strip(pic, y);
    if (pic->rc == STATUS_OK) pic->rc = interrupt_check();
    return pic->rc == STATUS_OK ? pic->page.rgb + (size_t)row * pic->page.width * 3 : NULL;
}

status picture_write(output_file *place, uint32_t width, uint32_t height, picture_painter *paint,
                     const void *self)
{
    status rc = STATUS_OK;
    char message[MESSAGE_SIZE] = "";
    const size_t most = STRIP_BYTES / ((size_t)width * 3) + 1;
    const image_frame frame = {.width = width, .height = height};
    picture pic = {.page = {.width = width, .height = height < most ? height : (uint32_t)most},
                   .height = height,
                   .paint = paint,
                   .self = self};

    pic.page.rgb = malloc((size_t)width * pic.page.height * 3);
    NEED(pic.page.rgb, STATUS_MEMORY, "no memory for a picture of %u x %u pixels", width, height);
    const int code = image_file_write_png(output_file_stream(place), output_file_path(place),
                                          &frame, row_of, &pic, message, sizeof message);
    TRY(pic.rc);
    NEED(code == 0, STATUS_FILE, "%s", message);
    TRY(output_file_close(place));
out:
    free(pic.page.rgb);
    return rc;
}
