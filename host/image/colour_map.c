#include "image/colour_map.h"

#include <math.h>

static double cut(double fraction)
{
    return fraction >= 0.0 ? (fraction <= 1.0 ? fraction : 1.0) : 0.0; /* NaN becomes 0 */
}

void colour_map_grey(double fraction, uint8_t out_rgb[3])
{
    for (int c = 0; c < 3; c++) out_rgb[c] = (uint8_t)(cut(fraction) * 255.0 + 0.5);
}

void colour_map_heat(double fraction, uint8_t out_rgb[3])
{
    enum { LAST = 32 };
    static const uint8_t point[LAST + 1][3] = {
        {0, 0, 4},       {4, 3, 18},      {11, 7, 36},    {21, 11, 55},   {33, 12, 74},
        {46, 10, 90},    {60, 9, 101},    {74, 12, 107},  {87, 16, 109},  {99, 20, 110},
        {112, 25, 110},  {125, 30, 109},  {137, 34, 106}, {150, 39, 102}, {163, 43, 97},
        {175, 49, 92},   {187, 55, 85},   {198, 62, 77},  {209, 70, 68},  {219, 79, 59},
        {227, 89, 50},   {235, 101, 40},  {241, 113, 30}, {246, 127, 20}, {249, 141, 10},
        {251, 156, 6},   {252, 171, 15},  {251, 186, 31}, {249, 202, 50}, {245, 217, 73},
        {242, 232, 101}, {243, 245, 134}, {252, 255, 164}};
    const double place = cut(fraction) * LAST;
    const int low = place < LAST ? (int)place : LAST - 1;

    for (int c = 0; c < 3; c++)
        out_rgb[c] =
            (uint8_t)(point[low][c] + (place - low) * (point[low + 1][c] - point[low][c]) + 0.5);
}

void colour_map_diverging(double fraction, uint8_t out_rgb[3])
{
    static const double blue[3] = {33, 102, 172}, white[3] = {247, 247, 247},
                        red[3] = {178, 24, 43};
    const double place = 2.0 * cut(fraction) - 1.0;
    const double *end = place < 0.0 ? blue : red;

    for (int c = 0; c < 3; c++)
        out_rgb[c] = (uint8_t)(white[c] + fabs(place) * (end[c] - white[c]) + 0.5);
}

/* A permutation of the 32-bit numbers: C. Wellons, lowbias32, public domain. */
static uint32_t scatter(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

void colour_map_id(uint32_t id, uint8_t out_rgb[3])
{
    const uint32_t bits = scatter(id + 1);

    for (int c = 0; c < 3; c++) out_rgb[c] = (uint8_t)(64 + ((bits >> (8 * c)) & 0xff) * 3 / 4);
}

void colour_map_category(uint32_t n, uint8_t out_rgb[3])
{
    enum { COUNT = 22 };
    /* Light blue, white and black come last: they are near no data, the margin and the text. */
    static const uint32_t kelly[COUNT] = {
        0xf3c300, 0x875692, 0xf38400, 0xbe0032, 0xc2b280, 0x848482, 0x008856, 0xe68fac,
        0x0067a5, 0xf99379, 0x604e97, 0xf6a600, 0xb3446c, 0xdcd300, 0x882d17, 0x8db600,
        0x654522, 0xe25822, 0x2b3d26, 0xa1caf1, 0xf2f3f4, 0x222222};

    if (n >= COUNT) {
        colour_map_id(n, out_rgb);
        return;
    }
    for (int c = 0; c < 3; c++) out_rgb[c] = (uint8_t)(kelly[n] >> (16 - 8 * c));
}
