/* A whole file in memory. */
#ifndef MESHIO_FILE_TEXT_HPP
#define MESHIO_FILE_TEXT_HPP

#include <string>

/* Throws failure `path: ...`: no such file, a folder, unreadable, 4 GiB or larger. */
std::string file_text_load(const std::string &path);

#endif
