/* Skips a test of cmocka and says why: `make test` lists such lines at its end. */
#ifndef SKIP_H
#define SKIP_H

#define SKIP_IF(condition, why)                                                                    \
    do {                                                                                           \
        if (!(condition)) break;                                                                   \
        print_message("skipped: %s: %s\n", __func__, why);                                         \
        skip();                                                                                    \
    } while (0)

#endif
