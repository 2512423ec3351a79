extern "C" {
#include "toml_file.h"
}
#include "failure.hpp"
#include "file_text.hpp"
#include "toml_depth.hpp"
#include "toml_setting.hpp"
#include "toml_tree.hpp"

struct toml_file {
    std::unique_ptr<toml_node> root;
};

namespace
{

toml::table document_of(const std::string &path)
{
    const std::string text = file_text_load(path);

    toml_depth_check(text, path);
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error &e) {
        throw failure(path + ":" + std::to_string(e.source().begin.line) + ": " +
                      std::string(e.description()));
    }
}

} // namespace

extern "C" int toml_file_read(toml_file **out, const char *path, const char *const *setting,
                              std::size_t setting_count, char *message, std::size_t message_size)
try {
    auto file = std::make_unique<toml_file>();
    toml::table document = document_of(path);

    for (std::size_t i = 0; i < setting_count; i++) toml_setting_apply(document, setting[i]);
    file->root = toml_tree_build(document, path);
    *out = file.release();
    return 0;
} catch (...) {
    return failure_report(path, message, message_size);
}

extern "C" const toml_node *toml_file_root(const toml_file *file)
{
    return file->root.get();
}

extern "C" void toml_file_free(toml_file *file)
{
    delete file;
}
