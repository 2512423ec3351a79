/* What long loops of the readers call. */
#ifndef MESHIO_CANCEL_HPP
#define MESHIO_CANCEL_HPP

/* Throws failure where the caller no longer wants the result (cancel.h). Costs a few instructions. */
void cancel_check();

#endif
