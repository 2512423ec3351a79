#include "files/file_name.h"

#include <string.h>
#include <strings.h>

bool file_name_ends(const char *path, const char *ending)
{
    const size_t length = strlen(path), tail = strlen(ending);

    return length > tail && !strcasecmp(path + length - tail, ending);
}
