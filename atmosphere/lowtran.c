#define _GNU_SOURCE /* sched_getaffinity */

#include "lowtran.h"

#include "base/interrupt.h"
#include "files/staging_folder.h"
#include "lowtran_process.h"

#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { WORKER_LIMIT = 64 };

typedef struct job {
    const char *const *decks, *const *names;
    size_t count, *same;
    lowtran_taker take;
    void *receiver;
} job;

typedef struct crew {
    staging_folder *folder;
    int count, busy;
    lowtran_process *process[WORKER_LIMIT];
    size_t deck[WORKER_LIMIT]; /* that the process runs */
} crew;

static int processor_count(void)
{
    cpu_set_t set;
    const int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;

    return count < WORKER_LIMIT ? count : WORKER_LIMIT;
}

static status crew_open(crew *c, size_t decks)
{
    status rc = STATUS_OK;
    char why[512];
    const char *folder = getenv("TMPDIR");
    const int processors = processor_count();

    if (!folder || !*folder) folder = "/tmp";
    rc = staging_folder_open(&c->folder, folder, folder);
    if (rc != STATUS_OK) {
        snprintf(why, sizeof why, "%s", status_message());
        NEED(false, rc, "%s (LOWTRAN runs there; TMPDIR chooses another folder)", why);
    }
    while (c->count < processors && (size_t)c->count < decks) {
        TRY(lowtran_process_open(&c->process[c->count], staging_folder_path(c->folder), c->count));
        c->count++;
    }
out:
    return rc;
}

static void crew_free(crew *c)
{
    for (int i = 0; i < c->count; i++) lowtran_process_free(c->process[i]);
    staging_folder_free(c->folder);
}

/* Looks for a worker whose child has ended; -1: none has. */
static int find_ended(const crew *c, int *out_status)
{
    for (int i = 0; i < c->count; i++) {
        const pid_t child = lowtran_process_id(c->process[i]);
        if (child && waitpid(child, out_status, WNOHANG) == child) return i;
    }
    return -1;
}

/* Waits for one of the crew's children, and for no other. The signal of its end is blocked: one that comes
 * before the waiting is still there. */
static status wait_for_one(const crew *c, int *out_worker, int *out_status)
{
    status rc = STATUS_OK;
    const struct timespec most = {.tv_nsec = 100000000};
    sigset_t ended;

    sigemptyset(&ended);
    sigaddset(&ended, SIGCHLD);
    while ((*out_worker = find_ended(c, out_status)) < 0) {
        TRY(interrupt_check());
        sigtimedwait(&ended, NULL, &most);
    }
out:
    return rc;
}

/* For each deck the first one that has its text. */
static status find_same(size_t **out, const char *const *decks, size_t count)
{
    status rc = STATUS_OK;
    size_t *same = malloc(count * sizeof *same);

    NEED(same, STATUS_MEMORY, "no memory for %zu decks", count);
    for (size_t i = 0; i < count; i++)
        for (same[i] = 0; same[i] < i && strcmp(decks[same[i]], decks[i]) != 0;) same[i]++;
    *out = same;
out:
    return rc;
}

/* Gives an idle worker the next deck that none before it equals, if there is one. */
static status start_next(crew *c, int worker, const job *j, size_t *next)
{
    status rc = STATUS_OK;

    while (*next < j->count && j->same[*next] != *next) ++*next;
    if (*next == j->count) goto out;
    c->deck[worker] = *next;
    TRY(lowtran_process_start(c->process[worker], j->decks[*next]));
    ++*next;
    c->busy++;
out:
    return rc;
}

static status finish(crew *c, int worker, int wait_status, const job *j)
{
    status rc = STATUS_OK;
    const size_t deck = c->deck[worker];
    lowtran_run run;

    c->busy--;
    TRY(lowtran_process_finish(c->process[worker], wait_status, j->names[deck], &run));
    for (size_t i = deck; i < j->count; i++)
        if (j->same[i] == deck) TRY(j->take(j->receiver, i, &run));
out:
    return rc;
}

status lowtran_run_decks(const char *const *decks, const char *const *names, size_t count,
                         lowtran_taker take, void *receiver)
{
    status rc = STATUS_OK;
    crew c = {0};
    job j = {decks, names, count, NULL, take, receiver};
    size_t next = 0;
    int worker, wait_status;
    sigset_t ended, before;

    sigemptyset(&ended);
    sigaddset(&ended, SIGCHLD);
    sigprocmask(SIG_BLOCK, &ended, &before);
    TRY(find_same(&j.same, decks, count));
    TRY(crew_open(&c, count));
    for (worker = 0; worker < c.count; worker++) TRY(start_next(&c, worker, &j, &next));
    while (c.busy > 0) {
        TRY(wait_for_one(&c, &worker, &wait_status));
        TRY(finish(&c, worker, wait_status, &j));
        TRY(start_next(&c, worker, &j, &next));
    }
out:
    crew_free(&c);
    free(j.same);
    sigprocmask(SIG_SETMASK, &before, NULL);
    return rc;
}
