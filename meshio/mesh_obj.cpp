/* Wavefront OBJ through tinyobjloader's callbacks. tinyobjloader neither tells its callbacks the
 * line nor notices malformed numbers, and makes nan and inf zero: so a stream buffer hands it one
 * line at a time and checks that line first. */
#include "failure.hpp"
#include "mesh_soup.hpp"
#include "mesh_text.hpp"

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <istream>
#include <streambuf>
#include <unordered_map>

namespace
{

/* What stands in a line that holds neither a vertex nor a face. */
enum class obj_kind { other, surface, curve, line, point, call, unknown };

obj_kind kind_of(std::string_view keyword)
{
    static const std::unordered_map<std::string_view, obj_kind> known = {
        {"surf", obj_kind::surface}, {"bsp", obj_kind::surface},      {"bzp", obj_kind::surface},
        {"cdp", obj_kind::surface},  {"curv", obj_kind::curve},       {"curv2", obj_kind::curve},
        {"cdc", obj_kind::curve},    {"l", obj_kind::line},           {"p", obj_kind::point},
        {"call", obj_kind::call},    {"csh", obj_kind::call},         {"vt", obj_kind::other},
        {"vn", obj_kind::other},     {"vp", obj_kind::other},         {"o", obj_kind::other},
        {"g", obj_kind::other},      {"s", obj_kind::other},          {"mg", obj_kind::other},
        {"deg", obj_kind::other},    {"bmat", obj_kind::other},       {"step", obj_kind::other},
        {"parm", obj_kind::other},   {"trim", obj_kind::other},       {"hole", obj_kind::other},
        {"scrv", obj_kind::other},   {"sp", obj_kind::other},         {"end", obj_kind::other},
        {"con", obj_kind::other},    {"bevel", obj_kind::other},      {"lod", obj_kind::other},
        {"cstype", obj_kind::other}, {"usemtl", obj_kind::other},     {"mtllib", obj_kind::other},
        {"maplib", obj_kind::other}, {"usemap", obj_kind::other},     {"c_interp", obj_kind::other},
        {"ctech", obj_kind::other},  {"shadow_obj", obj_kind::other}, {"d_interp", obj_kind::other},
        {"stech", obj_kind::other},  {"trace_obj", obj_kind::other},  {"res", obj_kind::other}};
    const auto found = known.find(keyword);

    if (keyword.empty() || keyword[0] == '#') return obj_kind::other;
    return found == known.end() ? obj_kind::unknown : found->second;
}

/* How many lines of each kind there are. */
struct kind_counts {
    std::size_t count[static_cast<std::size_t>(obj_kind::unknown) + 1] = {};

    std::size_t &operator[](obj_kind kind)
    {
        return count[static_cast<std::size_t>(kind)];
    }
    std::size_t operator[](obj_kind kind) const
    {
        return count[static_cast<std::size_t>(kind)];
    }
};

class obj_lines : public std::streambuf
{
  public:
    obj_lines(const std::string &path, std::string &text) : text_(text), lines_(path, text)
    {
    }

    const mesh_text &where() const
    {
        return lines_;
    }

    /* Tells what was passed over. */
    void warn(mesh_soup &soup) const
    {
        soup.warn_of(count_[obj_kind::surface], "free-form surfaces are left out");
        soup.warn_of(count_[obj_kind::curve] + count_[obj_kind::line] + count_[obj_kind::point],
                     "lines, curves and points have no area and are left out");
        soup.warn_of(count_[obj_kind::call], "files that it calls are left out");
        soup.warn_of(count_[obj_kind::unknown],
                     "lines that are none of OBJ are passed over, the first is line " +
                         std::to_string(unknown_line_));
    }

    /* The vertex of the `v` line handed out last. */
    const std::array<double, 3> &position() const
    {
        return position_;
    }

  protected:
    int_type underflow() override
    {
        std::string_view line;

        if (!lines_.next(line)) return traits_type::eof();
        if (line.find('\0') != line.npos) lines_.fail("a zero byte, expected text");
        const std::string_view keyword = keyword_of(line);
        char *begin = text_.data() + (line.data() - text_.data());

        if (keyword != "v" && keyword != "f") {
            take_note(keyword, line);
            return hand_out(begin, line.size());
        }
        goes_on_ = false;
        if (line.back() == '\\') {
            joined_ = joined(line);
            line = joined_;
            begin = joined_.data();
        }
        line = line.substr(0, line.find('#'));
        check(keyword, line);
        return hand_out(begin, line.size());
    }

  private:
    static std::string_view keyword_of(std::string_view line)
    {
        return mesh_text_word(line);
    }

    void take_note(std::string_view keyword, std::string_view line)
    {
        if (!goes_on_) {
            const obj_kind kind = kind_of(keyword);
            if (!count_[kind]++ && kind == obj_kind::unknown) unknown_line_ = lines_.line();
        }
        goes_on_ = !line.empty() && line.back() == '\\';
    }

    /* The byte after the line is its end, the begin of a comment, or the one that joined() put there. */
    int_type hand_out(char *begin, std::size_t size)
    {
        begin[size] = '\n';
        setg(begin, begin, begin + size + 1);
        return traits_type::to_int_type(*begin);
    }

    /* A line that ends in a backslash, and those that go on with it. */
    std::string joined(std::string_view line)
    {
        std::string all;
        bool goes_on;

        do {
            goes_on = !line.empty() && line.back() == '\\';
            all.append(line.substr(0, line.size() - goes_on)).append(1, ' ');
        } while (goes_on && lines_.next(line));
        return all;
    }

    void check(std::string_view keyword, std::string_view line)
    {
        mesh_text_word(line);
        if (keyword == "v")
            lines_.point(line, position_.data());
        else
            check_corners(line);
    }

    void check_corners(std::string_view rest) const
    {
        std::size_t count = 0;

        for (std::string_view word; !(word = mesh_text_word(rest)).empty(); count++) {
            if (std::count(word.begin(), word.end(), '/') > 2)
                lines_.fail(word, "at most three indices");
            const long long index = lines_.integer(word.substr(0, word.find('/')));
            if (!index || index > INT32_MAX || index < -INT32_MAX)
                lines_.fail(word, "a vertex index, which counts from 1 or, backwards, from -1");
        }
        if (count < 3)
            lines_.fail("a face of " + std::to_string(count) + " corners, expected 3 or more");
    }

    std::string &text_;
    std::string joined_;
    mesh_text lines_;
    std::array<double, 3> position_{};
    bool goes_on_ = false; /* the line before ends in a backslash */
    unsigned long unknown_line_ = 0;
    kind_counts count_;
};

/* What the callbacks fill. */
struct obj_reader {
    mesh_soup &soup;
    const obj_lines &lines;
    std::string stem, object, part, material;
    std::uint32_t object_number, part_number, material_number;
    bool is_renamed; /* since the last face */
    struct reference {
        long long index;
        unsigned long line;
    };
    std::vector<reference> ahead; /* to vertices that had not been met yet */
};

/* tinyobjloader hands over the rest of the line, blanks and all. */
std::string trimmed(const std::string &name, const std::string &otherwise)
{
    const std::size_t begin = name.find_first_not_of(" \t"), end = name.find_last_not_of(" \t");

    return begin == name.npos ? otherwise : name.substr(begin, end - begin + 1);
}

std::uint32_t vertex_of(obj_reader &reader, int index)
{
    const long long count = static_cast<long long>(reader.soup.position.size());
    const mesh_text &where = reader.lines.where();

    if (index < -count)
        where.fail("vertex " + std::to_string(index) + ", expected one of the " +
                   std::to_string(count) + " before");
    if (index > count) reader.ahead.push_back({index, where.line()});
    return static_cast<std::uint32_t>(index < 0 ? count + index : index - 1);
}

void on_vertex(void *user, double, double, double, double)
{
    obj_reader &reader = *static_cast<obj_reader *>(user);

    reader.soup.position.push_back(reader.lines.position());
}

void on_face(void *user, tinyobj::index_t *corner, int count)
{
    obj_reader &reader = *static_cast<obj_reader *>(user);
    mesh_soup &soup = reader.soup;

    if (reader.is_renamed) {
        reader.object_number = soup.objects.number_of(reader.object);
        reader.part_number = soup.parts.number_of(reader.part);
        reader.material_number = soup.materials.number_of(reader.material);
        reader.is_renamed = false;
    }
    for (int i = 0; i < count; i++)
        soup.corner.push_back(vertex_of(reader, corner[i].vertex_index));
    soup.end_face();
    soup.object.push_back(reader.object_number);
    soup.part.push_back(reader.part_number);
    soup.material.push_back(reader.material_number);
}

void on_object(void *user, const char *name)
{
    obj_reader &reader = *static_cast<obj_reader *>(user);

    reader.object = trimmed(name, reader.stem);
    reader.is_renamed = true;
}

/* A face in several groups belongs to the part of all their names. */
void on_group(void *user, const char **name, int count)
{
    obj_reader &reader = *static_cast<obj_reader *>(user);
    std::string part;

    for (int i = 0; i < count; i++) part.append(i ? " " : "").append(name[i]);
    reader.part = trimmed(part, mesh_soup_part);
    reader.is_renamed = true;
}

void on_material(void *user, const char *name, int)
{
    obj_reader &reader = *static_cast<obj_reader *>(user);

    reader.material = trimmed(name, mesh_soup_material);
    reader.is_renamed = true;
}

tinyobj::callback_t callbacks()
{
    tinyobj::callback_t callback;

    callback.vertex_cb = on_vertex;
    callback.index_cb = on_face;
    callback.object_cb = on_object;
    callback.group_cb = on_group;
    callback.usemtl_cb = on_material;
    return callback;
}

} // namespace

void mesh_obj_read(mesh_soup &soup, const std::string &path, std::string &text)
{
    const tinyobj::callback_t callback = callbacks();
    text.resize(text.find_last_not_of(mesh_text_padding) + 1);
    text += '\n';
    obj_lines lines(path, text);
    std::istream stream(&lines);
    obj_reader reader{soup,
                      lines,
                      mesh_soup_stem(path),
                      mesh_soup_stem(path),
                      mesh_soup_part,
                      mesh_soup_material,
                      0,
                      0,
                      0,
                      true,
                      {}};

    stream.exceptions(std::ios::badbit);
    tinyobj::LoadObjWithCallback(stream, callback, &reader);
    lines.warn(soup);
    for (const obj_reader::reference &one : reader.ahead)
        if (one.index > static_cast<long long>(soup.position.size()))
            throw failure(path + ":" + std::to_string(one.line) + ": vertex " +
                          std::to_string(one.index) + ", expected one of " +
                          std::to_string(soup.position.size()));
}
