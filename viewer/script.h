/* Script: what a person would do, as lines of text, for tests, benches and pictures of the manual.
 *   key KEY        a character, or left right up down page-up page-down home enter escape space, with
 *                  shift+ control+ alt+ before it
 *   point C R      moves the pointer to a pixel of the picture
 *   press BUTTON, release BUTTON     left right middle
 *   click C R      picks a pixel
 *   drag BUTTON DX DY                pixels, in ten steps
 *   scroll N       notches
 *   size W H       pixels of the page
 *   wait           until the picture is exact or failed
 *   pause S        seconds
 *   error          writes the error that is shown to the standard output
 *   page FILE.png, image FILE.img    saves
 * Empty lines and those that begin with # are passed over. */
#ifndef SCRIPT_H
#define SCRIPT_H

#include "preview.h"

/* Does what the file says, and draws between the lines. Fails with STATUS_FORMAT and `path:line: ...`
 * at a line that is none of these. path   `-`: the standard input */
status script_run(preview *p, const char *path);

#endif
