#include "tile_queue.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* Tiles that a worker can have given back at once: one for every time that it halved them. */
enum { GIVEN_BACK = 33 };

typedef struct span {
    uint32_t first, count;
} span;

typedef struct queue {
    const tile_queue_job *job;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    uint32_t next, done; /* pixels */
    span *given_back;    /* shape (given_back_count) */
    size_t given_back_count;
    size_t busy;   /* tiles that are being computed */
    size_t failed; /* workers */
} queue;

/* A worker at work, and how it ended; messages and warnings are a thread's own. */
typedef struct turn {
    queue *q;
    const tile_worker *worker;
    pthread_t thread;
    uint32_t most;
    status rc;
    size_t failed_as; /* 1: the first that failed */
    char *message, *warnings;
} turn;

/* Takes the next tile; with none left it waits for those of others, which may come back. */
static bool take(turn *t, span *out)
{
    queue *q = t->q;
    bool is_taken = false;

    pthread_mutex_lock(&q->lock);
    while (!*q->job->stop && !is_taken) {
        const uint32_t left = q->job->pixel_count - q->next;
        is_taken = true;
        if (q->given_back_count > 0) {
            span *back = &q->given_back[q->given_back_count - 1];
            *out = (span){back->first, back->count < t->most ? back->count : t->most};
            back->first += out->count;
            back->count -= out->count;
            if (back->count == 0) q->given_back_count--;
        } else if (left > 0) {
            *out = (span){q->next, left < t->most ? left : t->most};
            q->next += out->count;
        } else {
            is_taken = false;
            if (q->busy == 0) break;
            pthread_cond_wait(&q->changed, &q->lock);
        }
    }
    q->busy += is_taken;
    pthread_mutex_unlock(&q->lock);
    return is_taken;
}

static void finish(queue *q, const span *tile, bool is_done)
{
    pthread_mutex_lock(&q->lock);
    q->busy--;
    if (is_done) {
        q->done += tile->count;
        if (q->job->on_progress) q->job->on_progress(q->job->listener, q->done);
    } else {
        q->given_back[q->given_back_count++] = *tile;
    }
    pthread_cond_broadcast(&q->changed);
    pthread_mutex_unlock(&q->lock);
}

static status compute_all(turn *t)
{
    status rc = STATUS_OK;
    span tile;

    TRY(t->worker->open(t->worker->self, &t->most));
    while (take(t, &tile)) {
        rc = t->worker->compute(t->worker->self, tile.first, tile.count);
        finish(t->q, &tile, rc == STATUS_OK);
        if (rc == STATUS_MEMORY && t->most > 1)
            t->most /= 2;
        else
            TRY(rc);
    }
    rc = STATUS_OK;
out:
    return rc;
}

static void *work(void *argument)
{
    turn *t = argument;

    t->rc = compute_all(t);
    t->warnings = strdup(status_warnings());
    if (t->rc == STATUS_OK) return NULL;
    t->message = strdup(status_message());
    pthread_mutex_lock(&t->q->lock);
    t->failed_as = ++t->q->failed;
    pthread_mutex_unlock(&t->q->lock);
    return NULL;
}

/* Tells of the workers in the thread that asked: what several say alike, once. */
static status tell(const queue *q, const turn *turns, bool *out_failed)
{
    status rc = STATUS_OK;
    const size_t count = q->job->worker_count;

    for (size_t i = 0; i < count; i++) {
        const turn *t = &turns[i];
        const char *said = t->warnings ? t->warnings : "";
        out_failed[i] = t->rc != STATUS_OK;
        if (*said && !strstr(status_warnings_so_far(), said))
            status_warn("%.*s", (int)strlen(said) - 1, said);
        if (t->failed_as == count)
            rc = status_set(t->rc, "%s", t->message ? t->message : t->worker->name);
        else if (t->failed_as > 0)
            status_warn("%s failed, its tiles went to the others: %s", t->worker->name,
                        t->message ? t->message : "no memory");
    }
    return rc;
}

static status run_threads(queue *q, bool *out_failed)
{
    status rc = STATUS_OK;
    const size_t count = q->job->worker_count;
    turn *turns = calloc(count, sizeof *turns);
    size_t started = 0;

    NEED(turns, STATUS_MEMORY, "no memory for %zu threads", count);
    for (; started < count; started++) {
        turns[started] = (turn){.q = q, .worker = &q->job->worker[started]};
        if (pthread_create(&turns[started].thread, NULL, work, &turns[started]) != 0) break;
    }
    for (size_t i = 0; i < started; i++) pthread_join(turns[i].thread, NULL);
    NEED(started == count, STATUS_MEMORY, "%zu threads cannot be started", count);
    rc = tell(q, turns, out_failed);
out:
    for (size_t i = 0; i < started; i++) {
        free(turns[i].message);
        free(turns[i].warnings);
    }
    free(turns);
    return rc;
}

status tile_queue_run(const tile_queue_job *job, bool *out_failed)
{
    status rc = STATUS_OK;
    queue q = {.job = job, .lock = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};

    q.given_back = calloc(GIVEN_BACK * job->worker_count, sizeof *q.given_back);
    NEED(q.given_back, STATUS_MEMORY, "no memory for the list of tiles");
    if (job->worker_count == 1) {
        turn alone = {.q = &q, .worker = job->worker};
        rc = compute_all(&alone);
        out_failed[0] = rc != STATUS_OK;
    } else {
        rc = run_threads(&q, out_failed);
    }
    if (rc == STATUS_OK && *job->stop) rc = status_set(STATUS_INTERRUPTED, "interrupted");
out:
    free(q.given_back);
    pthread_cond_destroy(&q.changed);
    pthread_mutex_destroy(&q.lock);
    return rc;
}
