#include "file_text.hpp"

extern "C" {
#include "input_file.h"
}
#include "failure.hpp"

#include <memory>

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
    if (std::fread(text.data(), 1, size, file.get()) != size)
        throw failure(path + ": cannot be read");
    return text;
}
