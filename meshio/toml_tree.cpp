#include "toml_tree.hpp"

#include "failure.hpp"
#include "toml_depth.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace
{

const std::size_t longest_text = 60;

std::string streamed(const toml::date_time &time)
{
    std::ostringstream stream;

    stream << time;
    if (!stream) throw std::bad_alloc(); /* it is cut */
    return stream.str();
}

/* As TOML on one line, numbers with as few digits as tell them apart. */
std::string text_of(const toml::node &value)
{
    if (value.is_table()) return "a table";
    if (const auto *string = value.as_string()) return '"' + **string + '"';
    if (const auto *number = value.as_floating_point()) {
        char digits[32];
        return {digits, std::to_chars(digits, digits + sizeof digits, **number).ptr};
    }
    if (const auto *array = value.as_array()) {
        std::string text = "[";
        for (const toml::node &one : *array) text += (text.size() > 1 ? ", " : "") + text_of(one);
        return text + ']';
    }
    std::ostringstream stream;
    stream << toml::toml_formatter(value);
    return stream.str();
}

std::string cut(const std::string &text)
{
    return text.size() > longest_text ? text.substr(0, longest_text) + "..." : text;
}

/* Nodes of the file have a source path, those of --set have none. */
void place(toml_node &node, const toml::node &value, const toml::source_region &key)
{
    const toml::source_region &source = value.source();

    node.where = "--set";
    if (!source.path) return;
    node.line = static_cast<int>(key.begin ? key.begin.line : source.begin.line);
    node.where = *source.path + ":" + std::to_string(node.line);
}

void set_value(toml_node &node, const toml::node &value)
{
    if (const auto *string = value.as_string()) {
        node.kind = TOML_STRING;
        node.string = **string;
    } else if (value.is_number()) {
        node.kind = TOML_NUMBER;
        node.number = *value.value<double>();
    } else if (const auto *flag = value.as_boolean()) {
        node.kind = TOML_BOOL;
        node.flag = **flag;
    } else {
        const auto *time = value.as_date_time();
        node.kind = TOML_TIME;
        node.has_offset = time && (*time)->offset;
        if (time) node.string = streamed(**time);
    }
}

std::unique_ptr<toml_node> child_of(const toml_node &parent, const toml::node &value,
                                    const toml::source_region &key, const std::string &name);

void add_table(toml_node &node, const toml::table &table)
{
    std::vector<std::pair<const toml::key *, const toml::node *>> entry;
    const auto order = [](const auto &a) {
        const toml::source_position at = a.first->source().begin;
        return a.second->source().path ? std::make_pair(at.line, at.column)
                                       : std::make_pair(UINT32_MAX, UINT32_MAX);
    };

    for (const auto &[key, value] : table) entry.emplace_back(&key, &value);
    std::stable_sort(entry.begin(), entry.end(),
                     [&order](const auto &a, const auto &b) { return order(a) < order(b); });
    for (const auto &[key, value] : entry) {
        const std::string name(key->str());
        node.child.push_back(child_of(node, *value, key->source(), name));
        node.child.back()->key = name;
    }
}

void add_array(toml_node &node, const toml::array &array)
{
    node.kind = TOML_ARRAY;
    for (const toml::node &value : array) {
        const std::string name = std::to_string(node.child.size());
        node.child.push_back(child_of(node, value, {}, name));
        const toml_node &child = *node.child.back();
        if (child.kind == TOML_NUMBER) node.numbers.push_back(child.number);
        if (child.kind == TOML_STRING) node.strings.push_back(child.string.c_str());
    }
}

std::unique_ptr<toml_node> child_of(const toml_node &parent, const toml::node &value,
                                    const toml::source_region &key, const std::string &name)
{
    auto node = std::make_unique<toml_node>();

    node->name = parent.name.empty() ? name : parent.name + "." + name;
    node->text = cut(text_of(value));
    place(*node, value, key);
    node->depth = parent.depth + 1;
    if (node->depth > toml_depth_nodes)
        throw failure(node->where + ": tables and arrays more than " +
                      std::to_string(toml_depth_nodes) + " deep");
    if (const toml::table *table = value.as_table())
        add_table(*node, *table);
    else if (const toml::array *array = value.as_array())
        add_array(*node, *array);
    else
        set_value(*node, value);
    if (node->string.find('\0') != node->string.npos)
        throw failure(node->where + ": " + node->name + ": a text with a zero character");
    return node;
}

} // namespace

std::unique_ptr<toml_node> toml_tree_build(const toml::table &root, const std::string &path)
{
    auto node = std::make_unique<toml_node>();

    node->where = path;
    node->text = "a table";
    add_table(*node, root);
    return node;
}
