/* Session: renders a scene again and again in a thread of its own, as the wishes of the preview change:
 * each wish first coarse, then, when no other follows, exactly as `radsig render` does. Reads the scene
 * again when one of its files changes. */
#ifndef SESSION_H
#define SESSION_H

#include "frame.h"

typedef struct session session;

/* What to show. What the wish does not have is as the scene says. */
typedef struct session_wish {
    int columns, rows;
    bool has_camera, has_time, has_mode;
    view camera; /* its columns and rows are not used */
    double time_s;
    bool thesis;
} session_wish;

/* What a session is at. */
typedef struct session_state {
    bool is_at_rest;   /* the newest frame is exact and answers the last wish, or the wish failed */
    double progress;   /* share of the exact frame, 0..1 */
    const char *task;  /* a constant text */
    char error[2048];  /* of the last wish or of the files; empty: none */
    char warning[512]; /* the first of the last that were given; empty: none */
} session_state;

/* A coarse frame has at least this many columns and rows, if the exact one has. */
enum { SESSION_COARSE_COLUMNS = 320, SESSION_COARSE_ROWS = 240 };

/* Opens the device and starts. The scene was read from its path without settings; it is held. */
status session_open(session **out, shared_scene *first, const session_wish *wish);

/* Ends the thread, whatever it is at: it is interrupted. */
void session_free(session *s);

/* Replaces the wish; returns its number. */
unsigned session_ask(session *s, const session_wish *wish);

/* Takes the newest frame since the last call, or NULL. The caller holds it. */
frame *session_take(session *s);

/* The last 24 hours of a pixel of the last exact frame. */
typedef struct session_day {
    bool is_made;
    size_t pixel;
    unsigned wish; /* number of the frame's */
    pixel_day day; /* no steps: the pixel shows the sky, or the day cannot be had */
} session_day;

/* Asks for the day of a pixel of the exact frame of the last wish. */
void session_pick(session *s, size_t pixel);

/* Takes the day that was last made; false: there is none since the last call. The caller frees it. */
bool session_take_day(session *s, session_day *out);

void session_look(session *s, session_state *out);

#endif
