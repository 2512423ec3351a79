#include "command/command.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Writes the path of radsig-view, beside this program. */
static status viewer_path(char *out, size_t size)
{
    status rc = STATUS_OK;
    const ssize_t length = readlink("/proc/self/exe", out, size - 16);

    NEED(length > 0, STATUS_FILE, "/proc/self/exe: %s", strerror(errno));
    out[length] = '\0';
    strcpy(strrchr(out, '/') + 1, "radsig-view");
out:
    return rc;
}

int command_view(int argc, char **argv)
{
    char path[4096];
    status rc;

    (void)argc;
    rc = viewer_path(path, sizeof path);
    if (rc == STATUS_OK) {
        execv(path, argv);
        rc = status_set(STATUS_FILE, "%s: %s: make all builds it", path, strerror(errno));
    }
    return program_end("radsig view", rc);
}
