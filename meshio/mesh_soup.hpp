/* A polygon soup under construction: what the readers of the formats fill, and what becomes a
 * mesh_file. */
#ifndef MESHIO_MESH_SOUP_HPP
#define MESHIO_MESH_SOUP_HPP

extern "C" {
#include "mesh_file.h"
}

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

/* Names and their numbers, in the order in which they were first asked for. */
class mesh_names
{
  public:
    std::uint32_t number_of(const std::string &name);
    std::vector<std::string> names;

  private:
    std::unordered_map<std::string, std::uint32_t> number_;
};

struct mesh_soup {
    std::vector<std::array<double, 3>> position;
    std::vector<std::uint32_t> first{0}, corner;
    std::vector<std::uint32_t> object, part,
        material;                    /* a reader without a kind of name leaves that list empty */
    std::vector<float> thickness_cm; /* empty without it */
    mesh_names objects, parts, materials;
    std::vector<std::string> warnings; /* of what was odd, and of what was left out */

    /* Warns of `count` things, unless there are none. */
    void warn_of(std::size_t count, const std::string &what)
    {
        if (count) warnings.push_back(std::to_string(count) + " " + what);
    }

    /* Closes the face made of the corners that were appended since the last one. */
    void end_face()
    {
        first.push_back(static_cast<std::uint32_t>(corner.size()));
    }
    std::size_t face_count() const
    {
        return first.size() - 1;
    }
};

/* Whether a coordinate is to be refused, and what to expect instead. */
inline bool mesh_soup_is_beyond(double coordinate)
{
    return std::isfinite(coordinate) && std::fabs(coordinate) > MESH_FILE_LIMIT_M;
}
constexpr char mesh_soup_expected[] = "a coordinate from -1e9 to 1e9 m";

/* The names of what a file does not name. */
constexpr char mesh_soup_part[] = "part", mesh_soup_material[] = "";
std::string mesh_soup_stem(const std::string &path);

/* One reader per format. Each appends to `soup` and throws failure with `path:line:` or `path:`;
 * `text` is the whole file, whose line ends the OBJ reader overwrites. */
void mesh_obj_read(mesh_soup &soup, const std::string &path, std::string &text);
void mesh_ply_read(mesh_soup &soup, const std::string &path, std::string_view text);
void mesh_stl_read(mesh_soup &soup, const std::string &path, std::string_view text);
void mesh_off_read(mesh_soup &soup, const std::string &path, std::string_view text);

#endif
