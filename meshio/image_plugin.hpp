/* What the plug-in `image` offers: image_file.h and lettering.h, by OpenImageIO. */
#ifndef MESHIO_IMAGE_PLUGIN_HPP
#define MESHIO_IMAGE_PLUGIN_HPP

#include <cstddef>
#include <cstdint>

extern "C" {
#include "image_file.h"
#include "lettering.h"
}

struct image_plugin {
    decltype(&image_file_write_exr) write_exr;
    decltype(&image_file_write_png) write_png;
    decltype(&image_file_read_channel) read_channel;
    decltype(&lettering_width) width;
    decltype(&lettering_draw) draw;
};

#endif
