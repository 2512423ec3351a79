extern "C" {
#include "input_file.h"
}
#include "failure.hpp"
#include "file_text.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <new>
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

thread_local input_file_observer *told = nullptr;
thread_local void *told_self = nullptr;

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

extern "C" int input_file_read(char **out, std::size_t *out_size, const char *path,
                               std::size_t limit, char *message, std::size_t message_size)
try {
    FILE *opened = nullptr;
    std::size_t size = 0;

    if (input_file_open(&opened, &size, path, limit, message, message_size)) return 1;
    const std::unique_ptr<FILE, int (*)(FILE *)> file(opened, std::fclose);
    std::unique_ptr<char, void (*)(void *)> text(static_cast<char *>(std::malloc(size + 1)),
                                                 std::free);
    if (!text) throw std::bad_alloc();
    file_text_fill(text.get(), size, file.get(), path);
    text.get()[size] = '\0';
    *out_size = size;
    *out = text.release();
    return 0;
} catch (...) {
    return failure_report(path, message, message_size);
}

extern "C" void input_file_observe(input_file_observer *observer, void *self)
{
    told = observer;
    told_self = self;
}

extern "C" void input_file_tell(const char *path, const void *bytes, std::size_t size)
{
    if (told) told(told_self, path, bytes, size);
}
