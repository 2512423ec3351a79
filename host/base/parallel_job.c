#include "base/parallel_job.h"

#include "base/interrupt.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <unistd.h>

/* More would hold as many files in memory at once. */
enum { THREAD_LIMIT = 8 };

typedef struct round {
    const parallel_job *list;
    size_t count, next;
    status_record *endings; /* shape (count) */
    bool has_failed;
    const atomic_int *token;
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

    interrupt_obey(r->token);
    while (take(r, &at)) {
        status rc = interrupt_check();
        if (rc == STATUS_OK) rc = r->list[at].run(r->list[at].self);
        r->endings[at] = status_record_take(rc);
        if (rc != STATUS_OK) fail(r);
    }
    return NULL;
}

static status tell(const round *r)
{
    status rc = STATUS_OK;

    for (size_t i = 0; i < r->count; i++) TRY(status_record_tell(&r->endings[i]));
out:
    return rc;
}

status parallel_run(const parallel_job *list, size_t count)
{
    status rc = STATUS_OK;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const size_t most = processors < 1              ? 1
                        : processors < THREAD_LIMIT ? (size_t)processors
                                                    : THREAD_LIMIT;
    const size_t wanted = count < most ? count : most;
    round r = {.list = list,
               .count = count,
               .token = interrupt_token(),
               .lock = PTHREAD_MUTEX_INITIALIZER};
    pthread_t thread[THREAD_LIMIT];
    size_t started = 0;

    if (count == 0) goto out;
    r.endings = calloc(count, sizeof *r.endings);
    NEED(r.endings, STATUS_MEMORY, "no memory for a list of %zu jobs", count);
    while (started < wanted && pthread_create(&thread[started], NULL, work, &r) == 0) started++;
    NEED(started > 0, STATUS_MEMORY, "no thread can be started");
    for (size_t i = 0; i < started; i++) pthread_join(thread[i], NULL);
    rc = tell(&r);
out:
    for (size_t i = 0; r.endings && i < count; i++) status_record_free(&r.endings[i]);
    free(r.endings);
    pthread_mutex_destroy(&r.lock);
    return rc;
}
