/* Interrupt: a token that, once it is set, ends the work of the threads that obey it within half a second.
 * Whatever takes long asks for it: launches, waits, loops over a mesh, over pixels and over files. */
#ifndef INTERRUPT_H
#define INTERRUPT_H

#include "base/status.h"

#include <stdatomic.h>
#include <stdbool.h>

/* Makes this thread obey a token, which must outlive its work; NULL, as at first: none. */
void interrupt_obey(const atomic_int *token);

/* The token that this thread obeys, for the threads that it starts. */
const atomic_int *interrupt_token(void);

/* True once the token is set. Costs a few instructions. */
bool interrupt_is_set(void);

/* Fails with STATUS_INTERRUPTED once the token is set. */
status interrupt_check(void);

/* How work ended: whatever failed after the token was set was interrupted. */
status interrupt_status(status rc);

/* Makes this thread obey a token that the signals SIGINT, SIGTERM and SIGHUP set, but for
 * those that the process was started to ignore (nohup). The next of them ends the process at once, as if
 * none were caught. */
void interrupt_catch_signals(void);

#endif
