#include "mesh/facet_sample.h"

#include "mesh/polygon.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { LEVEL_MOST = 3, POINTS_EACH = 2, POINTS_LEAST = 1 << 16 };

/* Exponents of areas; 0 and what is not finite have the least. */
enum { EXPONENT_LEAST = -127, EXPONENTS = 256 };

/* Weights of the corners of a triangle: of its middle, and of two points of it. */
static const double middle[1][3] = {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
static const double halves[2][3] = {{1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0},
                                    {1.0 / 2.0, 1.0 / 6.0, 1.0 / 3.0}};

/* What is set in each of the smallest parts. */
typedef struct pattern {
    int count;
    const double (*weight)[3];
} pattern;

static hit_record *set_points(hit_record *out, const double p[3][3], pattern each)
{
    for (int i = 0; i < each.count; i++)
        for (int k = 0; k < 3; k++) {
            double sum = 0.0;
            for (int v = 0; v < 3; v++) sum += each.weight[i][v] * p[v][k];
            out[i].point[k] = (float)sum;
        }
    return out + each.count;
}

/* Cuts a triangle into quarters over and over. Returns behind the last point. */
static hit_record *spread(hit_record *out, const double p[3][3], int depth, pattern each)
{
    double half[3][3];

    if (depth == 0) return set_points(out, p, each);
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) half[v][k] = .5 * (p[v][k] + p[(v + 1) % 3][k]);
    out = spread(out, (const double(*)[3])half, depth - 1, each);
    for (int v = 0; v < 3; v++) {
        double corner[3][3];
        memcpy(corner[0], p[v], sizeof corner[0]);
        memcpy(corner[1], half[v], sizeof corner[1]);
        memcpy(corner[2], half[(v + 2) % 3], sizeof corner[2]);
        out = spread(out, (const double(*)[3])corner, depth - 1, each);
    }
    return out;
}

static hit_record *spread_corners(hit_record *out, const geometry *g, const uint32_t corner[3],
                                  int depth, pattern each)
{
    double p[3][3];

    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) p[v][k] = (double)g->position[corner[v]][k];
    return spread(out, (const double(*)[3])p, depth, each);
}

/* A quad has one point beside the middle of its diagonal, which rays from there should not run along. */
static void spread_quad(hit_record *out, const geometry *g, const uint32_t *c, int level)
{
    static const double beside[1][3] = {{.48, .04, .48}};
    const uint32_t d = polygon_diagonal(c, (const float(*)[3])g->position);
    const uint32_t first[3] = {c[d], c[d + 1], c[d + 2]};
    const uint32_t second[3] = {c[d], c[d + 2], c[(d + 3) % 4]};
    const pattern two = {2, halves}, one = {1, beside};

    if (level == 0) {
        spread_corners(out, g, first, 0, one);
        return;
    }
    out = spread_corners(out, g, first, level - 1, two);
    spread_corners(out, g, second, level - 1, two);
}

void facet_sample(hit_record *out, const geometry *g, uint32_t facet, uint8_t level)
{
    const uint32_t *c = g->corner[facet];
    const pattern one = {1, middle};

    for (uint32_t i = 0; i < facet_sample_count(level); i++) {
        out[i] = (hit_record){.facet = facet};
        memcpy(out[i].normal, g->normal[facet], sizeof out[i].normal);
    }
    if (c[3] == UINT32_MAX)
        spread_corners(out, g, c, level, one);
    else
        spread_quad(out, g, c, level);
}

static int exponent_of(float area_m2)
{
    const bool has_area = isfinite(area_m2) && area_m2 > 0.0f;

    return has_area ? (int)fmax(ilogb((double)area_m2), EXPONENT_LEAST) : EXPONENT_LEAST;
}

/* Facets have four points from areas of 2^lowest on, and four times as many from four times as much. */
static uint8_t level_of(int exponent, int lowest)
{
    const int level = exponent < lowest ? 0 : 1 + (exponent - lowest) / 2;

    return (uint8_t)(level < LEVEL_MOST ? level : LEVEL_MOST);
}

/* Points that facets have together.
 *   facets   shape (EXPONENTS): how many have an area of that exponent */
static uint64_t count_points(const uint32_t *facets, int lowest)
{
    uint64_t points = 0;

    for (int e = 0; e < EXPONENTS; e++)
        points += (uint64_t)facets[e] * facet_sample_count(level_of(e + EXPONENT_LEAST, lowest));
    return points;
}

void facet_sample_levels(uint8_t *out_level, const float *area_m2, uint32_t count)
{
    const uint64_t each = (uint64_t)count * POINTS_EACH;
    const uint64_t most = each > POINTS_LEAST ? each : POINTS_LEAST;
    uint32_t facets[EXPONENTS] = {0};
    int lowest = EXPONENT_LEAST;

    for (uint32_t i = 0; i < count; i++) facets[exponent_of(area_m2[i]) - EXPONENT_LEAST]++;
    while (count_points(facets, lowest) > most) lowest++;
    for (uint32_t i = 0; i < count; i++) out_level[i] = level_of(exponent_of(area_m2[i]), lowest);
}
