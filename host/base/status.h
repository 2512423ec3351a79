/* Status: how a function of the host tells that it failed, and why. */
#ifndef STATUS_H
#define STATUS_H

typedef enum status {
    STATUS_OK,
    STATUS_MEMORY,
    STATUS_FILE,     /* a file cannot be opened, read or written */
    STATUS_FORMAT,   /* a file holds what it must not hold */
    STATUS_ARGUMENT, /* a value is out of its range */
    STATUS_DEVICE,   /* OpenCL failed */
    STATUS_INTERRUPTED
} status;

/* Stores the message of this thread and returns the code. What a terminal would act on is replaced, in
 * messages and warnings: they repeat texts of files (terminal_text.h). */
__attribute__((format(printf, 2, 3))) status status_set(status code, const char *format, ...);

/* Text of the last failure of this thread; several failures stand on lines of their own. */
const char *status_message(void);

/* The last of them alone; "" where none came since one was kept. */
const char *status_last(void);

/* Keeps the present message: the next failure of this thread is added below it. Returns code.
 * For readers that go on after an error to find the next one. */
status status_keep(status code);

/* Ends the keeping: what was kept is one message, which the next failure replaces. Returns code. */
status status_finish(status code);

/* Forgets the message and what was kept. */
void status_clear(void);

/* Adds a line to the warnings of this thread; for input that is odd but usable. What no longer fits
 * into 64 KiB is dropped. */
__attribute__((format(printf, 1, 2))) void status_warn(const char *format, ...);

/* The warnings since the last call, a line each, and forgets them; valid until the next call. */
const char *status_warnings(void);

/* The same without forgetting them. */
const char *status_warnings_so_far(void);

/* How work ended in one thread, with its message and warnings, for another thread to tell. */
typedef struct status_record {
    status rc;
    char *message, *warnings; /* NULL: none, or no memory for it */
} status_record;

/* Takes the message of a failure and the warnings of this thread, which forgets those. The caller
 * releases it with status_record_free. */
status_record status_record_take(status rc);

/* Makes what was taken in another thread this thread's own: the warnings line by line, but for those
 * that it has already, and the message. Returns the code. */
status status_record_tell(const status_record *record);

void status_record_free(status_record *record);

/* Both need a local `status rc` and a label `out`. */
#define NEED(condition, code, ...)                                                                 \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            rc = status_set(code, __VA_ARGS__);                                                    \
            goto out;                                                                              \
        }                                                                                          \
    } while (0)

#define TRY(call)                                                                                  \
    do {                                                                                           \
        rc = (call);                                                                               \
        if (rc != STATUS_OK) goto out;                                                             \
    } while (0)

#endif
