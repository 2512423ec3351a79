#include "command/command.h"
#include "device/device.h"

#include <stdio.h>
#include <stdlib.h>

static const char command[] = "radsig devices";

static const char purpose[] =
    "Lists the OpenCL devices of all platforms; * marks the default. The number in the first\n"
    "column is what --device takes.\n";

static void print_devices(const device_info *info, size_t count)
{
    printf("  %-6s %-11s %5s %10s  %-36s %s\n", "device", "type", "units", "memory GiB", "name",
           "platform, version");
    for (size_t i = 0; i < count; i++)
        printf("%c %-6zu %-11s %5u %10.1f  %-36s %s, %s\n", info[i].is_default ? '*' : ' ', i,
               info[i].type, info[i].compute_units, (double)info[i].memory_bytes / 1073741824.0,
               info[i].name, info[i].platform, info[i].version);
}

int command_devices(int argc, char **argv)
{
    const option_table table = {.command = command, .purpose = purpose};
    const int code = option_table_read(&table, argc, argv, NULL);
    device_info *info = NULL;
    size_t count = 0;
    status rc;

    if (code != OPTION_TABLE_DONE) return code;
    rc = device_list(&info, &count);
    if (rc == STATUS_OK) print_devices(info, count);
    free(info);
    return program_end(command, rc);
}
