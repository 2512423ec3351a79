#include "files/text_encoding.h"

#include "base/utf8_text.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Codes of the bytes 0x80 to 0x9f in Windows-1252; 0: none. */
static const uint16_t windows[32] = {
    0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178,
};

/* Writes a character of a code up to 0x10ffff; returns how many bytes, at most four. */
static size_t write_character(char *out, uint32_t code)
{
    static const uint32_t first[] = {0, 0, 0xc0, 0xe0, 0xf0};
    const size_t length = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;

    for (size_t i = length; i-- > 1; code >>= 6) out[i] = (char)(0x80 | (code & 0x3f));
    out[0] = (char)(first[length] | code);
    return length;
}

static uint32_t latin_code(unsigned char byte)
{
    if (byte >= 0xa0) return byte;
    return windows[byte - 0x80] ? windows[byte - 0x80] : 0xfffd;
}

/* Room for three bytes of each. */
static status from_latin(char **text, size_t *size)
{
    status rc = STATUS_OK;
    char *made = malloc(3 * *size + 1);
    size_t n = 0;

    NEED(made, STATUS_MEMORY, "no memory for a text of %zu bytes", *size);
    for (const char *c = *text, *end = c + *size; c < end;) {
        uint32_t code;
        const size_t length = utf8_text_character(c, &code);
        if (length > 0) memcpy(made + n, c, length);
        n += length > 0 ? length : write_character(made + n, latin_code((unsigned char)*c));
        c += length > 0 ? length : 1;
    }
    made[n] = '\0';
    free(*text);
    *text = made;
    *size = n;
out:
    return rc;
}

static uint32_t unit_at(const unsigned char *c, bool is_big)
{
    return is_big ? (uint32_t)c[0] << 8 | c[1] : (uint32_t)c[1] << 8 | c[0];
}

static status from_utf16(char **text, size_t *size, bool is_big)
{
    status rc = STATUS_OK;
    const unsigned char *c = (const unsigned char *)*text;
    char *made = malloc(2 * *size + 4);
    size_t n = 0;

    NEED(made, STATUS_MEMORY, "no memory for a text of %zu bytes", *size);
    for (size_t i = 2; i + 1 < *size; i += 2) {
        uint32_t code = unit_at(c + i, is_big);
        const uint32_t next = i + 3 < *size ? unit_at(c + i + 2, is_big) : 0;
        if (code >> 10 == 0x36 && next >> 10 == 0x37) {
            code = 0x10000 + ((code & 0x3ff) << 10 | (next & 0x3ff));
            i += 2;
        } else if (code >> 11 == 0x1b) {
            code = 0xfffd;
        }
        n += write_character(made + n, code);
    }
    made[n] = '\0';
    free(*text);
    *text = made;
    *size = n;
out:
    return rc;
}

status text_encoding_unify(char **text, size_t *size)
{
    status rc = STATUS_OK;

    if (*size >= 2 && (!memcmp(*text, "\xff\xfe", 2) || !memcmp(*text, "\xfe\xff", 2)))
        TRY(from_utf16(text, size, (*text)[0] == '\xfe'));
    if (strlen(*text) == *size && !utf8_text_is_valid(*text)) TRY(from_latin(text, size));
    if (!strncmp(*text, "\xef\xbb\xbf", 3)) {
        memmove(*text, *text + 3, *size - 2);
        *size -= 3;
    }
    for (char *c = strchr(*text, '\r'); c; c = strchr(c + 1, '\r'))
        if (c[1] != '\n') *c = '\n';
out:
    return rc;
}
