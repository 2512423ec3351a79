/* radsig-atmosphere: makes radiance databases and cloud extinctions with LOWTRAN 7. */
#include "lowtran.h"
#include "tool.h"

#include <signal.h>

static const program_command commands[] = {
    {"make", tool_make, "make the radiance database of a scene"},
    {"deck", tool_deck, "run card decks as they stand"},
    {"cloud", tool_cloud, "write the extinction of a cloud"},
    {"import", tool_import, "make a database from MODTRAN's own output"},
    {"show", tool_show, "print what a database holds"},
};

int main(int argc, char **argv)
{
    const struct sigaction interrupt = {.sa_handler = lowtran_interrupt};
    const program tool = {"radsig-atmosphere", commands, sizeof commands / sizeof *commands};

    sigaction(SIGINT, &interrupt, NULL);
    sigaction(SIGTERM, &interrupt, NULL);
    if (signal(SIGHUP, SIG_IGN) != SIG_IGN) sigaction(SIGHUP, &interrupt, NULL); /* but for nohup */
    return program_run(&tool, argc, argv);
}
