#include "image_plugin.hpp"

extern "C" {
#include "plugin.h"
}

namespace
{

const image_plugin *load(char *message, std::size_t message_size)
{
    return static_cast<const image_plugin *>(plugin_load("image", message, message_size));
}

} // namespace

extern "C" int image_file_prepare(char *message, std::size_t message_size)
{
    return load(message, message_size) ? 0 : 1;
}

extern "C" int image_file_write_exr(FILE *file, const char *path, const image_frame *frame,
                                    const image_channel *channel, std::size_t channel_count,
                                    image_compression compression, char *message,
                                    std::size_t message_size)
{
    const image_plugin *image = load(message, message_size);

    return image ? image->write_exr(file, path, frame, channel, channel_count, compression, message,
                                    message_size)
                 : 1;
}

extern "C" int image_file_write_png(FILE *file, const char *path, const image_frame *frame,
                                    image_row_source *row, void *self, char *message,
                                    std::size_t message_size)
{
    const image_plugin *image = load(message, message_size);

    return image ? image->write_png(file, path, frame, row, self, message, message_size) : 1;
}

extern "C" int image_file_read_channel(float **out, std::uint32_t *out_width,
                                       std::uint32_t *out_height, const char *path,
                                       const char *name, char *message, std::size_t message_size)
{
    const image_plugin *image = load(message, message_size);

    return image
               ? image->read_channel(out, out_width, out_height, path, name, message, message_size)
               : 1;
}

extern "C" int lettering_width(int *out_width, const char *text, int size, char *message,
                               std::size_t message_size)
{
    const image_plugin *image = load(message, message_size);

    return image ? image->width(out_width, text, size, message, message_size) : 1;
}

extern "C" int lettering_draw(const lettering_page *page, int x, int y, const char *text, int size,
                              const std::uint8_t colour[3], char *message, std::size_t message_size)
{
    const image_plugin *image = load(message, message_size);

    return image ? image->draw(page, x, y, text, size, colour, message, message_size) : 1;
}
