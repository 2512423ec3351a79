/* radsig-atmosphere: makes radiance databases and cloud extinctions with LOWTRAN 7. */
#include "base/interrupt.h"
#include "command.h"

static const program_command commands[] = {
    {"make", command_make, "make the radiance database of a scene"},
    {"deck", command_deck, "run card decks as they stand"},
    {"cloud", command_cloud, "write the extinction of a cloud"},
    {"import", command_import, "make a database from MODTRAN's own output"},
    {"show", command_show, "print what a database holds"},
};

int main(int argc, char **argv)
{
    const program all = {"radsig-atmosphere", commands, sizeof commands / sizeof *commands};

    interrupt_catch_signals();
    return program_run(&all, argc, argv);
}
