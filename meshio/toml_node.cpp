#include "failure.hpp"
#include "toml_tree.hpp"

#include <cmath>
#include <cstdio>

namespace
{

int refuse(const toml_node &node, const char *expected, char *message, std::size_t message_size)
{
    std::snprintf(message, message_size, "%s: %s: %s, expected %s", node.where.c_str(),
                  node.name.c_str(), node.text.c_str(), expected);
    return 1;
}

bool is_number(const toml_node &node)
{
    return node.kind == TOML_NUMBER && std::isfinite(node.number);
}

} // namespace

extern "C" toml_kind toml_node_kind(const toml_node *node)
{
    return node->kind;
}

extern "C" int toml_node_line(const toml_node *node)
{
    return node->line;
}

extern "C" const char *toml_node_where(const toml_node *node)
{
    return node->where.c_str();
}

extern "C" const char *toml_node_key(const toml_node *node)
{
    return node->key.c_str();
}

extern "C" const char *toml_node_name(const toml_node *node)
{
    return node->name.c_str();
}

extern "C" const char *toml_node_text(const toml_node *node)
{
    return node->text.c_str();
}

extern "C" std::size_t toml_node_count(const toml_node *node)
{
    return node->child.size();
}

extern "C" const toml_node *toml_node_at(const toml_node *node, std::size_t index)
{
    return index < node->child.size() ? node->child[index].get() : nullptr;
}

extern "C" const toml_node *toml_node_get(const toml_node *node, const char *key)
{
    if (!node || node->kind != TOML_TABLE) return nullptr;
    for (const auto &child : node->child)
        if (child->key == key) return child.get();
    return nullptr;
}

extern "C" int toml_node_string(const char **out, const toml_node *node, char *message,
                                std::size_t message_size)
{
    if (node->kind != TOML_STRING) return refuse(*node, "a string", message, message_size);
    *out = node->string.c_str();
    return 0;
}

extern "C" int toml_node_number(double *out, const toml_node *node, char *message,
                                std::size_t message_size)
{
    if (!is_number(*node)) return refuse(*node, "a finite number", message, message_size);
    *out = node->number;
    return 0;
}

extern "C" int toml_node_bool(int *out, const toml_node *node, char *message,
                              std::size_t message_size)
{
    if (node->kind != TOML_BOOL) return refuse(*node, "true or false", message, message_size);
    *out = node->flag;
    return 0;
}

extern "C" int toml_node_time(const char **out, const toml_node *node, char *message,
                              std::size_t message_size)
{
    if (node->kind != TOML_TIME || !node->has_offset)
        return refuse(*node, "a date and time with offset, such as 1987-06-24T10:00:00-05:00",
                      message, message_size);
    *out = node->string.c_str();
    return 0;
}

extern "C" int toml_node_numbers(const double **out, std::size_t *out_count, const toml_node *node,
                                 char *message, std::size_t message_size)
{
    if (node->kind != TOML_ARRAY)
        return refuse(*node, "an array of numbers", message, message_size);
    for (const auto &child : node->child)
        if (!is_number(*child)) return refuse(*child, "a finite number", message, message_size);
    *out = node->numbers.data();
    *out_count = node->numbers.size();
    return 0;
}

extern "C" int toml_node_strings(const char *const **out, std::size_t *out_count,
                                 const toml_node *node, char *message, std::size_t message_size)
{
    if (node->kind != TOML_ARRAY)
        return refuse(*node, "an array of strings", message, message_size);
    for (const auto &child : node->child)
        if (child->kind != TOML_STRING) return refuse(*child, "a string", message, message_size);
    *out = node->strings.data();
    *out_count = node->strings.size();
    return 0;
}
