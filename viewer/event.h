/* Event: what the person in front of a surface did. */
#ifndef EVENT_H
#define EVENT_H

#include <stdbool.h>

typedef enum event_kind {
    EVENT_KEY,
    EVENT_PRESS,
    EVENT_RELEASE,
    EVENT_MOVE,
    EVENT_SCROLL,
    EVENT_RESIZE,
    EVENT_CLOSE
} event_kind;

/* Keys that are no character. */
typedef enum event_key {
    EVENT_LEFT = 0x110000, /* past the last Unicode character */
    EVENT_RIGHT,
    EVENT_UP,
    EVENT_DOWN,
    EVENT_PAGE_UP,
    EVENT_PAGE_DOWN,
    EVENT_HOME,
    EVENT_ENTER,
    EVENT_ESCAPE
} event_key;

typedef enum event_button {
    EVENT_BUTTON_LEFT,
    EVENT_BUTTON_RIGHT,
    EVENT_BUTTON_MIDDLE
} event_button;

typedef struct event {
    event_kind kind;
    unsigned
        key; /* EVENT_KEY: a Unicode character as the keyboard's layout gives it, or an event_key */
    bool shift, control, alt; /* EVENT_KEY without a character, EVENT_PRESS */
    event_button button;
    double x, y;   /* pixels from the top left corner: all but EVENT_KEY, EVENT_CLOSE */
    double amount; /* EVENT_SCROLL: notches, up is positive */
} event;

#endif
