#include "render/tile_queue.h"

#include "base/interrupt.h"

#include <pthread.h>
#include <stdlib.h>

/* Tiles that a worker can have given back at once: one for every time that it halved them. */
enum { GIVEN_BACK = 33 };

typedef struct span {
    uint32_t first, count;
} span;

typedef struct queue {
    const tile_queue_job *job;
    const atomic_int *token;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    uint32_t next, done; /* pixels */
    span *given_back;    /* shape (given_back_count) */
    size_t given_back_count;
    size_t busy;   /* tiles that are being computed */
    size_t failed; /* workers */
} queue;

/* A worker at work, and how it ended. */
typedef struct turn {
    queue *q;
    const tile_worker *worker;
    pthread_t thread;
    bool has_thread;
    uint32_t most;
    size_t failed_as; /* 1: the first that failed */
    status_record ending;
} turn;

/* Takes the next tile; with none left it waits for those of others, which may come back. */
static bool take(turn *t, span *out)
{
    queue *q = t->q;
    bool is_taken = false;

    pthread_mutex_lock(&q->lock);
    while (!interrupt_is_set() && !is_taken) {
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

    interrupt_obey(t->q->token);
    t->ending = status_record_take(compute_all(t));
    if (t->ending.rc == STATUS_OK) return NULL;
    pthread_mutex_lock(&t->q->lock);
    t->failed_as = ++t->q->failed;
    pthread_mutex_unlock(&t->q->lock);
    return NULL;
}

/* Tells of one worker in the thread that asked. */
static status tell(const turn *t, size_t workers)
{
    status_record said = t->ending;

    if (t->failed_as == workers) return status_record_tell(&said);
    said.rc = STATUS_OK;
    status_record_tell(&said);
    if (t->failed_as > 0)
        status_warn("%s failed, its tiles went to the others: %s", t->worker->name,
                    t->ending.message ? t->ending.message : "no memory");
    return STATUS_OK;
}

/* Starts all workers but the first, which works here; returns how many work. */
static size_t run_workers(turn *turns, size_t count)
{
    size_t working = 1;

    for (size_t i = 1; i < count; i++) {
        turn *t = &turns[i];
        t->has_thread = pthread_create(&t->thread, NULL, work, t) == 0;
        working += t->has_thread;
        if (!t->has_thread)
            status_warn("%s is not used: no thread can be started", t->worker->name);
    }
    work(&turns[0]);
    for (size_t i = 1; i < count; i++)
        if (turns[i].has_thread) pthread_join(turns[i].thread, NULL);
    return working;
}

status tile_queue_run(const tile_queue_job *job, bool *out_failed)
{
    status rc = STATUS_OK;
    const size_t count = job->worker_count;
    queue q = {.job = job,
               .token = interrupt_token(),
               .lock = PTHREAD_MUTEX_INITIALIZER,
               .changed = PTHREAD_COND_INITIALIZER};
    turn *turns = calloc(count, sizeof *turns);

    q.given_back = calloc(GIVEN_BACK * count, sizeof *q.given_back);
    NEED(turns && q.given_back, STATUS_MEMORY, "no memory for the list of tiles");
    for (size_t i = 0; i < count; i++) turns[i] = (turn){.q = &q, .worker = &job->worker[i]};
    const size_t working = run_workers(turns, count);
    TRY(interrupt_check());
    for (size_t i = 0; i < count; i++) out_failed[i] = turns[i].failed_as > 0;
    for (size_t i = 0; i < count; i++) TRY(tell(&turns[i], working));
out:
    for (size_t i = 0; turns && i < count; i++) status_record_free(&turns[i].ending);
    free(turns);
    free(q.given_back);
    pthread_cond_destroy(&q.changed);
    pthread_mutex_destroy(&q.lock);
    return rc;
}
