#include "options/standard_output.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t is_pipe_closed;

/* Unlike SIG_IGN, a handler does not pass to the programs that this one starts. */
static void write_fails(int number)
{
    if (number == SIGPIPE) is_pipe_closed = 1;
}

static void make_harmless(int number)
{
    const struct sigaction action = {.sa_handler = write_fails, .sa_flags = SA_RESTART};
    struct sigaction present;

    if (sigaction(number, NULL, &present) == 0 && present.sa_handler == SIG_DFL)
        sigaction(number, &action, NULL);
}

void standard_output_open(void)
{
    make_harmless(SIGPIPE);
    make_harmless(SIGXFSZ);
    for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++)
        if (fcntl(i, F_GETFD) < 0 && open("/dev/null", i == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

status standard_output_close(void)
{
    status rc = STATUS_OK;
    const bool has_failed = ferror(stdout) != 0;

    errno = 0;
    if (fclose(stdout) == 0 && !has_failed) goto out;
    if (is_pipe_closed) {
        signal(SIGPIPE, SIG_DFL);
        raise(SIGPIPE);
    }
    rc = status_set(STATUS_FILE, "stdout: %s", errno ? strerror(errno) : "writing failed");
out:
    return rc;
}
