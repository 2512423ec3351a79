#include "lowtran_process.h"

#include "base/number.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ECHO_LIMIT = 8 };
enum { EMITTED = 1, SCATTERED = 2, SUN = 3 }; /* IEMSCT */

struct lowtran_process {
    char *folder;
    lowtran_sheet sheet;
    pid_t child;
};

extern char **environ;

/* The deck comes first; what radsig-lowtran says lies in the last but one. */
static const char *const files[] = {"TAPE5",     "out/TAPE6", "out/TAPE7",
                                    "out/TAPE8", "said",      LOWTRAN_SHEET_FILE};

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

    NEED(path, STATUS_MEMORY, "no memory for the name of %s", name);
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

    NEED(p, STATUS_MEMORY, "no memory for a LOWTRAN process");
    snprintf(name, sizeof name, "%d", number);
    p->folder = join(folder, name);
    NEED(p->folder, STATUS_MEMORY, "no memory for a LOWTRAN process");
    inner = join(p->folder, "out");
    NEED(inner, STATUS_MEMORY, "no memory for a LOWTRAN process");
    NEED(mkdir(p->folder, 0700) == 0 && mkdir(inner, 0700) == 0, STATUS_FILE, "%s: %s", inner,
         strerror(errno));
    *out = p;
    p = NULL;
out:
    free(inner);
    lowtran_process_free(p);
    return rc;
}

void lowtran_process_free(lowtran_process *p)
{
    if (!p) return;
    if (p->child) {
        kill(p->child, SIGKILL);
        waitpid(p->child, NULL, 0);
    }
    free(p->folder);
    free(p);
}

/* Writes the path of radsig-lowtran, beside this program. */
static status program_path(char *out, size_t size)
{
    status rc = STATUS_OK;
    const ssize_t length = readlink("/proc/self/exe", out, size - sizeof "radsig-lowtran");

    NEED(length > 0, STATUS_FILE, "/proc/self/exe: %s", strerror(errno));
    out[length] = '\0';
    strcpy(strrchr(out, '/') + 1, "radsig-lowtran");
out:
    return rc;
}

/* Unlike fork() this does not copy what the libraries of this program have mapped. */
static status spawn(lowtran_process *p)
{
    status rc = STATUS_OK;
    char program[4096];
    char *const arguments[] = {program, p->folder, NULL};
    char *said = join(p->folder, "said");
    posix_spawn_file_actions_t actions;

    posix_spawn_file_actions_init(&actions);
    NEED(said, STATUS_MEMORY, "no memory for a LOWTRAN process");
    TRY(program_path(program, sizeof program));
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, said, O_WRONLY | O_TRUNC, 0);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    errno = posix_spawn(&p->child, program, &actions, NULL, arguments, environ);
    if (errno) p->child = 0;
    NEED(errno == 0, STATUS_FILE, "%s: %s (make atmosphere builds it)", program, strerror(errno));
out:
    posix_spawn_file_actions_destroy(&actions);
    free(said);
    return rc;
}

status lowtran_process_start(lowtran_process *p, const char *deck)
{
    status rc = STATUS_OK;

    for (size_t i = 1; i < sizeof files / sizeof *files; i++)
        TRY(write_file(p->folder, files[i], ""));
    TRY(write_file(p->folder, files[0], deck));
    TRY(spawn(p));
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

/* A terminal interrupts the children too. */
static bool was_interrupted(int wait_status)
{
    const int number = WIFSIGNALED(wait_status) ? WTERMSIG(wait_status) : 0;

    return number == SIGINT || number == SIGTERM || number == SIGHUP;
}

/* How often a text holds another, and where last. */
static int count_text(const char *text, const char *part, const char **out_last)
{
    int count = 0;

    *out_last = NULL;
    for (const char *at = text; (at = strstr(at, part)) != NULL; at++) {
        *out_last = at;
        count++;
    }
    return count;
}

/* A run whose path LOWTRAN cannot follow leaves what an earlier run of the deck left. */
static bool has_all_spectra(const char *tape6)
{
    const char *last;

    return count_text(tape6, "INTEGRATED ABSORPTION FROM", &last) ==
           count_text(tape6, "CARD 5 *****", &last);
}

static status explain(const lowtran_process *p, int wait_status, const char *name)
{
    char *said = read_text(p->folder, "said"), *tape6 = read_text(p->folder, "out/TAPE6");
    const char *what = said ? find_complaint(said) : "";
    const char *log = tape6 ? find_complaint(tape6) : "";
    const char *end = "gave no spectrum";

    if (WIFSIGNALED(wait_status))
        end = WTERMSIG(wait_status) == SIGALRM || WTERMSIG(wait_status) == SIGXCPU ? "took too long"
                                                                                   : "crashed";
    else if (wait_status != 0)
        end = "stopped";
    const status rc = status_set(STATUS_FORMAT,
                                 "%s: LOWTRAN %s: %s%s%s (expected a deck by the LOWTRAN 7 manual)",
                                 name, end, what, *what && *log ? "; its log ends: " : "", log);
    free(said);
    free(tape6);
    return rc;
}

/* Numbers of the card that LOWTRAN echoes, in columns of the given width; of several the last. */
static void read_echo(const char *tape6, const char *card, int width, double out[ECHO_LIMIT])
{
    const char *found;
    char field[16];

    memset(out, 0, ECHO_LIMIT * sizeof *out);
    if (count_text(tape6, card, &found) == 0) return;
    const char *text = strchr(found, '*');
    text += strspn(text, "*");
    const size_t length = strcspn(text, "\n");
    for (size_t i = 0; i < ECHO_LIMIT && (i + 1) * (size_t)width <= length; i++) {
        snprintf(field, sizeof field, "%.*s", width, text + i * (size_t)width);
        number_take(field + strspn(field, " "), &out[i]);
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

/* What LOWTRAN has not computed it leaves as it was. */
static void clear_rest(lowtran_sheet *s, int iemsct)
{
    if (iemsct != EMITTED && iemsct != SCATTERED) memset(s->emitted, 0, sizeof s->emitted);
    if (iemsct != SCATTERED) memset(s->irradiance[2], 0, sizeof s->irradiance[2]);
    if (iemsct != SUN) memset(s->irradiance[1], 0, sizeof s->irradiance[1]);
}

static void point_at(lowtran_run *out, const lowtran_sheet *from)
{
    out->range_km = (double)from->range_km;
    out->level_count = from->level_count;
    memcpy(out->altitude_km, from->altitude_km, sizeof out->altitude_km);
    memcpy(out->temperature_k, from->temperature_k, sizeof out->temperature_k);
    out->point_count = from->point_count;
    out->wavenumber_cm1 = from->wavenumber_cm1;
    out->tau = from->tau;
    out->emitted = from->emitted;
    out->scattered = from->irradiance[2];
    out->irradiance = from->irradiance[1];
}

/* Returns false unless the process left a whole sheet with a spectrum. */
static bool read_sheet(lowtran_process *p)
{
    char *path = join(p->folder, LOWTRAN_SHEET_FILE);
    FILE *file = path ? fopen(path, "rb") : NULL;
    const bool whole = file && fread(&p->sheet, sizeof p->sheet, 1, file) == 1;

    if (file) fclose(file);
    free(path);
    return whole && p->sheet.point_count > 0;
}

status lowtran_process_finish(lowtran_process *p, int wait_status, const char *name,
                              lowtran_run *out)
{
    status rc = STATUS_OK;
    char *tape6 = NULL;
    lowtran_sheet *s = &p->sheet;

    p->child = 0;
    NEED(!was_interrupted(wait_status), STATUS_INTERRUPTED, "%s: interrupted", name);
    tape6 = read_text(p->folder, "out/TAPE6");
    NEED(tape6, STATUS_MEMORY, "%s: the log of LOWTRAN", name);
    if (wait_status != 0 || !read_sheet(p) || !has_all_spectra(tape6)) {
        rc = explain(p, wait_status, name);
        goto out;
    }
    *out = (lowtran_run){0};
    read_cards(out, tape6);
    clear_rest(s, out->iemsct);
    for (int i = 0; i < s->point_count; i++)
        NEED(isfinite(s->tau[i]) && isfinite(s->emitted[i]) && isfinite(s->irradiance[2][i]),
             STATUS_FORMAT, "%s: LOWTRAN gave no number at %g cm-1", name,
             (double)s->wavenumber_cm1[i]);
    point_at(out, s);
out:
    free(tape6);
    return rc;
}
