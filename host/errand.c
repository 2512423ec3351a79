#include "errand.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* More would hold as many files in memory at once. */
enum { THREAD_LIMIT = 8 };

/* How an errand ended; messages and warnings are a thread's own. */
typedef struct ending {
    status rc;
    char *message, *warnings;
} ending;

typedef struct round {
    const errand *list;
    size_t count, next;
    ending *endings; /* shape (count) */
    bool has_failed;
    pthread_mutex_t lock;
} round;

static bool take(round *r, size_t *out)
{
    pthread_mutex_lock(&r->lock);
    const bool is_taken = !r->has_failed && r->next < r->count;
    if (is_taken) *out = r->next++;
    pthread_mutex_unlock(&r->lock);
    return is_taken;
}

static void fail(round *r)
{
    pthread_mutex_lock(&r->lock);
    r->has_failed = true;
    pthread_mutex_unlock(&r->lock);
}

static void *work(void *argument)
{
    round *r = argument;
    size_t at;

    while (take(r, &at)) {
        ending *e = &r->endings[at];
        e->rc = r->list[at].run(r->list[at].self);
        e->warnings = strdup(status_warnings());
        if (e->rc == STATUS_OK) continue;
        e->message = strdup(status_message());
        fail(r);
    }
    return NULL;
}

static status tell(const round *r)
{
    for (size_t i = 0; i < r->count; i++) {
        const ending *e = &r->endings[i];
        if (e->warnings && *e->warnings)
            status_warn("%.*s", (int)strlen(e->warnings) - 1, e->warnings);
        if (e->rc != STATUS_OK)
            return status_set(e->rc, "%s", e->message ? e->message : "no memory");
    }
    return STATUS_OK;
}

status errand_run(const errand *list, size_t count)
{
    status rc = STATUS_OK;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const size_t most = processors < 1              ? 1
                        : processors < THREAD_LIMIT ? (size_t)processors
                                                    : THREAD_LIMIT;
    const size_t wanted = count < most ? count : most;
    round r = {.list = list, .count = count, .lock = PTHREAD_MUTEX_INITIALIZER};
    pthread_t thread[THREAD_LIMIT];
    size_t started = 0;

    if (count == 0) goto out;
    r.endings = calloc(count, sizeof *r.endings);
    NEED(r.endings, STATUS_MEMORY, "no memory for a list of %zu errands", count);
    while (started < wanted && pthread_create(&thread[started], NULL, work, &r) == 0) started++;
    NEED(started > 0, STATUS_MEMORY, "no thread can be started");
    for (size_t i = 0; i < started; i++) pthread_join(thread[i], NULL);
    rc = tell(&r);
out:
    for (size_t i = 0; r.endings && i < count; i++) {
        free(r.endings[i].message);
        free(r.endings[i].warnings);
    }
    free(r.endings);
    pthread_mutex_destroy(&r.lock);
    return rc;
}
