#include "kernels/records.h"

/* What falls on every detector: the picture's pixels, each with its weight; beyond its edges the
 * picture goes on as at them.
 * Launch: (record.columns, record.rows) detectors.
 * weight: shape (weight_rows, weight_columns), of the pixels from first_column, first_row on,
 *   counted from the detector's own first pixel
 * picture: those rows of its picture_rows that are needed, from `present` on, shape (.., picture_columns);
 * out: shape (rows, columns) */
kernel void blur(const blur_record record, global const float *weight, global const float *picture,
                 global float *out)
{
    const uint column = get_global_id(0), row = get_global_id(1);
    if (column >= record.columns || row >= record.rows) return;
    const int left = (int)(column * record.step) + record.first_column;
    const int top = (int)((record.first + row) * record.step) + record.first_row;
    float sum = 0.0f;

    for (int k = 0; k < (int)record.weight_rows; k++) {
        const int y = clamp(top + k, 0, (int)record.picture_rows - 1);
        global const float *line = picture + (size_t)(y - record.present) * record.picture_columns;
        global const float *fraction = weight + k * record.weight_columns;
        float line_sum = 0.0f;
        for (int i = 0; i < (int)record.weight_columns; i++)
            line_sum += fraction[i] * line[clamp(left + i, 0, (int)record.picture_columns - 1)];
        sum += line_sum;
    }
    out[(size_t)row * record.columns + column] = sum;
}
