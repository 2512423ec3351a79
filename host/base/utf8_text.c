#include "base/utf8_text.h"

#include <stdlib.h>
#include <string.h>

size_t utf8_text_character(const char *text, uint32_t *out_code)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char *c = (const unsigned char *)text;
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

bool utf8_text_is_valid(const char *text)
{
    uint32_t code;

    while (*text) {
        const size_t length = utf8_text_character(text, &code);
        if (length == 0) return false;
        text += length;
    }
    return true;
}

char *utf8_text_copy(const char *text)
{
    if (utf8_text_is_valid(text)) return strdup(text);
    char *out = malloc(2 * strlen(text) + 1), *at = out;
    if (!out) return NULL;
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c >= 0x80) *at++ = (char)(0xc0 | c >> 6);
        *at++ = (char)(c >= 0x80 ? 0x80 | (c & 0x3f) : c);
    }
    *at = '\0';
    return out;
}
