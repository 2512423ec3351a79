#include "base/terminal_text.h"

#include "base/utf8_text.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static bool is_control(uint32_t code)
{
    return (code < ' ' && code != '\t' && code != '\n') || (code >= 0x7f && code < 0xa0);
}

/* Length of what begins here and is not to be shown, 0 if it may be. */
static size_t hidden_length(const unsigned char *c, size_t *out_bytes)
{
    uint32_t code = 0;
    const size_t length = utf8_text_character((const char *)c, &code);

    *out_bytes = length > 0 ? length : 1;
    return length == 0 || is_control(code) ? *out_bytes : 0;
}

bool terminal_text_is_clean(const char *text)
{
    size_t bytes;

    for (const unsigned char *c = (const unsigned char *)text; *c; c += bytes)
        if (*c == '\n' || hidden_length(c, &bytes) > 0) return false;
    return true;
}

void terminal_text_clean(char *text)
{
    size_t bytes;

    for (unsigned char *c = (unsigned char *)text; *c; c += bytes)
        memset(c, '?', hidden_length(c, &bytes));
}

const char *terminal_text_copy(char *out, size_t size, const char *text)
{
    snprintf(out, size, "%s", text);
    terminal_text_clean(out);
    for (char *c = out; *c; c++)
        if (*c == '\n') *c = '?';
    return out;
}
