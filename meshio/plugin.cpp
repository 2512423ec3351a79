extern "C" {
#include "plugin.h"
}
#include "failure.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <climits>
#include <cstring>
#include <string>

namespace
{

std::string program_folder()
{
    char path[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", path, sizeof path);

    if (length < 0 || length == sizeof path)
        throw failure("/proc/self/exe: does not tell where the program is, and so its plug-ins");
    const std::string program(path, static_cast<std::size_t>(length));
    return program.substr(0, program.rfind('/'));
}

std::string find(const std::string &name)
{
    const std::string folder = program_folder();
    const std::string beside = folder + "/plugins/" + name + ".so";
    const std::string installed = folder + "/../lib/radsig/" + name + ".so";

    if (access(beside.c_str(), F_OK) == 0) return beside;
    if (access(installed.c_str(), F_OK) == 0) return installed;
    throw failure(beside + ": a part of radsig is missing (nor is there " + installed + ')');
}

} // namespace

extern "C" const void *plugin_load(const char *name, char *message, std::size_t message_size)
try {
    const std::string path = find(name);
    void *const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    const void *const symbol = library ? dlsym(library, "radsig_plugin") : nullptr;

    if (!symbol) throw failure(path + ": cannot be loaded: " + dlerror());
    const plugin_export *const plugin = static_cast<const plugin_export *>(symbol);
    if (std::strcmp(plugin->version, RADSIG_VERSION) != 0)
        throw failure(path + ": found version " + plugin->version +
                      ", expected " RADSIG_VERSION ", that of the program");
    return plugin->functions;
} catch (...) {
    failure_report(name, message, message_size);
    return nullptr;
}
