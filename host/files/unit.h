/* Unit: units of measured quantities, in the spellings that files have. */
#ifndef UNIT_H
#define UNIT_H

typedef struct unit {
    const char *name;     /* as messages have it */
    const char *quantity; /* units of one quantity convert into each other */
    double scale, offset; /* SI = scale x value + offset; wavelengths in um, wavenumbers in cm-1 */
} unit;

/* Finds a unit of a quantity (NULL: of any) by any spelling: with or without a degree sign, `deg`, blanks, `^`, `*` and superscripts,
 * with `/`, `per` or negative exponents: C, degC, Celsius; W/m2, W m-2, w/m^2; %, percent. Sums and
 * depths (Wh/m2, J/m2, mm) are those of an hour. Returns NULL for other texts. */
const unit *unit_find(const char *text, const char *quantity);

#endif
