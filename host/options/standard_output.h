/* Standard output: what a command prints there, and whether it arrived. */
#ifndef STANDARD_OUTPUT_H
#define STANDARD_OUTPUT_H

#include "base/status.h"

/* Comes first in a program. A closed pipe and a limit on the size of files become errors of writing; a
 * standard stream that is closed stays unusable: no file that is opened later gets its number. */
void standard_output_open(void);

/* Comes last: writes what is left. Fails with STATUS_FILE, `stdout: No space left on device`, if
 * anything that was printed is lost. Where a reader closed its pipe the process ends here, quietly, by
 * SIGPIPE. */
status standard_output_close(void);

#endif
