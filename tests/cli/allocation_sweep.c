/* To be preloaded: before main it forks one process after another, in each of which another allocation
 * fails, the first, the second and so on, until one ends before its turn comes. Outputs go to NUMBER.out
 * and NUMBER.err in the folder SWEEP_FOLDER, codes as lines `number code` to its `codes`; a process that
 * died by a signal has its number, negative. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t);

enum { LIMIT = 20000 };

static long turn, *count; /* 0: none fails; shared with the parent */

static int fails(void)
{
    if (turn == 0 || __atomic_add_fetch(count, 1, __ATOMIC_RELAXED) != turn) return 0;
    errno = ENOMEM;
    return 1;
}

void *malloc(size_t size)
{
    return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t number, size_t size)
{
    return fails() ? NULL : __libc_calloc(number, size);
}

void *realloc(void *old, size_t size)
{
    return fails() ? NULL : __libc_realloc(old, size);
}

static void redirect(const char *folder, long number, const char *kind, int to)
{
    char path[4096];
    int file;

    snprintf(path, sizeof path, "%s/%ld.%s", folder, number, kind);
    file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0) _exit(99);
    dup2(file, to);
    close(file);
}

__attribute__((constructor)) static void sweep(void)
{
    const char *folder = getenv("SWEEP_FOLDER");
    char path[4096];
    int code;

    if (!folder) return;
    count = mmap(NULL, sizeof *count, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    snprintf(path, sizeof path, "%s/codes", folder);
    for (long number = 1; number < LIMIT; number++) {
        *count = 0;
        const pid_t child = fork();
        if (child == 0) {
            redirect(folder, number, "out", 1);
            redirect(folder, number, "err", 2);
            turn = number;
            return; /* to main */
        }
        if (child < 0 || waitpid(child, &code, 0) != child) _exit(99);
        FILE *codes = fopen(path, "a");
        if (!codes) _exit(99);
        fprintf(codes, "%ld %d\n", number, WIFSIGNALED(code) ? -WTERMSIG(code) : WEXITSTATUS(code));
        fclose(codes);
        if (*count < number) _exit(0);
    }
    _exit(98);
}
