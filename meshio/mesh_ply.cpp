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

    /* Fails unless everything has been read. */
    virtual void end() = 0;

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
        : lines_(path, text, header.end, header.line_count)
    {
    }

    double next(ply_type) override
    {
        const std::string_view word = next_word();

        if (word.empty()) fail("the file ends here, expected the rows that the header promises");
        return lines_.number(word);
    }

    void fail(const std::string &what) const override
    {
        lines_.fail(what);
    }

    void end() override
    {
        const std::string_view word = next_word();

        if (!word.empty())
            lines_.fail(word, "the end of the file after the rows that the header promises");
    }

  private:
    std::string_view next_word()
    {
        std::string_view word;

        while ((word = mesh_text_word(rest_)).empty() && lines_.next(rest_)) continue;
        return word;
    }

    mesh_text lines_;
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

    void end() override
    {
        if (rest_.find_first_not_of(" \r\n") != rest_.npos)
            fail(std::to_string(rest_.size()) + " bytes after the rows that the header promises");
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

void read_corners(mesh_soup &soup, ply_body &body, const ply_property &property,
                  std::size_t vertex_count)
{
    const std::size_t count = body.next_count(property.count_type);

    if (count < 3) body.fail("a face of " + std::to_string(count) + " corners, expected 3 or more");
    for (std::size_t i = 0; i < count; i++) {
        const double index = body.next(property.type);
        if (!(index >= 0) || index >= static_cast<double>(vertex_count) ||
            index != std::floor(index))
            body.fail("face " + std::to_string(soup.face_count()) + ": vertex " +
                      mesh_text_shown(index) + ", expected one of 0 to " +
                      std::to_string(vertex_count - 1));
        soup.corner.push_back(static_cast<std::uint32_t>(index));
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
    if (!face) throw failure(path + ": no faces");
    if (count_of(*face, "vertex_indices") + count_of(*face, "vertex_index") != 1)
        throw failure(path + ": element face, expected one property list vertex_indices");
    for (const char *name : {"material", "thickness"})
        if (count_of(*face, name) > 1)
            throw failure(path + ": element face, property " + name + " twice");
}

} // namespace

void mesh_ply_read(mesh_soup &soup, const std::string &path, std::string_view text)
{
    const ply_header header = ply_header_read(path, text);
    std::unique_ptr<ply_body> body;

    check(header, path);
    if (header.format == ply_format::text)
        body = std::make_unique<ply_text>(path, text, header);
    else
        body = std::make_unique<ply_binary>(path, text, header);

    const ply_element *vertex = find(header, "vertex"), *face = find(header, "face");
    for (const ply_element &element : header.elements)
        for (std::size_t row = 0; row < element.count; row++) {
            cancel_check();
            if (&element == vertex)
                read_vertex(soup, *body, element);
            else if (&element == face)
                read_face(soup, *body, element, vertex->count);
            else
                for (const ply_property &property : element.properties) skip(*body, property);
        }
    body->end();
}
