/* The most that each column changes over all rows.
 * Launch: (column_count). before, after: shape (row_count, column_count); out: (column_count). */
kernel void largest_change(const uint column_count, const uint row_count,
                           global const float *before, global const float *after, global float *out)
{
    const uint i = get_global_id(0);
    if (i >= column_count) return;
    float most = 0.0f;

    for (uint row = 0; row < row_count; row++) {
        const size_t place = (size_t)row * column_count + i;
        most = fmax(most, fabs(after[place] - before[place]));
    }
    out[i] = most;
}
