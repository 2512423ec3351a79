/* radsig-atmosphere: makes radiance databases and cloud extinctions with LOWTRAN 7. */
#include "base/interrupt.h"
#include "tool.h"

static const program_command commands[] = {
    {"make", tool_make, "make the radiance database of a scene"},
    {"deck", tool_deck, "run card decks as they stand"},
    {"cloud", tool_cloud, "write the extinction of a cloud"},
    {"import", tool_import, "make a database from MODTRAN's own output"},
    {"show", tool_show, "print what a database holds"},
};

int main(int argc, char **argv)
{
    const program tool = {"radsig-atmosphere", commands, sizeof commands / sizeof *commands};

    interrupt_catch_signals();
    return program_run(&tool, argc, argv);
}
