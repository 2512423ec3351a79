/* The header of a PLY file: what its elements are made of. */
#ifndef MESHIO_PLY_HEADER_HPP
#define MESHIO_PLY_HEADER_HPP

#include <string>
#include <string_view>
#include <vector>

enum class ply_type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class ply_format { text, little_endian, big_endian };

struct ply_property {
    std::string name;
    ply_type type;
    bool is_list;
    ply_type count_type; /* of a list */
};

struct ply_element {
    std::string name;
    std::size_t count;
    std::vector<ply_property> properties;
};

struct ply_header {
    ply_format format;
    std::vector<ply_element> elements;
    std::size_t end; /* the byte at which the elements begin */
    unsigned long line_count;
    std::size_t unknown_count; /* lines that are none of a header, passed over */
};

/* Throws failure `path:line: ...`; an element of more rows than `text` has bytes is refused. */
ply_header ply_header_read(const std::string &path, std::string_view text);

#endif
