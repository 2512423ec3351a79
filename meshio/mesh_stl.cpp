/* Stereolithography, binary and text. OpenMesh's reader leaves out degenerate facets, which would
 * shift the numbers of all later ones, and takes a nan vertex for one that is there already. */
#include "cancel.hpp"
#include "failure.hpp"
#include "mesh_soup.hpp"
#include "mesh_text.hpp"

#include <cstring>

namespace
{

const std::size_t header_size = 84, facet_size = 50; /* bytes */

std::uint32_t binary_count(std::string_view text)
{
    std::uint32_t count = 0;

    for (std::size_t i = 0; i < 4; i++)
        count |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[80 + i])) << (8 * i);
    return count;
}

void read_binary(mesh_soup &soup, const std::string &path, std::string_view text,
                 std::uint32_t facet_count)
{
    for (std::uint32_t facet = 0; facet < facet_count; facet++) {
        const char *vertex =
            text.data() + header_size + facet * facet_size + 12; /* behind the normal */
        cancel_check();
        for (int i = 0; i < 3; i++, vertex += 12) {
            float x[3];
            std::memcpy(x, vertex, sizeof x);
            for (const float coordinate : x)
                if (mesh_soup_is_beyond(static_cast<double>(coordinate)))
                    throw failure(path + ": facet " + std::to_string(facet) + ": found " +
                                  mesh_text_shown(static_cast<double>(coordinate)) + ", expected " +
                                  mesh_soup_expected);
            soup.corner.push_back(static_cast<std::uint32_t>(soup.position.size()));
            soup.position.push_back({x[0], x[1], x[2]});
        }
        soup.end_face();
    }
}

/* The first word of the next line that has one; `rest` is what follows it. */
bool next_keyword(mesh_text &lines, std::string_view &keyword, std::string_view &rest)
{
    while (lines.next(rest))
        if (!(keyword = mesh_text_word(rest)).empty()) return true;
    return false;
}

void need(mesh_text &lines, const char *expected)
{
    std::string_view keyword, rest;

    if (!next_keyword(lines, keyword, rest))
        lines.fail(std::string("the file ends here, expected ") + expected);
    if (!mesh_text_is(keyword, expected)) lines.fail(keyword, expected);
}

/* From the line after `facet` to `endfacet`. */
void read_facet(mesh_soup &soup, mesh_text &lines)
{
    const std::size_t begin = soup.corner.size();
    std::string_view keyword, rest;

    need(lines, "outer");
    while (next_keyword(lines, keyword, rest) && mesh_text_is(keyword, "vertex")) {
        std::array<double, 3> point;
        lines.point(rest, point.data());
        soup.corner.push_back(static_cast<std::uint32_t>(soup.position.size()));
        soup.position.push_back(point);
    }
    if (!mesh_text_is(keyword, "endloop")) lines.fail(keyword, "vertex or endloop");
    const std::size_t count = soup.corner.size() - begin;
    if (count < 3)
        lines.fail("a facet of " + std::to_string(count) + " vertices, expected 3 or more");
    need(lines, "endfacet");
    soup.end_face();
}

void read_text(mesh_soup &soup, mesh_text &lines)
{
    std::string_view keyword, rest;
    bool is_inside = false;

    while (next_keyword(lines, keyword, rest)) {
        if (mesh_text_is(keyword, is_inside ? "endsolid" : "solid"))
            is_inside = !is_inside;
        else if (is_inside && mesh_text_is(keyword, "facet"))
            read_facet(soup, lines);
        else
            lines.fail(keyword, is_inside ? "facet or endsolid" : "solid");
    }
    if (is_inside) lines.fail("the file ends here, expected facet or endsolid");
}

} // namespace

void mesh_stl_read(mesh_soup &soup, const std::string &path, std::string_view text)
{
    const bool has_header = text.size() >= header_size;
    const std::uint32_t facet_count = has_header ? binary_count(text) : 0;

    if (has_header && text.size() == header_size + facet_count * facet_size)
        return read_binary(soup, path, text, facet_count);
    if (text.find('\0') != text.npos && has_header)
        throw failure(path + ": " + std::to_string(text.size()) + " bytes, expected " +
                      std::to_string(header_size + facet_count * facet_size) + " for the " +
                      std::to_string(facet_count) + " facets that the header promises");
    mesh_text lines(path, text);
    read_text(soup, lines);
}
