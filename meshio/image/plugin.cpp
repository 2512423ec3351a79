#include "meshio/image_plugin.hpp"

extern "C" {
#include "meshio/plugin.h"
}

namespace
{

const image_plugin functions = {image_file_write_exr, image_file_write_png, image_file_read_channel,
                                lettering_width, lettering_draw};

} // namespace

extern "C" __attribute__((visibility("default")))
const plugin_export radsig_plugin = {RADSIG_VERSION, &functions};
