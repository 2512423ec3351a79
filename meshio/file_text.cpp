#include "file_text.hpp"

extern "C" {
#include "input_file.h"
}
#include "cancel.hpp"
#include "failure.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

namespace
{

const std::size_t portion = 1 << 24; /* bytes */

} // namespace

std::string file_text_load(const std::string &path)
{
    char message[1024];
    FILE *opened = nullptr;
    std::size_t size = 0;
    std::string text;

    if (input_file_open(&opened, &size, path.c_str(), INPUT_FILE_TEXT_LIMIT, message,
                        sizeof message))
        throw failure(message);
    const std::unique_ptr<FILE, int (*)(FILE *)> file(opened, std::fclose);
    text.resize(size);
    file_text_fill(text.data(), size, file.get(), path);
    return text;
}

void file_text_fill(char *out, std::size_t size, FILE *file, const std::string &path)
{
    for (std::size_t at = 0; at < size; at += portion) {
        const std::size_t wanted = std::min(portion, size - at);
        cancel_check();
        if (std::fread(out + at, 1, wanted, file) != wanted)
            throw failure(path + ": cannot be read: " +
                          (std::ferror(file) ? std::strerror(errno) : "it became shorter"));
    }
    input_file_tell(path.c_str(), out, size);
}
