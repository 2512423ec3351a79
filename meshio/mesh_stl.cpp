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
                 std::size_t facet_count)
{
    for (std::size_t facet = 0; facet < facet_count; facet++) {
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
        if (!(keyword = mesh_text_word(rest)).empty() && keyword[0] != '#') return true;
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

/* How many facets a binary file holds. Writers that stream leave the count 0 or at its largest, others fill
 * the file up. */
std::size_t facets_there(mesh_soup &soup, const std::string &path, std::string_view text)
{
    const std::size_t promised = binary_count(text), size = text.size() - header_size;
    const std::size_t held = size / facet_size, wanted = promised * facet_size;

    if (size == wanted) return promised;
    if (size > wanted && promised > 0 &&
        (size - wanted < facet_size ||
         text.find_first_not_of('\0', header_size + wanted) == text.npos)) {
        soup.warn_of(size - wanted, "bytes follow the " + std::to_string(promised) +
                                        " facets that the header promises");
        return promised;
    }
    if (size % facet_size == 0 && held > 0 && (promised < held || promised == UINT32_MAX)) {
        soup.warn_of(held, "facets are there, the header promises " + std::to_string(promised));
        return held;
    }
    throw failure(path + ": " + std::to_string(text.size()) + " bytes, expected " +
                  std::to_string(header_size + wanted) + " for the " + std::to_string(promised) +
                  " facets that the header promises");
}

bool is_text(std::string_view text)
{
    const std::size_t end = text.find_last_not_of(mesh_text_padding) + 1;

    return text.substr(0, end).find('\0') == text.npos;
}

} // namespace

void mesh_stl_read(mesh_soup &soup, const std::string &path, std::string_view text)
{
    const bool has_header = text.size() >= header_size;

    if (has_header &&
        (!is_text(text) || text.size() == header_size + binary_count(text) * facet_size))
        return read_binary(soup, path, text, facets_there(soup, path, text));
    mesh_text lines(path, text);
    read_text(soup, lines);
}
