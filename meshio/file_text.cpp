#include "file_text.hpp"

#include "failure.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sys/stat.h>

std::string file_text_load(const std::string &path)
{
    const long long too_large = 1ll << 32; /* numbers of corners and bytes must fit 32 bit */
    std::unique_ptr<FILE, int (*)(FILE *)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    struct stat about = {};
    std::string text;

    if (!file || fstat(fileno(file.get()), &about))
        throw failure(path + ": " + std::strerror(errno));
    if (S_ISDIR(about.st_mode)) throw failure(path + ": a folder, expected a file");
    if (about.st_size >= too_large) throw failure(path + ": 4 GiB or larger");
    text.resize(static_cast<std::size_t>(about.st_size));
    if (std::fread(text.data(), 1, text.size(), file.get()) != text.size())
        throw failure(path + ": cannot be read");
    return text;
}
