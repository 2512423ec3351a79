#include "base/terminal_text.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Bytes of the UTF-8 character that begins here, and its code; 0 if none does: RFC 3629. */
static size_t character_length(const unsigned char *c, uint32_t *out_code)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const size_t length = *c < 0x80        ? 1
                          : *c >> 5 == 6   ? 2
                          : *c >> 4 == 14  ? 3
                          : *c >> 3 == 30u ? 4
                                           : 0;
    uint32_t code = length == 1 ? *c : *c & (0x7fu >> length);

    for (size_t i = 1; i < length; i++) {
        if (c[i] >> 6 != 2) return 0;
        code = code << 6 | (c[i] & 0x3fu);
    }
    *out_code = code;
    return code >= least[length] && code <= 0x10ffff && code >> 11 != 0x1b ? length : 0;
}

static bool is_control(uint32_t code)
{
    return (code < ' ' && code != '\t' && code != '\n') || (code >= 0x7f && code < 0xa0);
}

/* Length of what begins here and is not to be shown, 0 if it may be. */
static size_t hidden_length(const unsigned char *c, size_t *out_bytes)
{
    uint32_t code = 0;
    const size_t length = character_length(c, &code);

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
