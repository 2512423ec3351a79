/* JSON text: strings and numbers of JSON documents (libjansson). */
#ifndef JSON_TEXT_H
#define JSON_TEXT_H

#include <jansson.h>

/* A string; what is not UTF-8 is taken for Latin-1, so that it stays readable. NULL becomes null.
 * Returns NULL if there is no memory; the caller owns the value. */
json_t *json_text(const char *text);

/* A number: an integer if it is whole, null if it is not finite.
 *   digits   raised until the number reads back as it is, 17 at most, for
 *            JSON_REAL_PRECISION; NULL: nobody asks */
json_t *json_text_number(double value, size_t *digits);

#endif
