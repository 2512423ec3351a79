/* File name: what the end of a name tells. */
#ifndef FILE_NAME_H
#define FILE_NAME_H

#include <stdbool.h>

/* True if the path ends with it, in small letters or capitals, behind at least one more character.
 *   ending   such as `.epw` */
bool file_name_ends(const char *path, const char *ending);

#endif
