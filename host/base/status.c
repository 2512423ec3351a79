#include "base/status.h"

#include "base/terminal_text.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE_SIZE = 65536 };

static _Thread_local char message[MESSAGE_SIZE];
static _Thread_local size_t kept_length;
static _Thread_local char warnings[2][MESSAGE_SIZE];
static _Thread_local int warnings_now;

status status_set(status code, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(message + kept_length, sizeof message - kept_length, format, arguments);
    va_end(arguments);
    terminal_text_clean(message + kept_length);
    return code;
}

const char *status_message(void)
{
    return message;
}

const char *status_last(void)
{
    return message + kept_length;
}

status status_keep(status code)
{
    const size_t length = strlen(message);

    if (length > kept_length && length + 2 < sizeof message) {
        message[length] = '\n';
        message[length + 1] = '\0';
        kept_length = length + 1;
    }
    return code;
}

status status_finish(status code)
{
    if (kept_length > 0 && message[kept_length] == '\0') message[kept_length - 1] = '\0';
    kept_length = 0;
    return code;
}

void status_clear(void)
{
    message[0] = '\0';
    kept_length = 0;
}

void status_warn(const char *format, ...)
{
    char *text = warnings[warnings_now];
    const size_t length = strlen(text);
    va_list arguments;

    if (length + 2 >= sizeof warnings[0]) return;
    va_start(arguments, format);
    vsnprintf(text + length, sizeof warnings[0] - length - 1, format, arguments);
    va_end(arguments);
    terminal_text_clean(text + length);
    strcat(text, "\n");
}

const char *status_warnings(void)
{
    const char *text = warnings[warnings_now];

    warnings_now = !warnings_now;
    warnings[warnings_now][0] = '\0';
    return text;
}

const char *status_warnings_so_far(void)
{
    return warnings[warnings_now];
}

status_record status_record_take(status rc)
{
    return (status_record){.rc = rc,
                           .message = rc == STATUS_OK ? NULL : strdup(message),
                           .warnings = strdup(status_warnings())};
}

/* Whether a text has a line, of `length` bytes. */
static bool has_line(const char *text, const char *line, size_t length)
{
    for (; *text; text += strcspn(text, "\n") + 1)
        if (!strncmp(text, line, length) && text[length] == '\n') return true;
    return false;
}

status status_record_tell(const status_record *record)
{
    size_t length;

    for (const char *at = record->warnings ? record->warnings : ""; *at; at += length + 1) {
        length = strcspn(at, "\n");
        if (!has_line(status_warnings_so_far(), at, length)) status_warn("%.*s", (int)length, at);
    }
    if (record->rc == STATUS_OK) return STATUS_OK;
    return status_set(record->rc, "%s", record->message ? record->message : "no memory");
}

void status_record_free(status_record *record)
{
    free(record->message);
    free(record->warnings);
    *record = (status_record){0};
}
