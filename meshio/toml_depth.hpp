/* How deep the tables of a TOML document may lie in each other. toml++ bounds arrays and inline
 * tables, but makes a table for each part of a dotted key, and its parser and destructors take them
 * all from the stack. */
#ifndef MESHIO_TOML_DEPTH_HPP
#define MESHIO_TOML_DEPTH_HPP

#include <string>
#include <string_view>

constexpr int toml_depth_keys = 16;  /* parts of one dotted key or header */
constexpr int toml_depth_nodes = 64; /* tables and arrays around a value */

/* Throws failure `path:line: ...` for a key of more parts, before the text is parsed; what is no
 * TOML in other ways is left to toml++. */
void toml_depth_check(std::string_view text, const std::string &path);

#endif
