/* Cancel: how the caller ends what takes long in this folder. */
#ifndef MESHIO_CANCEL_H
#define MESHIO_CANCEL_H

#include <stdbool.h>

/* Sets what readers ask now and then, in the thread that reads: true ends them with the message
 * "interrupted". NULL, as at first: they ask nobody. */
void cancel_ask(bool (*is_wanted)(void));

#endif
