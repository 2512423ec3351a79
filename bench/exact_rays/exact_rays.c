/* Exact rays: radsig's rays against a search in double precision over all triangles.
 *   exact-rays RAYS MESH...     as many random rays into each mesh, 1,000 into large ones
 * Exit code 1 where they differ by more than the rounding of single precision explains. */
#include "bench_mesh.h"
#include "brute_force.h"
#include "mesh/facet_range.h"
#include "rays/ray_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Facets of a large mesh, and rays into it. */
enum { LARGE = 80000, RAYS_INTO_LARGE = 1000 };

/* Ranges within this fraction of the distance are a tie, and so is passing an edge this near. */
static const double tie = 1e-6, range_tolerance = 2e-5;

typedef struct answers {
    float *range;
    uint32_t *facet;
    uint8_t *met;
} answers;

typedef struct tally {
    uint32_t hits, edges, ties, wrong;
    double worst_range; /* relative */
} tally;

static double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 40) * 0x1p-24;
}

/* Rays from anywhere in the box of the mesh, a tenth wider, to anywhere in the box. */
static void make_rays(float *rays, uint32_t count, const bench_mesh *mesh)
{
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    uint64_t state = 1;

    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], mesh->position[i][k]);
            high[k] = fmaxf(high[k], mesh->position[i][k]);
        }
    for (int k = 0; k < 3 && mesh->reach_m > 0; k++) {
        const float middle = .5f * (low[k] + high[k]);
        low[k] = fmaxf(low[k], middle - mesh->reach_m);
        high[k] = fminf(high[k], middle + mesh->reach_m);
    }
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            const double size = (double)high[k] - (double)low[k];
            const double from = (double)low[k] + size * (1.2 * random_share(&state) - .1);
            const double to = (double)low[k] + size * random_share(&state);
            rays[(size_t)k * count + i] = (float)from;
            rays[(size_t)(3 + k) * count + i] = (float)(to - from);
        }
}

static status trace(const bvh_source *source, const float *rays, uint32_t count, const answers *out)
{
    status rc = STATUS_OK;
    bvh *tree = NULL;
    device *dev = NULL;
    ray_scene *scene = NULL;
    float_buffer ray = {0}, range = {0};
    uint_buffer facet = {0};
    uchar_buffer met = {0};

    TRY(bvh_build(&tree, source));
    TRY(device_open(&dev, -1));
    TRY(ray_scene_open(&scene, dev, &tree));
    TRY(device_allocate(dev, &ray, 6 * (size_t)count, rays));
    TRY(device_allocate(dev, &range, count, NULL));
    TRY(device_allocate(dev, &facet, count, NULL));
    TRY(device_allocate(dev, &met, count, NULL));
    TRY(ray_scene_trace(scene, count, count, ray, range, facet));
    TRY(ray_scene_occluded(scene, count, count, ray, met));
    TRY(device_download(dev, range, count, out->range));
    TRY(device_download(dev, facet, count, out->facet));
    TRY(device_download(dev, met, count, out->met));
out:
    device_release(met);
    device_release(facet);
    device_release(range);
    device_release(ray);
    ray_scene_free(scene);
    device_free(dev);
    bvh_free(tree);
    return rc;
}

/* Tells whether the ray passes the triangle's facet, widened by the tie, at about `range`. */
static bool is_within_tie(const bench_mesh *mesh, uint32_t facet, const double ray[6], double range)
{
    const double length = sqrt(ray[3] * ray[3] + ray[4] * ray[4] + ray[5] * ray[5]);
    bool is_near = false;

    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        double at;
        if (mesh->facet[t] != facet) continue;
        const double beside_m = brute_force_distance(mesh, t, ray, &at);
        is_near |= beside_m <= tie * at * length && (range < 0 || fabs(at - range) <= tie * range);
    }
    return is_near;
}

/* Adds one ray; `wrong` is what neither rounding nor ties explain. */
static void judge(tally *sum, const bench_mesh *mesh, const double ray[6], double range,
                  uint32_t triangle, double got_range, uint32_t got, bool got_bit)
{
    const uint32_t expected = triangle == UINT32_MAX ? RECORD_NONE : mesh->facet[triangle];

    sum->hits += expected != RECORD_NONE;
    sum->wrong += got_bit != (got != RECORD_NONE);
    if (got == expected) {
        if (expected == RECORD_NONE) return;
        const double error = fabs(got_range - range) / range;
        sum->worst_range = fmax(sum->worst_range, error);
        sum->wrong += error > range_tolerance;
    } else if (got != RECORD_NONE && is_within_tie(mesh, got, ray, range)) {
        sum->ties++;
    } else if (got != RECORD_NONE ? is_within_tie(mesh, got, ray, -1)
                                  : is_within_tie(mesh, expected, ray, range)) {
        sum->edges++;
    } else {
        sum->wrong++;
        printf(
            "  wrong: ray %.9g %.9g %.9g  %.9g %.9g %.9g: facet %d at %.9g, expected %d at %.9g\n",
            ray[0], ray[1], ray[2], ray[3], ray[4], ray[5], (int)got, got_range, (int)expected,
            range);
    }
}

static status reserve(answers *a, uint32_t count)
{
    status rc = STATUS_OK;

    a->range = malloc(count * sizeof *a->range);
    a->facet = malloc(count * sizeof *a->facet);
    a->met = malloc(count);
    NEED(a->range && a->facet && a->met, STATUS_MEMORY, "no memory for %u answers", count);
out:
    return rc;
}

static void release(answers *a)
{
    free(a->range);
    free(a->facet);
    free(a->met);
}

static status check(const char *name, uint32_t count, uint32_t *out_wrong)
{
    static const char *const lanes[] = {"16", "1"};
    status rc = STATUS_OK;
    bench_mesh *mesh = NULL;
    answers got = {0};
    double *range = NULL;
    float *rays = NULL;
    uint32_t *triangle = NULL;

    TRY(bench_mesh_make(&mesh, name));
    if (mesh->facet_count > LARGE && count > RAYS_INTO_LARGE) count = RAYS_INTO_LARGE;
    const bvh_source source = {.facet_count = mesh->facet_count,
                               .vertex_count = mesh->vertex_count,
                               .corner = (const uint32_t(*)[4])mesh->corner,
                               .position = (const float(*)[3])mesh->position};
    rays = malloc((size_t)count * sizeof(float[6]));
    range = malloc(count * sizeof *range);
    triangle = malloc(count * sizeof *triangle);
    NEED(rays && range && triangle, STATUS_MEMORY, "no memory for %u rays", count);
    TRY(reserve(&got, count));
    make_rays(rays, count, mesh);
    TRY(brute_force_trace(mesh, rays, count, range, triangle));
    for (int l = 0; l < 2; l++) {
        tally sum = {0};
        setenv("RADSIG_RAY_LANES", lanes[l], 1);
        TRY(trace(&source, rays, count, &got));
        for (uint32_t i = 0; i < count; i++) {
            double ray[6];
            for (int k = 0; k < 6; k++) ray[k] = (double)rays[(size_t)k * count + i];
            double got_range = (double)got.range[i];
            if (got.facet[i] != RECORD_NONE)
                got_range = facet_range(mesh->corner[got.facet[i]],
                                        (const float(*)[3])mesh->position, ray, got_range);
            judge(&sum, mesh, ray, range[i], triangle[i], got_range, got.facet[i], got.met[i]);
        }
        printf("%-18s %8u %7u %5s %7u %6u %6u %6u %9.1e\n", name, mesh->facet_count, count,
               lanes[l], sum.hits, sum.ties, sum.edges, sum.wrong, sum.worst_range);
        *out_wrong += sum.wrong;
    }
out:
    release(&got);
    free(triangle);
    free(range);
    free(rays);
    bench_mesh_free(mesh);
    return rc;
}

int main(int argc, char **argv)
{
    uint32_t wrong = 0;
    const long count = argc > 2 ? strtol(argv[1], NULL, 10) : 0;

    if (count < 1 || count > 10000000) {
        fputs("usage: exact-rays RAYS MESH...\n", stderr);
        return 2;
    }
    printf("%-18s %8s %7s %5s %7s %6s %6s %6s %9s\n", "mesh", "facets", "rays", "lanes", "hits",
           "ties", "edges", "wrong", "range by");
    for (int i = 2; i < argc; i++)
        if (check(argv[i], (uint32_t)count, &wrong) != STATUS_OK) {
            fprintf(stderr, "exact-rays: %s\n", status_message());
            return 1;
        }
    return wrong > 0;
}
