/* One --set of the command line, applied to a TOML document. */
#ifndef MESHIO_TOML_SETTING_HPP
#define MESHIO_TOML_SETTING_HPP

#include <string>
#include <toml++/toml.h>

/* Puts the value of `table.key=value` into the document. Nodes made here have no source path.
 * Throws failure `--set table.key=value: ...`. */
void toml_setting_apply(toml::table &root, const std::string &setting);

#endif
