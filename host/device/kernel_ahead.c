#define CL_TARGET_OPENCL_VERSION 120
#include "device/kernel_ahead.h"

#include "base/interrupt.h"
#include "device/kernel_program.h"
#include "launches.h"

#include <CL/cl.h>
#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

enum { THREAD_LIMIT = 4 };

typedef enum stage { UNKNOWN, WAITING, BUILDING, LEFT } stage;

struct kernel_ahead {
    cl_device_id id;
    const device_info *info;
    const atomic_int *token;
    pthread_t threads[THREAD_LIMIT];
    size_t thread_count;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool ends;
    size_t queue[KERNEL_COUNT], next, count;
    stage stages[KERNEL_COUNT];
};

/* Waits for a kernel to build; false at the end. Call with the lock held. */
static bool take_next(kernel_ahead *ahead, size_t *out)
{
    while (!ahead->ends && !interrupt_is_set()) {
        while (ahead->next < ahead->count && ahead->stages[ahead->queue[ahead->next]] != WAITING)
            ahead->next++;
        if (ahead->next < ahead->count) {
            *out = ahead->queue[ahead->next++];
            ahead->stages[*out] = BUILDING;
            return true;
        }
        pthread_cond_wait(&ahead->changed, &ahead->lock);
    }
    return false;
}

static void build(kernel_ahead *ahead, cl_context context, size_t kernel)
{
    cl_program program = NULL;

    if (kernel_program_build(&program, context, ahead->id, ahead->info,
                             device_kernels[kernel].name) == STATUS_OK)
        clReleaseProgram(program);
}

static void *work(void *argument)
{
    kernel_ahead *ahead = argument;
    cl_context context = clCreateContext(NULL, 1, &ahead->id, NULL, NULL, NULL);
    size_t kernel;

    interrupt_obey(ahead->token);
    pthread_mutex_lock(&ahead->lock);
    while (context && take_next(ahead, &kernel)) {
        pthread_mutex_unlock(&ahead->lock);
        build(ahead, context, kernel);
        pthread_mutex_lock(&ahead->lock);
        ahead->stages[kernel] = LEFT;
        pthread_cond_broadcast(&ahead->changed);
    }
    pthread_mutex_unlock(&ahead->lock);
    if (context) clReleaseContext(context);
    return NULL;
}

status kernel_ahead_open(kernel_ahead **out, cl_device_id id, const device_info *info)
{
    status rc = STATUS_OK;
    const long half = sysconf(_SC_NPROCESSORS_ONLN) / 2;
    const size_t wanted = half < 1 ? 1 : half > THREAD_LIMIT ? THREAD_LIMIT : (size_t)half;
    kernel_ahead *ahead = calloc(1, sizeof *ahead);

    NEED(ahead, STATUS_MEMORY, "no memory to build kernels");
    ahead->id = id;
    ahead->info = info;
    ahead->token = interrupt_token();
    pthread_mutex_init(&ahead->lock, NULL);
    pthread_cond_init(&ahead->changed, NULL);
    while (ahead->thread_count < wanted &&
           pthread_create(&ahead->threads[ahead->thread_count], NULL, work, ahead) == 0)
        ahead->thread_count++;
    NEED(ahead->thread_count > 0, STATUS_MEMORY, "no thread can be started to build kernels");
    *out = ahead;
    ahead = NULL;
out:
    kernel_ahead_free(ahead);
    return rc;
}

void kernel_ahead_add(kernel_ahead *ahead, const size_t *kernels, size_t count)
{
    pthread_mutex_lock(&ahead->lock);
    for (size_t i = 0; i < count; i++) {
        if (ahead->stages[kernels[i]] != UNKNOWN) continue;
        ahead->stages[kernels[i]] = WAITING;
        ahead->queue[ahead->count++] = kernels[i];
    }
    pthread_cond_broadcast(&ahead->changed);
    pthread_mutex_unlock(&ahead->lock);
}

void kernel_ahead_take(kernel_ahead *ahead, size_t kernel)
{
    pthread_mutex_lock(&ahead->lock);
    while (ahead->stages[kernel] == BUILDING) pthread_cond_wait(&ahead->changed, &ahead->lock);
    ahead->stages[kernel] = LEFT;
    pthread_mutex_unlock(&ahead->lock);
}

bool kernel_ahead_free(kernel_ahead *ahead)
{
    bool is_whole = true;

    if (!ahead) return false;
    pthread_mutex_lock(&ahead->lock);
    ahead->ends = true;
    pthread_cond_broadcast(&ahead->changed);
    pthread_mutex_unlock(&ahead->lock);
    for (size_t i = 0; i < ahead->thread_count; i++) pthread_join(ahead->threads[i], NULL);
    for (size_t i = 0; i < ahead->count; i++) is_whole &= ahead->stages[ahead->queue[i]] == LEFT;
    pthread_cond_destroy(&ahead->changed);
    pthread_mutex_destroy(&ahead->lock);
    free(ahead);
    return is_whole;
}
