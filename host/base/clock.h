/* Clock: how long something takes. */
#ifndef CLOCK_H
#define CLOCK_H

/* Seconds since some fixed moment, by a clock that nobody sets. */
double clock_now_s(void);

#endif
