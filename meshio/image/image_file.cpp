extern "C" {
#include "meshio/image_file.h"
}
#include "meshio/failure.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <set>
#include <vector>

namespace
{

OIIO::ImageSpec spec_of(const char *path, const image_frame &frame, std::size_t channel_count,
                        OIIO::TypeDesc type)
{
    if (!frame.width || !frame.height || frame.width > INT_MAX || frame.height > INT_MAX ||
        !channel_count)
        throw failure(std::string(path) + ": an image of " + std::to_string(frame.width) + " x " +
                      std::to_string(frame.height) + " pixels and " +
                      std::to_string(channel_count) + " channels");
    OIIO::ImageSpec spec(static_cast<int>(frame.width), static_cast<int>(frame.height),
                         static_cast<int>(channel_count), type);

    for (std::size_t i = 0; i < frame.text_count; i++)
        spec.attribute(frame.text[i].key, frame.text[i].value);
    return spec;
}

/* A file that OpenImageIO writes into. Its own files lose the error of the last block when a disk is full. */
class image_output
{
  public:
    image_output(FILE *file, const char *path, const char *format, const OIIO::ImageSpec &spec)
        : path_(path), file_(file), image_(OIIO::ImageOutput::create(format))
    {
        if (!image_) throw failure(path_ + ": OpenImageIO writes no " + format);
        proxy_ = std::make_unique<OIIO::Filesystem::IOFile>(file_,
                                                            OIIO::Filesystem::IOProxy::Mode::Write);
        image_->set_ioproxy(proxy_.get());
        if (!image_->open(path_, spec)) fail();
    }

    void write_row(std::uint32_t y, OIIO::TypeDesc type, const void *row)
    {
        if (!image_->write_scanline(static_cast<int>(y), 0, type, row)) fail();
    }

    void close()
    {
        if (!image_->close()) fail();
        if (std::ferror(file_) || std::fflush(file_)) fail();
    }

  private:
    [[noreturn]] void fail()
    {
        const int error = errno;
        const std::string text = image_->geterror();

        if (std::ferror(file_)) throw failure(path_ + ": " + std::strerror(error));
        throw failure(path_ + ": " + (text.empty() ? "OpenImageIO failed" : text));
    }

    std::string path_;
    FILE *file_;
    std::unique_ptr<OIIO::Filesystem::IOFile> proxy_;
    std::unique_ptr<OIIO::ImageOutput> image_;
};

float shown(const image_channel &channel, float value)
{
    const double fraction =
        (static_cast<double>(value) - channel.low) / (channel.high - channel.low);

    return channel.low < channel.high ? static_cast<float>(std::fmin(std::fmax(fraction, 0.0), 1.0))
                                      : value;
}

/* One row of all channels, interleaved, at a time: OpenImageIO takes no planes. */
void write_rows(image_output &output, const image_frame &frame, const image_channel *channel,
                std::size_t channel_count)
{
    std::vector<float> row(frame.width * channel_count);

    for (std::uint32_t y = 0; y < frame.height; y++) {
        if (frame.is_cancelled && frame.is_cancelled()) throw failure("interrupted");
        for (std::size_t c = 0; c < channel_count; c++) {
            const float *value = channel[c].value + std::size_t{y} * frame.width;
            for (std::size_t x = 0; x < frame.width; x++)
                row[x * channel_count + c] = shown(channel[c], value[x]);
        }
        output.write_row(y, OIIO::TypeDesc::FLOAT, row.data());
    }
}

void name_channels(const char *path, OIIO::ImageSpec &spec, const image_channel *channel)
{
    std::set<std::string> names;

    for (std::size_t c = 0; c < static_cast<std::size_t>(spec.nchannels); c++) {
        if (!names.insert(channel[c].name).second)
            throw failure(std::string(path) + ": two channels \"" + channel[c].name + '"');
        spec.channelnames[c] = channel[c].name;
    }
}

} // namespace

extern "C" int image_file_write_exr(FILE *file, const char *path, const image_frame *frame,
                                    const image_channel *channel, std::size_t channel_count,
                                    image_compression compression, char *message,
                                    std::size_t message_size)
try {
    OIIO::ImageSpec spec = spec_of(path, *frame, channel_count, OIIO::TypeDesc::FLOAT);

    name_channels(path, spec, channel);
    spec.attribute("compression", compression == IMAGE_ZIP ? "zip" : "none");
    if (!spec.find_attribute("DateTime")) spec.attribute("DateTime", ""); /* else it becomes now */
    image_output output(file, path, "openexr", spec);
    write_rows(output, *frame, channel, channel_count);
    output.close();
    return 0;
} catch (...) {
    return failure_report(path, message, message_size);
}

extern "C" int image_file_write_png(FILE *file, const char *path, const image_frame *frame,
                                    image_row_source *row, void *self, char *message,
                                    std::size_t message_size)
try {
    OIIO::ImageSpec spec = spec_of(path, *frame, 3, OIIO::TypeDesc::UINT8);
    /* Of zlib's levels a fast one: 8 % larger than by default, half the time. */
    spec.attribute("png:compressionLevel", 3);
    image_output output(file, path, "png", spec);

    for (std::uint32_t y = 0; y < frame->height; y++) {
        const std::uint8_t *rgb = row(self, y);
        if (!rgb) throw failure(std::string(path) + ": no row " + std::to_string(y));
        output.write_row(y, OIIO::TypeDesc::UINT8, rgb);
    }
    output.close();
    return 0;
} catch (...) {
    return failure_report(path, message, message_size);
}

extern "C" int image_file_read_channel(float **out, std::uint32_t *out_width,
                                       std::uint32_t *out_height, const char *path,
                                       const char *name, char *message, std::size_t message_size)
try {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("openexr");
    OIIO::ImageSpec spec;

    if (!input->open(path, spec)) throw failure(std::string(path) + ": " + input->geterror());
    const int channel = spec.channelindex(name);
    if (channel < 0) throw failure(std::string(path) + ": no channel \"" + name + '"');
    const std::size_t count =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
    std::unique_ptr<float, void (*)(void *)> value(
        static_cast<float *>(std::malloc(count * sizeof(float))), std::free);
    if (!value) throw std::bad_alloc();
    if (!input->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, value.get()))
        throw failure(std::string(path) + ": " + input->geterror());
    *out_width = static_cast<std::uint32_t>(spec.width);
    *out_height = static_cast<std::uint32_t>(spec.height);
    *out = value.release();
    return 0;
} catch (...) {
    return failure_report(path, message, message_size);
}
