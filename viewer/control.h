/* Control: what keys and the pointer do. */
#ifndef CONTROL_H
#define CONTROL_H

#include "preview.h"

/* A line of the help: keys that belong together, and what they do. */
typedef struct control_key {
    const char *name, *purpose;
} control_key;

const control_key *control_keys(size_t *out_count);

/* Does what an event asks for. What cannot be done is told in the preview's note. */
void control_take(preview *p, const event *e);

#endif
