#include "base/interrupt.h"

#include <signal.h>
#include <stddef.h>

static const int caught[] = {SIGINT, SIGTERM, SIGHUP};

enum { CAUGHT_COUNT = sizeof caught / sizeof *caught };

static _Thread_local const atomic_int *obeyed;
static atomic_int signalled;

void interrupt_obey(const atomic_int *token)
{
    obeyed = token;
}

const atomic_int *interrupt_token(void)
{
    return obeyed;
}

bool interrupt_is_set(void)
{
    return obeyed && atomic_load_explicit(obeyed, memory_order_relaxed);
}

status interrupt_check(void)
{
    return interrupt_is_set() ? status_set(STATUS_INTERRUPTED, "interrupted") : STATUS_OK;
}

status interrupt_status(status rc)
{
    return rc == STATUS_OK || !interrupt_is_set() ? rc : interrupt_check();
}

static void on_signal(int number)
{
    (void)number;
    atomic_store(&signalled, 1);
    for (int i = 0; i < CAUGHT_COUNT; i++) signal(caught[i], SIG_DFL);
}

void interrupt_catch_signals(void)
{
    /* Libraries take a call that was broken off for a failure: calls go on. */
    const struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    struct sigaction present;

    interrupt_obey(&signalled);
    for (int i = 0; i < CAUGHT_COUNT; i++)
        if (sigaction(caught[i], NULL, &present) == 0 && present.sa_handler != SIG_IGN)
            sigaction(caught[i], &action, NULL);
}
