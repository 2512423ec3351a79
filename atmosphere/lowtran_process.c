#include "lowtran_process.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* The longest deck takes seconds; a processor that is shared by many takes its time. */
enum { PATIENCE_S = 600, COLUMNS = 63, ECHO_LIMIT = 8 };

/* Shared with the child. */
typedef struct sheet {
    int done, level_count, point_count;
    float range_km;
    float altitude_km[LOWTRAN_LEVELS], pressure_mb[LOWTRAN_LEVELS], temperature_k[LOWTRAN_LEVELS];
    float wavenumber[LOWTRAN_POINTS], tau[LOWTRAN_POINTS], emitted[LOWTRAN_POINTS];
    float irradiance[3][LOWTRAN_POINTS]; /* at the ground, outside, scattered path radiance */
} sheet;

struct lowtran_process {
    char *folder;
    sheet *shared;
    pid_t child;
};

/* lowtran7.f; the names of its arguments and common blocks are its own. */
extern void lwtrn7_(const int *python, const int *nwl, const float *v1, const float *v2,
                    const float *dv, float *tx, float *v, float *alam, float *trace, float *unif,
                    float *suma, float *irrad, float *sumvv, const int *model, const int *itype,
                    const int *iemsct, const int *im, const int *iseasn, const int *ml,
                    const int *ird1, const float *zmdl, const float *p, const float *t,
                    const float *wmol, const float *h1, const float *h2, const float *angle,
                    const float *range);
extern struct {
    float h1, h2, angle, range, beta, re;
    int len;
} card3_;
extern struct {
    float zm[LOWTRAN_LEVELS], pm[LOWTRAN_LEVELS], tm[LOWTRAN_LEVELS];
} model_;
extern struct {
    int kmax, m, ikmax, nl, ml, iklo, issgeo, imult;
} cntrl_;

static const char *const files[] = {"TAPE5", "out/TAPE6", "out/TAPE7", "out/TAPE8", "said"};

static char *join(const char *folder, const char *name)
{
    const size_t size = strlen(folder) + strlen(name) + 2;
    char *path = malloc(size);

    if (path) snprintf(path, size, "%s/%s", folder, name);
    return path;
}

static status write_file(const char *folder, const char *name, const char *text)
{
    status rc = STATUS_OK;
    FILE *file = NULL;
    char *path = join(folder, name);

    NEED(path, STATUS_MEMORY, "the name of %s", name);
    file = fopen(path, "w");
    NEED(file && fputs(text, file) >= 0, STATUS_FILE, "%s: %s", path, strerror(errno));
out:
    if (file && fclose(file) != 0 && rc == STATUS_OK)
        rc = status_set(STATUS_FILE, "%s: %s", path, strerror(errno));
    free(path);
    return rc;
}

status lowtran_process_open(lowtran_process **out, const char *folder, int number)
{
    status rc = STATUS_OK;
    char name[16];
    char *inner = NULL;
    lowtran_process *p = calloc(1, sizeof *p);

    NEED(p, STATUS_MEMORY, "a LOWTRAN process");
    snprintf(name, sizeof name, "%d", number);
    p->folder = join(folder, name);
    NEED(p->folder, STATUS_MEMORY, "a LOWTRAN process");
    inner = join(p->folder, "out");
    NEED(inner, STATUS_MEMORY, "a LOWTRAN process");
    NEED(mkdir(p->folder, 0700) == 0 && mkdir(inner, 0700) == 0, STATUS_FILE, "%s: %s", inner,
         strerror(errno));
    p->shared =
        mmap(NULL, sizeof *p->shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (p->shared == MAP_FAILED) p->shared = NULL;
    NEED(p->shared, STATUS_MEMORY, "the spectra of a LOWTRAN process: %s", strerror(errno));
    *out = p;
    p = NULL;
out:
    free(inner);
    lowtran_process_free(p);
    return rc;
}

static void remove_folder(const char *folder)
{
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char *path = join(folder, files[i]);
        if (path) unlink(path);
        free(path);
    }
    char *inner = join(folder, "out");
    if (inner) rmdir(inner);
    free(inner);
    rmdir(folder);
}

void lowtran_process_free(lowtran_process *p)
{
    if (!p) return;
    if (p->child) {
        kill(p->child, SIGKILL);
        waitpid(p->child, NULL, 0);
    }
    if (p->shared) munmap(p->shared, sizeof *p->shared);
    if (p->folder) remove_folder(p->folder);
    free(p->folder);
    free(p);
}

/* In the child: all that LOWTRAN reads is in the deck, so the other arguments are zero. */
static void run_deck(sheet *to)
{
    const int no = 0, points = LOWTRAN_POINTS;
    const float zero = 0.0f, empty[COLUMNS] = {0.0f};
    float *tx = calloc((size_t)LOWTRAN_POINTS * COLUMNS, sizeof *tx);
    float *rest = calloc((size_t)LOWTRAN_POINTS * 4, sizeof *rest);

    if (!tx || !rest) _exit(1);
    lwtrn7_(&no, &points, &zero, &zero, &zero, tx, to->wavenumber, rest, rest + points,
            rest + 2 * points, rest + 3 * points, to->irradiance[0], to->emitted, &no, &no, &no,
            &no, &no, &no, &no, empty, empty, empty, empty, &zero, &zero, &zero, &zero);
    memcpy(to->tau, tx, sizeof to->tau);
    for (int i = 0; i < points; i++)
        if (to->wavenumber[i] > 0.0f) to->point_count = i + 1;
    to->range_km = card3_.range;
    to->level_count = cntrl_.ml < LOWTRAN_LEVELS ? cntrl_.ml : LOWTRAN_LEVELS;
    memcpy(to->altitude_km, model_.zm, sizeof to->altitude_km);
    memcpy(to->pressure_mb, model_.pm, sizeof to->pressure_mb);
    memcpy(to->temperature_k, model_.tm, sizeof to->temperature_k);
    to->done = 1;
}

_Noreturn static void be_child(lowtran_process *p)
{
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    alarm(PATIENCE_S);
    const int said = chdir(p->folder) == 0 ? open("said", O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1;
    if (said < 0 || dup2(said, STDOUT_FILENO) < 0 || dup2(said, STDERR_FILENO) < 0) _exit(1);
    run_deck(p->shared);
    _exit(0);
}

status lowtran_process_start(lowtran_process *p, const char *deck)
{
    status rc = STATUS_OK;

    for (size_t i = 1; i < sizeof files / sizeof *files; i++)
        TRY(write_file(p->folder, files[i], ""));
    TRY(write_file(p->folder, files[0], deck));
    memset(p->shared, 0, sizeof *p->shared);
    fflush(NULL);
    p->child = fork();
    if (p->child == 0) be_child(p);
    if (p->child < 0) {
        p->child = 0;
        rc = status_set(STATUS_FILE, "a process for LOWTRAN: %s", strerror(errno));
    }
out:
    return rc;
}

pid_t lowtran_process_id(const lowtran_process *p)
{
    return p->child;
}

/* A file of the child as text, "" if there is none; the caller frees it. */
static char *read_text(const char *folder, const char *name)
{
    char *path = join(folder, name), *text = NULL;
    FILE *file = path ? fopen(path, "r") : NULL, *memory = NULL;
    char part[4096];
    size_t size, length = 0;

    memory = open_memstream(&text, &length);
    while (memory && file && (size = fread(part, 1, sizeof part, file)) > 0)
        fwrite(part, 1, size, memory);
    if (memory) fclose(memory);
    if (file) fclose(file);
    free(path);
    return text;
}

/* The last line that tells of an error, else the last that is not blank; "" if there is none. */
static const char *find_complaint(char *text)
{
    const char *last = "", *error = "";

    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        line += strspn(line, " 0");
        if (!*line) continue;
        last = line;
        if (strstr(line, "rror") || strstr(line, "ERROR") || strstr(line, "STOP")) error = line;
    }
    return *error ? error : last;
}

static status explain(const lowtran_process *p, int wait_status, const char *name)
{
    char *said = read_text(p->folder, "said"), *tape6 = read_text(p->folder, "out/TAPE6");
    const char *what = said ? find_complaint(said) : "";
    const char *log = tape6 ? find_complaint(tape6) : "";
    const char *end = "gave no spectrum";

    if (WIFSIGNALED(wait_status))
        end = WTERMSIG(wait_status) == SIGALRM ? "took too long" : "crashed";
    else if (!p->shared->done)
        end = "stopped";
    const status rc = status_set(STATUS_FORMAT,
                                 "%s: LOWTRAN %s: %s%s%s (expected a deck by the LOWTRAN 7 manual)",
                                 name, end, what, *what && *log ? "; its log ends: " : "", log);
    free(said);
    free(tape6);
    return rc;
}

/* Numbers of the card that LOWTRAN echoes, in columns of the given width. */
static void read_echo(const char *tape6, const char *card, int width, double out[ECHO_LIMIT])
{
    const char *found = strstr(tape6, card);
    char field[16];

    memset(out, 0, ECHO_LIMIT * sizeof *out);
    if (!found) return;
    const char *text = strchr(found, '*');
    text += strspn(text, "*");
    const size_t length = strcspn(text, "\n");
    for (size_t i = 0; i < ECHO_LIMIT && (i + 1) * (size_t)width <= length; i++) {
        snprintf(field, sizeof field, "%.*s", width, text + i * (size_t)width);
        out[i] = strtod(field, NULL);
    }
}

static void read_cards(lowtran_run *out, const char *tape6)
{
    double values[ECHO_LIMIT];

    read_echo(tape6, "CARD 1  *", 5, values);
    out->itype = (int)values[1];
    out->iemsct = (int)values[2];
    read_echo(tape6, out->iemsct == 3 ? "CARD 3   *" : "CARD 3  *", 10, values);
    out->h1_km = values[0];
    out->h2_km = values[1];
    out->angle_deg = values[2];
    read_echo(tape6, "CARD 3A1*", 5, values);
    out->iparm = (int)values[0];
    read_echo(tape6, "CARD 3A2*", 10, values);
    out->parm1 = values[0];
    out->psipo_deg = values[5];
}

static void point_at(lowtran_run *out, const sheet *from)
{
    out->range_km = (double)from->range_km;
    out->level_count = from->level_count;
    memcpy(out->altitude_km, from->altitude_km, sizeof out->altitude_km);
    memcpy(out->pressure_mb, from->pressure_mb, sizeof out->pressure_mb);
    memcpy(out->temperature_k, from->temperature_k, sizeof out->temperature_k);
    out->point_count = from->point_count;
    out->wavenumber_cm1 = from->wavenumber;
    out->tau = from->tau;
    out->emitted = from->emitted;
    out->scattered = from->irradiance[2];
    out->irradiance = from->irradiance[1];
}

status lowtran_process_finish(lowtran_process *p, int wait_status, const char *name,
                              lowtran_run *out)
{
    status rc = STATUS_OK;
    char *tape6 = NULL;
    const sheet *s = p->shared;

    p->child = 0;
    if (!s->done || s->point_count == 0) return explain(p, wait_status, name);
    for (int i = 0; i < s->point_count; i++)
        NEED(isfinite(s->tau[i]) && isfinite(s->emitted[i]) && isfinite(s->irradiance[2][i]),
             STATUS_FORMAT, "%s: LOWTRAN gave no number at %g cm-1", name,
             (double)s->wavenumber[i]);
    tape6 = read_text(p->folder, "out/TAPE6");
    NEED(tape6, STATUS_MEMORY, "%s: the log of LOWTRAN", name);
    *out = (lowtran_run){0};
    read_cards(out, tape6);
    point_at(out, s);
out:
    free(tape6);
    return rc;
}
