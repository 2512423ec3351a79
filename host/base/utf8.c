#include "base/utf8.h"

size_t utf8_length(const char *text, uint32_t *out_code)
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

size_t utf8_write(char *out, uint32_t code)
{
    static const uint32_t first[] = {0, 0, 0xc0, 0xe0, 0xf0};
    const size_t length = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;

    for (size_t i = length; i-- > 1; code >>= 6) out[i] = (char)(0x80 | (code & 0x3f));
    out[0] = (char)(first[length] | code);
    return length;
}
