/* A whole file in memory. */
#ifndef MESHIO_FILE_TEXT_HPP
#define MESHIO_FILE_TEXT_HPP

#include <cstdio>
#include <string>

/* Throws failure `path: ...`, as input_file_open says; larger than INPUT_FILE_TEXT_LIMIT. */
std::string file_text_load(const std::string &path);

/* Reads `size` bytes, a portion at a time, and tells who observes (input_file.h). Throws failure. */
void file_text_fill(char *out, std::size_t size, FILE *file, const std::string &path);

#endif
