/* Polygon File Format, text and binary. OpenMesh's reader keeps coordinates as floats, which moves
 * metres of a map grid by up to a quarter, makes integer coordinates of a binary file zero, and
 * takes a truncated text for a whole one. */
#include "cancel.hpp"
#include "failure.hpp"
#include "mesh_soup.hpp"
#include "mesh_text.hpp"
#include "ply_header.hpp"

#include <cmath>
#include <cstring>
#include <memory>

namespace
{

/* The numbers behind the header, one after the other. */
class ply_body
{
  public:
    virtual ~ply_body() = default;
    virtual double next(ply_type type) = 0;
    [[noreturn]] virtual void fail(const std::string &what) const = 0;

    /* Passes over what a row holds beyond its properties, where rows are told apart. */
    virtual void end_row()
    {
    }

    /* Fails unless everything has been read; warns of what follows without a meaning. */
    virtual void end(mesh_soup &soup) = 0;

    std::size_t next_count(ply_type type)
    {
        const double count = next(type);

        if (!(count >= 0 && count <= UINT32_MAX) || count != std::floor(count))
            fail("a list of " + mesh_text_shown(count) + " numbers");
        return static_cast<std::size_t>(count);
    }
};

class ply_text : public ply_body
{
  public:
    ply_text(const std::string &path, std::string_view text, const ply_header &header)
        : lines_(path, text, header.end, header.line_count),
          has_row_a_line_(line_count(lines_) == row_count(header))
    {
    }

    double next(ply_type) override
    {
        const std::string_view word = next_word();

        if (word.empty())
            fail(has_row_a_line_
                     ? "the line ends here, expected the properties that the header promises"
                     : "the file ends here, expected the rows that the header promises");
        return lines_.number(word);
    }

    void end_row() override
    {
        if (!has_row_a_line_) return;
        surplus_count_ += !mesh_text_word(rest_).empty();
        is_inside_ = false;
        rest_ = {};
    }

    void fail(const std::string &what) const override
    {
        lines_.fail(what);
    }

    void end(mesh_soup &soup) override
    {
        is_inside_ = false;
        const std::string_view word = next_word();

        if (!word.empty())
            lines_.fail(word, "the end of the file after the rows that the header promises");
        soup.warn_of(surplus_count_,
                     "rows hold more than the header promises: the rest is passed over");
    }

  private:
    /* Lines that hold no row: blank, or a comment, which belongs in the header. */
    static bool is_remark(std::string_view line)
    {
        const std::string_view word = mesh_text_word(line);

        return word.empty() || word[0] == '#' || word == "comment";
    }

    static std::size_t line_count(mesh_text lines)
    {
        std::size_t count = 0;

        for (std::string_view line; lines.next(line);) count += !is_remark(line);
        return count;
    }

    static std::size_t row_count(const ply_header &header)
    {
        std::size_t count = 0;

        for (const ply_element &element : header.elements) count += element.count;
        return count;
    }

    std::string_view next_word()
    {
        std::string_view word;

        while ((word = mesh_text_word(rest_)).empty() && !(has_row_a_line_ && is_inside_) &&
               lines_.next(rest_))
            if (is_remark(rest_)) rest_ = {};
        is_inside_ = true;
        return word;
    }

    mesh_text lines_;
    bool has_row_a_line_; /* as many lines as rows: then a line is a row */
    bool is_inside_ = false;
    std::size_t surplus_count_ = 0;
    std::string_view rest_;
};

class ply_binary : public ply_body
{
  public:
    ply_binary(const std::string &path, std::string_view text, const ply_header &header)
        : path_(path), rest_(text.substr(header.end)),
          is_swapped_(header.format == ply_format::big_endian)
    {
    }

    double next(ply_type type) override
    {
        switch (type) {
        case ply_type::int8:
            return take<std::int8_t>();
        case ply_type::uint8:
            return take<std::uint8_t>();
        case ply_type::int16:
            return take<std::int16_t>();
        case ply_type::uint16:
            return take<std::uint16_t>();
        case ply_type::int32:
            return take<std::int32_t>();
        case ply_type::uint32:
            return take<std::uint32_t>();
        case ply_type::float32:
            return static_cast<double>(take<float>());
        case ply_type::float64:
            break;
        }
        return take<double>();
    }

    void fail(const std::string &what) const override
    {
        throw failure(path_ + ": " + what);
    }

    void end(mesh_soup &soup) override
    {
        const std::string_view blank(" \r\n\0\x1a", 5);

        if (rest_.find_first_not_of(blank) != rest_.npos)
            fail(std::to_string(rest_.size()) + " bytes after the rows that the header promises");
        if (rest_.find('\0') != rest_.npos)
            soup.warn_of(rest_.size(), "bytes without a meaning follow the rows");
    }

  private:
    template <typename T> T take()
    {
        unsigned char byte[sizeof(T)];
        T value;

        if (rest_.size() < sizeof value)
            fail("the file ends before the rows that the header promises");
        for (std::size_t i = 0; i < sizeof value; i++)
            byte[is_swapped_ ? sizeof value - 1 - i : i] = static_cast<unsigned char>(rest_[i]);
        std::memcpy(&value, byte, sizeof value);
        rest_.remove_prefix(sizeof value);
        return value;
    }

    std::string path_;
    std::string_view rest_;
    bool is_swapped_;
};

void skip(ply_body &body, const ply_property &property)
{
    for (std::size_t i = property.is_list ? body.next_count(property.count_type) : 1; i > 0; i--)
        body.next(property.type);
}

double read_coordinate(const mesh_soup &soup, ply_body &body, const ply_property &property)
{
    const double coordinate = body.next(property.type);

    if (mesh_soup_is_beyond(coordinate))
        body.fail("vertex " + std::to_string(soup.position.size()) + ": " + property.name + " is " +
                  mesh_text_shown(coordinate) + ", expected " + mesh_soup_expected);
    return coordinate;
}

void read_vertex(mesh_soup &soup, ply_body &body, const ply_element &element)
{
    std::array<double, 3> point{};

    for (const ply_property &property : element.properties) {
        const std::string &name = property.name;
        if (!property.is_list && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z')
            point[static_cast<std::size_t>(name[0] - 'x')] = read_coordinate(soup, body, property);
        else
            skip(body, property);
    }
    soup.position.push_back(point);
}

std::uint32_t vertex_number(const mesh_soup &soup, const ply_body &body, double index,
                            std::size_t vertex_count)
{
    if (!(index >= 0) || index >= static_cast<double>(vertex_count) || index != std::floor(index))
        body.fail("face " + std::to_string(soup.face_count()) + ": vertex " +
                  mesh_text_shown(index) + ", expected one of 0 to " +
                  std::to_string(vertex_count - 1));
    return static_cast<std::uint32_t>(index);
}

void read_corners(mesh_soup &soup, ply_body &body, const ply_property &property,
                  std::size_t vertex_count)
{
    const std::size_t count = body.next_count(property.count_type);

    if (count < 3) body.fail("a face of " + std::to_string(count) + " corners, expected 3 or more");
    for (std::size_t i = 0; i < count; i++) {
        const double index = body.next(property.type);
        soup.corner.push_back(vertex_number(soup, body, index, vertex_count));
    }
    soup.end_face();
}

void read_material(mesh_soup &soup, ply_body &body, const ply_property &property)
{
    const double number = body.next(property.type);

    if (!(std::fabs(number) < 1e9) || number != std::floor(number))
        body.fail("material " + mesh_text_shown(number) + ", expected an integer");
    soup.material.push_back(soup.materials.number_of(std::to_string(static_cast<long>(number))));
}

void read_thickness(mesh_soup &soup, ply_body &body, const ply_property &property)
{
    const double thickness_cm = body.next(property.type);

    if (thickness_cm != 0 && !(thickness_cm >= 1e-4 && thickness_cm <= 1e4))
        body.fail("face " + std::to_string(soup.thickness_cm.size()) + ": thickness " +
                  mesh_text_shown(thickness_cm) + ", expected 0.0001 to 10000 cm or 0: not stated");
    soup.thickness_cm.push_back(static_cast<float>(thickness_cm));
}

bool is_corners(const ply_property &property)
{
    return property.is_list &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_face(mesh_soup &soup, ply_body &body, const ply_element &element,
               std::size_t vertex_count)
{
    for (const ply_property &property : element.properties) {
        if (is_corners(property))
            read_corners(soup, body, property, vertex_count);
        else if (!property.is_list && property.name == "material")
            read_material(soup, body, property);
        else if (!property.is_list && property.name == "thickness")
            read_thickness(soup, body, property);
        else
            skip(body, property);
    }
}

/* How many properties of `element` are called `name`. */
std::size_t count_of(const ply_element &element, const std::string &name)
{
    std::size_t count = 0;

    for (const ply_property &property : element.properties) count += property.name == name;
    return count;
}

const ply_element *find(const ply_header &header, const std::string &name)
{
    for (const ply_element &element : header.elements)
        if (element.name == name) return &element;
    return nullptr;
}

/* What read_vertex and read_face take for granted. */
void check(const ply_header &header, const std::string &path)
{
    const ply_element *vertex = find(header, "vertex"), *face = find(header, "face");

    if (!vertex) throw failure(path + ": no element vertex");
    for (const char *name : {"x", "y", "z"})
        if (count_of(*vertex, name) != 1)
            throw failure(path + ": element vertex, expected one property " + name);
    if (!face) return;
    if (count_of(*face, "vertex_indices") + count_of(*face, "vertex_index") != 1)
        throw failure(path + ": element face, expected one property list vertex_indices");
    for (const char *name : {"material", "thickness"})
        if (count_of(*face, name) > 1)
            throw failure(path + ": element face, property " + name + " twice");
}

/* Triangles of strips, which -1 ends; every second one turns the other way. */
void read_strips(mesh_soup &soup, ply_body &body, const ply_property &property,
                 std::size_t vertex_count)
{
    std::size_t length = 0;
    std::uint32_t last[2] = {};

    for (std::size_t i = body.next_count(property.count_type); i > 0; i--) {
        const double index = body.next(property.type);
        if (index < 0) {
            length = 0;
            continue;
        }
        const std::uint32_t corner = vertex_number(soup, body, index, vertex_count);
        if (length++ >= 2) {
            const bool is_odd = length % 2 == 0;
            soup.corner.insert(soup.corner.end(), {last[is_odd], last[!is_odd], corner});
            soup.end_face();
        }
        last[0] = last[1];
        last[1] = corner;
    }
}

void read_rows(mesh_soup &soup, ply_body &body, const ply_header &header)
{
    const ply_element *vertex = find(header, "vertex"), *face = find(header, "face"),
                      *strips = face && face->count ? nullptr : find(header, "tristrips");

    for (const ply_element &element : header.elements)
        for (std::size_t row = 0; row < element.count; row++) {
            cancel_check();
            if (&element == vertex)
                read_vertex(soup, body, element);
            else if (&element == face)
                read_face(soup, body, element, vertex->count);
            else
                for (const ply_property &property : element.properties)
                    if (&element == strips && is_corners(property))
                        read_strips(soup, body, property, vertex->count);
                    else
                        skip(body, property);
            body.end_row();
        }
}

} // namespace

void mesh_ply_read(mesh_soup &soup, const std::string &path, std::string_view text)
{
    const ply_header header = ply_header_read(path, text);
    std::unique_ptr<ply_body> body;

    check(header, path);
    soup.warn_of(header.unknown_count, "lines of the header are none of PLY, and passed over");
    const ply_element *face = find(header, "face"), *strips = find(header, "tristrips");
    if (!(face && face->count) && !(strips && strips->count)) {
        soup.warn_of(find(header, "vertex")->count, "points: expected faces between them");
        return;
    }
    if (header.format == ply_format::text)
        body = std::make_unique<ply_text>(path, text, header);
    else
        body = std::make_unique<ply_binary>(path, text, header);
    read_rows(soup, *body, header);
    body->end(soup);
}
