#include "database_output.h"

#include "files/file_name.h"
#include "files/output_file.h"
#include "sky/atmosphere_container.h"

option database_output_option(const char **path, const char *value)
{
    return (option){"output", 'o', value, "the file to write", .text = path, .is_required = true};
}

status database_output_check(const char *path)
{
    output_file *file = NULL;
    const status rc = output_file_open(&file, path);

    output_file_free(file);
    return rc;
}

bool database_output_is_container(const char *path)
{
    return file_name_ends(path, ".radc");
}

status database_output_write(const atmosphere *air, const char *path)
{
    return database_output_is_container(path) ? atmosphere_container_write(air, path)
                                              : atmosphere_write(air, path);
}
