/* A whole file in memory. */
#ifndef MESHIO_FILE_TEXT_HPP
#define MESHIO_FILE_TEXT_HPP

#include <string>

/* Throws failure `path: ...`: input_file_open fails, or it cannot be read. */
std::string file_text_load(const std::string &path);

#endif
