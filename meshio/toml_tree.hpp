/* What stands behind toml_node.h. It is kept apart from toml++'s tree, whose nodes know neither
 * their key nor its line, nor their dotted name. */
#ifndef MESHIO_TOML_TREE_HPP
#define MESHIO_TOML_TREE_HPP

extern "C" {
#include "toml_node.h"
}

#include <memory>
#include <string>
#include <toml++/toml.h>
#include <vector>

struct toml_node {
    toml_kind kind = TOML_TABLE;
    int line = 0, depth = 0;
    std::string where, key, name, text;
    std::vector<std::unique_ptr<toml_node>> child;

    std::string string; /* of TOML_STRING and TOML_TIME */
    double number = 0;
    bool flag = false, has_offset = false;
    std::vector<double> numbers;       /* of an array: those children that are numbers */
    std::vector<const char *> strings; /* and those that are strings */
};

/* Mirrors a document that was read from `path`. */
std::unique_ptr<toml_node> toml_tree_build(const toml::table &root, const std::string &path);

#endif
