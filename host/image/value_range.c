#include "image/value_range.h"

#include "base/interrupt.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HALF = 1 << 16 };

static bool is_valid(float value, float no_data)
{
    return isfinite(value) && value != no_data;
}

/* Numbers in the order of the floats they stand for. */
static uint32_t key_of(float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    return bits >> 31 ? ~bits : bits | 0x80000000u;
}

static float value_of(uint32_t key)
{
    const uint32_t bits = key >> 31 ? key & 0x7fffffffu : ~key;
    float value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The bin that holds the rank-th of what was counted; lowers the rank to that within the bin. */
static uint32_t find_bin(const size_t *bin, size_t *rank)
{
    uint32_t i = 0;

    for (; *rank >= bin[i]; i++) *rank -= bin[i];
    return i;
}

/* Values that are looked at between two looks at the interrupt. */
enum { PORTION = 1 << 20 };

typedef struct values {
    const float *value; /* shape (count) */
    size_t count;
    float no_data;
} values;

/* Counts the lower halves of the valid values whose upper half is `upper`, or of all the upper halves.
 *   upper     HALF: of all
 *   out_bin   shape (HALF) */
static status count_halves(size_t *out_bin, const values *v, uint32_t upper)
{
    status rc = STATUS_OK;

    memset(out_bin, 0, HALF * sizeof *out_bin);
    for (size_t i = 0; i < v->count; i++) {
        if (i % PORTION == 0) TRY(interrupt_check());
        if (!is_valid(v->value[i], v->no_data)) continue;
        const uint32_t key = key_of(v->value[i]);
        if (upper == HALF)
            out_bin[key >> 16]++;
        else if (key >> 16 == upper)
            out_bin[key & (HALF - 1)]++;
    }
out:
    return rc;
}

/* The rank-th smallest valid value, by counting its upper and then its lower half. */
static status select_rank(double *out, const values *v, size_t rank, size_t *bin)
{
    status rc = STATUS_OK;

    TRY(count_halves(bin, v, HALF));
    const uint32_t upper = find_bin(bin, &rank);
    TRY(count_halves(bin, v, upper));
    *out = (double)value_of(upper << 16 | find_bin(bin, &rank));
out:
    return rc;
}

static status count_valid(size_t *out, const values *v)
{
    status rc = STATUS_OK;

    for (size_t i = 0; i < v->count; i++) {
        if (i % PORTION == 0) TRY(interrupt_check());
        *out += is_valid(v->value[i], v->no_data);
    }
out:
    return rc;
}

status value_range_find(value_range *out, const float *value, size_t count, float no_data)
{
    status rc = STATUS_OK;
    value_range range = {.min = 0.0, .max = 1.0};
    const values v = {value, count, no_data};
    size_t *bin = malloc(HALF * sizeof *bin);

    NEED(bin, STATUS_MEMORY, "no memory for the range of a plane");
    TRY(count_valid(&range.valid_count, &v));
    range.missing_count = count - range.valid_count;
    if (range.valid_count) {
        const size_t last = range.valid_count - 1;
        TRY(select_rank(&range.min, &v, (size_t)round(0.005 * last), bin));
        TRY(select_rank(&range.max, &v, (size_t)round(0.995 * last), bin));
        const double largest = fmax(fabs(range.min), fabs(range.max));
        if (range.max - range.min <= 1e-6 * largest) { /* no more than float32's rounding */
            const double width = largest > 0.0 ? 0.01 * largest : 0.5;
            range.min -= width;
            range.max += width;
        }
    }
    *out = range;
out:
    free(bin);
    return rc;
}

double value_range_step(double least)
{
    const double power = pow(10.0, floor(log10(least)));
    const double ratio = least / power * (1.0 - 1e-12); /* 0.2 / 0.1 may round up */

    return power * (ratio <= 1.0 ? 1.0 : ratio <= 2.0 ? 2.0 : ratio <= 5.0 ? 5.0 : 10.0);
}

size_t value_range_ticks(const value_range *range, double step, double *out)
{
    const double first = ceil(range->min / step - 1e-9), span = range->max - range->min;
    size_t count = 0;

    /* Counted: beyond 2^53 a number plus 1 is the same number. */
    while (count < VALUE_RANGE_TICKS) {
        const double tick = (first + (double)count) * step;
        if (!((tick - range->min) / span <= 1.0 + 1e-9)) break;
        out[count++] = tick;
    }
    return count;
}

void value_range_label(char *out, size_t size, double value, double step)
{
    const int decimals = (int)fmax(0.0, -floor(log10(step) + 1e-9));

    if (fabs(value) < 0.5 * step) value = 0.0; /* no "-0" */
    if (fabs(value) < 1e7 && decimals <= 6)
        snprintf(out, size, "%.*f", decimals, value);
    else
        snprintf(out, size, "%.3g", value);
}
