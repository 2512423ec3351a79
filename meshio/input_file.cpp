extern "C" {
#include "input_file.h"
}
#include "failure.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

const char *kind_of(mode_t mode)
{
    return S_ISDIR(mode)    ? "a folder"
           : S_ISFIFO(mode) ? "a pipe"
           : S_ISSOCK(mode) ? "a socket"
                            : "a device";
}

} // namespace

extern "C" int input_file_open(FILE **out, std::size_t *out_size, const char *path,
                               std::size_t limit, char *message, std::size_t message_size)
try {
    const std::string name = path;
    /* A pipe nobody writes to would let others wait here. */
    const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    struct stat about = {};

    if (descriptor < 0) throw failure(name + ": " + std::strerror(errno));
    std::unique_ptr<FILE, int (*)(FILE *)> file(fdopen(descriptor, "rb"), std::fclose);
    if (!file) close(descriptor);
    if (!file || fstat(descriptor, &about)) throw failure(name + ": " + std::strerror(errno));
    if (!S_ISREG(about.st_mode))
        throw failure(name + ": " + kind_of(about.st_mode) + ", expected a file");
    if (static_cast<std::size_t>(about.st_size) > limit)
        throw failure(name + ": " + std::to_string(about.st_size) + " bytes, expected at most " +
                      std::to_string(limit));
    if (out_size) *out_size = static_cast<std::size_t>(about.st_size);
    *out = file.release();
    return 0;
} catch (...) {
    return failure_report(path, message, message_size);
}
