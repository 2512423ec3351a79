#include "picture.h"

#include "image_file.h"
#include "lettering.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE_SIZE = 1024 };

struct picture {
    lettering_page page;
};

status picture_prepare(void)
{
    status rc = STATUS_OK;
    char message[MESSAGE_SIZE] = "";

    NEED(image_file_prepare(message, sizeof message) == 0, STATUS_FILE, "%s", message);
out:
    return rc;
}

status picture_create(picture **out, uint32_t width, uint32_t height)
{
    status rc = STATUS_OK;
    picture *pic = calloc(1, sizeof *pic);

    NEED(pic, STATUS_MEMORY, "no memory for a picture");
    pic->page = (lettering_page){width, height, malloc((size_t)width * height * 3)};
    NEED(pic->page.rgb, STATUS_MEMORY, "no memory for a picture of %u x %u pixels", width, height);
    memset(pic->page.rgb, 255, (size_t)width * height * 3);
    *out = pic;
    pic = NULL;
out:
    picture_free(pic);
    return rc;
}

void picture_fill(picture *pic, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                  const uint8_t rgb[3])
{
    assert(x + width <= pic->page.width && y + height <= pic->page.height);
    for (uint32_t row = y; row < y + height; row++) {
        uint8_t *pixel = pic->page.rgb + ((size_t)row * pic->page.width + x) * 3;
        for (uint32_t column = 0; column < width; column++, pixel += 3) memcpy(pixel, rgb, 3);
    }
}

status picture_text(picture *pic, uint32_t x, uint32_t y, const char *text, int size)
{
    status rc = STATUS_OK;
    static const uint8_t ink[3] = {25, 25, 25};
    char message[MESSAGE_SIZE] = "";

    NEED(lettering_draw(&pic->page, (int)x, (int)y, text, size, ink, message, sizeof message) == 0,
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

status picture_write(const picture *pic, output_file *place)
{
    status rc = STATUS_OK;
    char message[MESSAGE_SIZE] = "";
    const image_frame frame = {.width = pic->page.width, .height = pic->page.height};

    NEED(image_file_write_png(output_file_stream(place), output_file_path(place), &frame,
                              pic->page.rgb, message, sizeof message) == 0,
         STATUS_FILE, "%s", message);
    TRY(output_file_close(place));
out:
    return rc;
}

void picture_free(picture *pic)
{
    if (!pic) return;
    free(pic->page.rgb);
    free(pic);
}
