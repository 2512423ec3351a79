#include "session.h"

#include "base/clock.h"
#include "base/interrupt.h"
#include "scene/scene_limits.h"
#include "scene_stamp.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Pixels of a tile: a wish waits for the end of one. */
enum { TILE_MOST = 1 << 12 };

/* A wish must last this long before exact work begins; files are looked at as often as watch_s. */
static const double settle_s = 0.1, watch_s = 0.5;

struct session {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool has_thread;
    atomic_int token; /* interrupts the thread */

    /* Under the lock. */
    session_wish wish;
    unsigned wished, answered; /* numbers of the last wish and of the last that came to rest */
    bool quits;
    frame *newest;
    session_state state;
    bool has_pick, has_day; /* to be made; made */
    size_t pick;
    session_day day;

    /* Of the thread. */
    device *dev;
    shared_scene *of;
    render *r;
    scene_stamp stamp;
    double stated_time_s; /* by the scene's files */
    bool stated_thesis, is_broken;
};

static void tell(session *s, const char *task, double progress)
{
    pthread_mutex_lock(&s->lock);
    s->state.task = task;
    s->state.progress = progress;
    pthread_mutex_unlock(&s->lock);
}

static bool is_outdated(session *s, unsigned number)
{
    pthread_mutex_lock(&s->lock);
    const bool outdated = s->quits || s->wished != number;
    pthread_mutex_unlock(&s->lock);
    return outdated;
}

static double wished_time_s(const session *s, const session_wish *wish)
{
    return wish->has_time ? wish->time_s : s->stated_time_s;
}

static bool wished_thesis(const session *s, const session_wish *wish)
{
    return wish->has_mode ? wish->thesis : s->stated_thesis;
}

/* Reads the scene as the wish changes it, and opens its render in place of the present one. */
static status reopen(session *s, const session_wish *wish)
{
    status rc = STATUS_OK;
    char time[32 + SITE_TIME_SIZE] = "site.time=", mode[32];
    const char *setting[2];
    size_t count = 0;
    shared_scene *of = NULL;
    render *r = NULL;

    site_format_time(wished_time_s(s, wish), s->of->s->place.utc_offset_min, time + strlen(time));
    snprintf(mode, sizeof mode, "render.mode=%s", wished_thesis(s, wish) ? "thesis" : "exact");
    if (wish->has_time) setting[count++] = time;
    if (wish->has_mode) setting[count++] = mode;
    TRY(shared_scene_read(&of, s->of->s->path, setting, count));
    TRY(render_open(&r, of->s, s->dev));
    render_free(s->r);
    shared_scene_drop(s->of);
    s->r = r;
    s->of = of;
    of = NULL;
out:
    shared_scene_drop(of);
    return rc;
}

/* Reads the files anew: what they state, then what the wish makes of it. */
static status reload(session *s, const session_wish *wish)
{
    status rc = STATUS_OK;
    shared_scene *stated = NULL;

    pthread_mutex_lock(&s->lock);
    s->answered = s->wished - 1;
    pthread_mutex_unlock(&s->lock);
    tell(s, "reading the scene", 0.0);
    s->is_broken = true;
    TRY(shared_scene_read(&stated, s->of->s->path, NULL, 0));
    s->stated_time_s = stated->s->place.time_s;
    s->stated_thesis = stated->s->thesis;
    TRY(reopen(s, wish));
    s->stamp = scene_stamp_read(stated->s);
    s->is_broken = false;
out:
    shared_scene_drop(stated);
    return rc;
}

static void publish(session *s, frame *f)
{
    pthread_mutex_lock(&s->lock);
    frame_drop(s->newest);
    s->newest = f;
    pthread_mutex_unlock(&s->lock);
}

/* Renders what the look shows, tile by tile; an exact frame is given up when there is a new wish. */
static status render_frame(session *s, const render_look *look, unsigned number)
{
    status rc = STATUS_OK;
    const double start_s = clock_now_s();
    uint32_t most;
    frame *f = NULL;
    size_t plane_count = 0;
    const render_plane *planes = render_planes(s->r, &plane_count);

    TRY(scene_limits_view(s->of->s, &look->camera));
    TRY(frame_create(&f, s->of, &look->camera, planes, plane_count));
    render_change_look(s->r, look);
    most = render_tile_limit(s->r) < TILE_MOST ? render_tile_limit(s->r) : TILE_MOST;
    for (size_t done = 0, all = frame_pixels(f); done < all;) {
        const uint32_t count = all - done < most ? (uint32_t)(all - done) : most;
        if (!look->is_coarse && is_outdated(s, number)) goto out;
        rc = render_tile(s->r, (uint32_t)done, count, f->values, NULL);
        if (rc == STATUS_MEMORY && most > 1) {
            most /= 2;
            continue;
        }
        TRY(rc);
        done += count;
        if (!look->is_coarse) tell(s, "rendering", (double)done / (double)all);
    }
    f->time_s = look->time_s;
    f->is_exact = !look->is_coarse;
    f->wish = number;
    f->seconds = clock_now_s() - start_s;
    publish(s, f);
    f = NULL;
out:
    frame_drop(f);
    return rc;
}

static render_look wished_look(const session *s, const session_wish *wish)
{
    render_look look = render_stated_look(s->of->s);

    if (wish->has_camera) look.camera = wish->camera;
    look.camera.columns = wish->columns;
    look.camera.rows = wish->rows;
    look.camera.crop = (view_crop){0}; /* the whole frame */
    look.time_s = wished_time_s(s, wish);
    return look;
}

static status render_coarse(session *s, const session_wish *wish, unsigned number)
{
    render_look look = wished_look(s, wish);
    const double fraction = fmin(1.0, fmax((double)SESSION_COARSE_COLUMNS / wish->columns,
                                           (double)SESSION_COARSE_ROWS / wish->rows));

    look.camera.columns = (int)ceil(fraction * wish->columns);
    look.camera.rows = (int)ceil(fraction * wish->rows);
    look.is_coarse = true;
    return render_frame(s, &look, number);
}

/* Waits up to a time for another wish; true: there is none. */
static bool stays(session *s, unsigned number, double wait_s)
{
    struct timespec until;
    int error = 0;

    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += (long)(wait_s * 1e9);
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_mutex_lock(&s->lock);
    while (!s->quits && s->wished == number && !s->has_pick && error != ETIMEDOUT)
        error = pthread_cond_timedwait(&s->changed, &s->lock, &until);
    const bool stayed = !s->quits && s->wished == number;
    pthread_mutex_unlock(&s->lock);
    return stayed;
}

/* Answers one wish, up to the exact frame unless another wish comes first. */
static status answer(session *s, const session_wish *wish, unsigned number)
{
    status rc = STATUS_OK;

    if (s->r && s->of->s->thesis != wished_thesis(s, wish)) TRY(reopen(s, wish));
    if (!s->r) TRY(render_open(&s->r, s->of->s, s->dev));
    tell(s, "moving", 0.0);
    TRY(render_coarse(s, wish, number));
    if (!stays(s, number, settle_s)) goto out;
    if (s->of->s->place.time_s != wished_time_s(s, wish)) {
        tell(s, "temperatures", 0.0);
        TRY(reopen(s, wish));
        TRY(render_coarse(s, wish, number));
    }
    const render_look look = wished_look(s, wish);
    TRY(render_frame(s, &look, number));
out:
    return rc;
}

/* Keeps what became of a wish; one that another replaced meanwhile has no end. */
static void settle(session *s, unsigned number, status rc)
{
    const char *warnings = status_warnings();

    pthread_mutex_lock(&s->lock);
    if (!s->is_broken) s->state.error[0] = '\0'; /* else it stays until the files are right */
    if (rc != STATUS_OK) snprintf(s->state.error, sizeof s->state.error, "%s", status_message());
    if (*warnings)
        snprintf(s->state.warning, sizeof s->state.warning, "%.*s", (int)strcspn(warnings, "\n"),
                 warnings);
    if (s->wished == number) s->answered = number;
    s->state.task = "";
    pthread_mutex_unlock(&s->lock);
    status_clear();
}

/* Makes the day of the picked pixel, of the look of the last exact frame. */
static void make_day(session *s, unsigned number)
{
    session_day made = {.is_made = true, .wish = number};

    pthread_mutex_lock(&s->lock);
    made.pixel = s->pick;
    s->has_pick = false;
    pthread_mutex_unlock(&s->lock);
    if (!s->r || render_pixel_day(s->r, (uint32_t)made.pixel, &made.day) != STATUS_OK)
        status_clear();
    pthread_mutex_lock(&s->lock);
    pixel_day_free(&s->day.day);
    s->day = made;
    s->has_day = true;
    pthread_mutex_unlock(&s->lock);
}

static void *work(void *argument)
{
    session *s = argument;

    interrupt_obey(&s->token);
    pthread_mutex_lock(&s->lock);
    while (!s->quits) {
        const session_wish wish = s->wish;
        const unsigned number = s->wished;
        const bool is_new = s->answered != number, has_pick = s->has_pick;
        pthread_mutex_unlock(&s->lock);
        const scene_stamp stamp = scene_stamp_now(s->of->s);
        if (!scene_stamp_equal(stamp, s->stamp)) {
            s->stamp = stamp;
            status rc = reload(s, &wish);
            if (rc == STATUS_OK) rc = answer(s, &wish, number);
            settle(s, number, rc);
        } else if (is_new) {
            settle(s, number, answer(s, &wish, number));
        } else if (has_pick) {
            make_day(s, number);
        } else {
            stays(s, number, watch_s);
        }
        pthread_mutex_lock(&s->lock);
    }
    pthread_mutex_unlock(&s->lock);
    return NULL;
}

status session_open(session **out, shared_scene *first, const session_wish *wish)
{
    status rc = STATUS_OK;
    session *s = calloc(1, sizeof *s);

    NEED(s, STATUS_MEMORY, "no memory for a session");
    pthread_mutex_init(&s->lock, NULL);
    pthread_cond_init(&s->changed, NULL);
    TRY(device_open(&s->dev, -1));
    s->of = shared_scene_hold(first);
    s->stated_time_s = first->s->place.time_s;
    s->stated_thesis = first->s->thesis;
    s->stamp = scene_stamp_read(first->s);
    s->wish = *wish;
    s->wished = 1;
    s->state.task = "opening";
    NEED(pthread_create(&s->thread, NULL, work, s) == 0, STATUS_MEMORY, "no thread can be started");
    s->has_thread = true;
    *out = s;
    s = NULL;
out:
    session_free(s);
    return rc;
}

void session_free(session *s)
{
    if (!s) return;
    if (s->has_thread) {
        pthread_mutex_lock(&s->lock);
        s->quits = true;
        atomic_store(&s->token, 1);
        pthread_cond_signal(&s->changed);
        pthread_mutex_unlock(&s->lock);
        pthread_join(s->thread, NULL);
    }
    frame_drop(s->newest);
    pixel_day_free(&s->day.day);
    render_free(s->r);
    shared_scene_drop(s->of);
    device_free(s->dev);
    pthread_cond_destroy(&s->changed);
    pthread_mutex_destroy(&s->lock);
    free(s);
}

unsigned session_ask(session *s, const session_wish *wish)
{
    pthread_mutex_lock(&s->lock);
    s->wish = *wish;
    const unsigned number = ++s->wished;
    pthread_cond_signal(&s->changed);
    pthread_mutex_unlock(&s->lock);
    return number;
}

frame *session_take(session *s)
{
    pthread_mutex_lock(&s->lock);
    frame *f = s->newest;
    s->newest = NULL;
    pthread_mutex_unlock(&s->lock);
    return f;
}

void session_pick(session *s, size_t pixel)
{
    pthread_mutex_lock(&s->lock);
    s->pick = pixel;
    s->has_pick = true;
    pthread_cond_signal(&s->changed);
    pthread_mutex_unlock(&s->lock);
}

bool session_take_day(session *s, session_day *out)
{
    pthread_mutex_lock(&s->lock);
    const bool has_day = s->has_day;
    if (has_day) {
        *out = s->day;
        s->day = (session_day){0};
        s->has_day = false;
    }
    pthread_mutex_unlock(&s->lock);
    return has_day;
}

void session_look(session *s, session_state *out)
{
    pthread_mutex_lock(&s->lock);
    *out = s->state;
    out->is_at_rest = s->answered == s->wished;
    pthread_mutex_unlock(&s->lock);
}
