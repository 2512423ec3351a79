/* radsig: the command line. */
#include "command/command.h"

static const program_command commands[] = {
    {"render", command_render, "make the image of a scene and its truth planes"},
    {"check", command_check, "read a scene, report every error, summarise it"},
    {"trace", command_trace, "intersect rays from stdin with meshes"},
    {"shape-factor", command_shape_factor, "share of the sky that a point sees"},
    {"thermal", command_thermal, "take one facet through a weather history"},
    {"sun", command_sun, "position of the sun"},
    {"weather", command_weather, "write the weather of a scene as a .wth"},
    {"material", command_material, "list, show and convert materials and their spectra"},
    {"validate", command_validate, "compare temperatures with measured ones"},
    {"view", command_view, "start the preview"},
    {"devices", command_devices, "list the OpenCL devices"},
};

int main(int argc, char **argv)
{
    const program radsig = {"radsig", commands, sizeof commands / sizeof *commands};

    return program_run(&radsig, argc, argv);
}
