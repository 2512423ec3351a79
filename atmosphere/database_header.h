/* Database header: says in the file what a radiance database is and how it was made. */
#ifndef DATABASE_HEADER_H
#define DATABASE_HEADER_H

#include "database_plan.h"
#include "run_list.h"

/* With this the cards of all runs begin, which end the header. */
#define DATABASE_HEADER_CARDS "# Cards of all runs"

/* Lines that start with '#', each with its line end; the caller frees them. */
status database_header(char **out, const database_plan *g, const run_list *r);

#endif
