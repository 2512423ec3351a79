#include "ply_header.hpp"

#include "mesh_text.hpp"

namespace
{

ply_type type_of(const mesh_text &lines, std::string_view word)
{
    static const struct {
        const char *name;
        ply_type type;
    } known[] = {{"char", ply_type::int8},      {"int8", ply_type::int8},
                 {"uchar", ply_type::uint8},    {"uint8", ply_type::uint8},
                 {"short", ply_type::int16},    {"int16", ply_type::int16},
                 {"ushort", ply_type::uint16},  {"uint16", ply_type::uint16},
                 {"int", ply_type::int32},      {"int32", ply_type::int32},
                 {"uint", ply_type::uint32},    {"uint32", ply_type::uint32},
                 {"float", ply_type::float32},  {"float32", ply_type::float32},
                 {"double", ply_type::float64}, {"float64", ply_type::float64}};

    for (const auto &one : known)
        if (word == one.name) return one.type;
    lines.fail(word, "a type such as int or float");
}

ply_format format_of(const mesh_text &lines, std::string_view word)
{
    if (word == "ascii") return ply_format::text;
    if (word == "binary_little_endian") return ply_format::little_endian;
    if (word == "binary_big_endian") return ply_format::big_endian;
    lines.fail(word, "ascii, binary_little_endian or binary_big_endian");
}

ply_element element_of(const mesh_text &lines, std::string_view rest, std::size_t most)
{
    const std::string_view name = mesh_text_word(rest), word = mesh_text_word(rest);
    const long long count = lines.integer(word);

    if (count < 0 || static_cast<unsigned long long>(count) > most)
        lines.fail(word,
                   "a number of rows that a file of " + std::to_string(most) + " bytes can hold");
    return {std::string(name), static_cast<std::size_t>(count), {}};
}

ply_property property_of(const mesh_text &lines, std::string_view rest)
{
    std::string_view word = mesh_text_word(rest);
    const bool is_list = word == "list";
    const ply_type count_type = is_list ? type_of(lines, mesh_text_word(rest)) : ply_type::uint8;

    if (is_list) word = mesh_text_word(rest);
    const ply_type type = type_of(lines, word);
    const std::string_view name = mesh_text_word(rest);
    if (name.empty()) lines.fail(name, "the name of a property");
    return {std::string(name), type, is_list, count_type};
}

} // namespace

ply_header ply_header_read(const std::string &path, std::string_view text)
{
    mesh_text lines(path, text);
    ply_header header{};
    std::string_view rest, keyword;
    bool has_format = false;

    if (!lines.next(rest) || !mesh_text_is(mesh_text_word(rest), "ply"))
        lines.fail("expected a first line \"ply\"");
    while (lines.next(rest) && (keyword = mesh_text_word(rest)) != "end_header") {
        if (keyword == "format") {
            header.format = format_of(lines, mesh_text_word(rest));
            has_format = true;
        } else if (keyword == "element") {
            header.elements.push_back(element_of(lines, rest, text.size()));
        } else if (keyword == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(property_of(lines, rest));
        } else if (keyword == "property" || keyword == "ply") {
            lines.fail(keyword, "format or element");
        } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
            header.unknown_count++;
        }
    }
    if (keyword != "end_header") lines.fail("the file ends here, expected end_header");
    if (!has_format) lines.fail("a header without format");
    header.end = lines.position();
    header.line_count = lines.line();
    return header;
}
