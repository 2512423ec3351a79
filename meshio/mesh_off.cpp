/* Object File Format, as text: OpenMesh's reader stops at comments and, where the file is
 * truncated, repeats the last face instead of noticing. */
#include "mesh_soup.hpp"
#include "mesh_text.hpp"

namespace
{

/* Steps to the next line that holds more than blanks and a comment. */
bool next_row(mesh_text &lines, std::string_view &row)
{
    while (lines.next(row)) {
        row = row.substr(0, row.find('#'));
        std::string_view rest = row;
        if (!mesh_text_word(rest).empty()) return true;
    }
    return false;
}

std::string_view need_row(mesh_text &lines, const std::string &what)
{
    std::string_view row;

    if (!next_row(lines, row)) lines.fail("the file ends here, expected " + what);
    return row;
}

std::size_t read_count(const mesh_text &lines, std::string_view &row, const std::string &what)
{
    const std::string_view word = mesh_text_word(row);
    const long long count = lines.integer(word);

    if (count < 0 || count > UINT32_MAX) lines.fail(word, "the number of " + what);
    return static_cast<std::size_t>(count);
}

/* The keyword may be missing, or the first count may be glued to it. */
void read_keyword(mesh_soup &soup, const mesh_text &lines, std::string_view &row)
{
    std::string_view rest_of_row = row;
    std::string_view word = mesh_text_word(rest_of_row);
    const std::size_t digits = word.find_first_of("0123456789");

    if (digits == 0 && word.find_first_not_of("0123456789") == word.npos) return;
    if (digits != word.npos && digits >= 3) {
        row.remove_prefix(static_cast<std::size_t>(word.data() - row.data()) + digits);
        word = word.substr(0, digits);
        soup.warnings.push_back("the number of vertices is glued to " + std::string(word));
    } else {
        row = rest_of_row;
    }
    if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF" && word != "STOFF" &&
        word != "STCOFF" && word != "STNOFF" && word != "STCNOFF")
        lines.fail(word, "OFF with three coordinates");
    std::string_view rest = row;
    if (mesh_text_word(rest) == "BINARY") lines.fail("binary OFF, expected text");
}

void read_face(mesh_soup &soup, const mesh_text &lines, std::string_view row)
{
    const std::size_t count = read_count(lines, row, "corners");

    if (count < 3)
        lines.fail("a face of " + std::to_string(count) + " corners, expected 3 or more");
    for (std::size_t i = 0; i < count; i++) {
        const std::string_view word = mesh_text_word(row);
        const long long index = lines.integer(word);
        if (index < 0 || static_cast<std::size_t>(index) >= soup.position.size())
            lines.fail(word, "a vertex from 0 to " + std::to_string(soup.position.size() - 1));
        soup.corner.push_back(static_cast<std::uint32_t>(index));
    }
    soup.end_face();
}

} // namespace

void mesh_off_read(mesh_soup &soup, const std::string &path, std::string_view text)
{
    mesh_text lines(path, text);
    std::string_view row = need_row(lines, "OFF");

    read_keyword(soup, lines, row);
    std::string_view rest = row;
    if (mesh_text_word(rest).empty())
        row = need_row(lines, "the numbers of vertices, faces and edges");
    const std::size_t vertex_count = read_count(lines, row, "vertices");
    const std::size_t face_count = read_count(lines, row, "faces");

    for (std::size_t i = 0; i < vertex_count; i++) {
        std::array<double, 3> point;
        lines.point(need_row(lines, std::to_string(vertex_count) + " vertices"), point.data());
        soup.position.push_back(point);
    }
    for (std::size_t i = 0; i < face_count; i++)
        read_face(soup, lines, need_row(lines, std::to_string(face_count) + " faces"));
    if (next_row(lines, row)) lines.fail(row, "the end of the file");
}
