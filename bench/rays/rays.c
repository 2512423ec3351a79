/* The ray bench: radsig against Embree, the same rays in one process. See bench/README.md. */
#include "base/clock.h"
#include "bench_embree.h"
#include "bench_opencl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MODES = OPENCL_MODES + 2 * EMBREE_MODES, ROUNDS_LIMIT = 31 };

/* Below this fraction of its cores a run was kept waiting by other processes. */
static const double busy = .9;

/* One way to trace: modes of radsig, of Embree's robust scene, of its plain scene. */
typedef struct bench_mode {
    const char *side, *name;
    double wall_s[2][ROUNDS_LIMIT], cpu_s[2][ROUNDS_LIMIT]; /* on one core, on two */
} bench_mode;

/* Rays per second of CPU time on one core over terrains, the smallest and the largest. */
typedef struct bench_growth {
    const char *class_name;
    uint32_t facets[2];
    double radsig[2], embree[2]; /* packets; the best robust mode */
} bench_growth;

typedef struct bench {
    bench_mesh *mesh;
    bench_embree *embree[2]; /* robust, plain */
    bench_opencl *opencl;
    bvh *tree;
    bench_rays rays[BENCH_CLASSES];
    bench_met expected, met;
    bench_mode mode[MODES];
    int rounds, noisy, runs;
    FILE *csv;
    double log_best[2], log_prefilled[2]; /* sums over the cells, by wall and by CPU time */
    bench_growth growth[BENCH_CLASSES];
    double worst;
    int cells;
} bench;

static status trace(bench *b, int mode, int cores, const bench_rays *rays, double *wall_s,
                    double *cpu_s)
{
    const int e = mode - OPENCL_MODES;

    if (e < 0) return bench_opencl_trace(b->opencl, rays, mode, cores, &b->met, wall_s, cpu_s);
    return bench_embree_trace(b->embree[e / EMBREE_MODES], rays, e % EMBREE_MODES, cores, &b->met,
                              wall_s, cpu_s);
}

static void name_modes(bench *b)
{
    for (int m = 0; m < MODES; m++) {
        const int e = m - OPENCL_MODES;
        b->mode[m].side = e < 0 ? "radsig" : e < EMBREE_MODES ? "Embree robust" : "Embree";
        b->mode[m].name = e < 0 ? bench_opencl_modes[m] : bench_embree_modes[e % EMBREE_MODES];
    }
}

static status reserve(bench_met *out, uint32_t count)
{
    status rc = STATUS_OK;

    out->range = aligned_alloc(64, count * sizeof *out->range);
    out->triangle = aligned_alloc(64, count * sizeof *out->triangle);
    NEED(out->range && out->triangle, STATUS_MEMORY, "no memory for %u answers", count);
out:
    return rc;
}

static status prepare(bench *b, const char *name)
{
    status rc = STATUS_OK;
    double wall_s, cpu_s, robust_s, plain_s;
    const uint32_t most = 1 << 20;

    TRY(bench_mesh_make(&b->mesh, name));
    const bvh_source source = {.facet_count = b->mesh->facet_count,
                               .vertex_count = b->mesh->vertex_count,
                               .corner = (const uint32_t(*)[4])b->mesh->corner,
                               .position = (const float(*)[3])b->mesh->position};
    wall_s = clock_now_s();
    cpu_s = bench_cpu_s();
    TRY(bvh_build(&b->tree, &source));
    wall_s = clock_now_s() - wall_s;
    cpu_s = bench_cpu_s() - cpu_s;
    TRY(bench_embree_open(&b->embree[0], &robust_s, b->mesh, true));
    TRY(bench_embree_open(&b->embree[1], &plain_s, b->mesh, false));
    TRY(bench_opencl_open(&b->opencl, b->tree));
    printf("%s: %u facets, %u triangles; tree built in %.3f s (CPU %.3f s), Embree %.3f s\n", name,
           b->mesh->facet_count, b->mesh->triangle_count, wall_s, cpu_s, robust_s);
    TRY(reserve(&b->expected, most));
    TRY(reserve(&b->met, most));
    TRY(bench_rays_primary(&b->rays[0], b->mesh));
    TRY(bench_embree_trace(b->embree[0], &b->rays[0], 0, 2, &b->expected, &wall_s, &cpu_s));
    TRY(bench_rays_secondary(b->rays + 1, b->mesh, &b->rays[0], &b->expected));
out:
    return rc;
}

static void release(bench *b)
{
    for (int c = 0; c < BENCH_CLASSES; c++) bench_rays_free(&b->rays[c]);
    free(b->expected.range);
    free(b->expected.triangle);
    free(b->met.range);
    free(b->met.triangle);
    b->expected = b->met = (bench_met){0};
    bench_opencl_free(b->opencl);
    bench_embree_free(b->embree[0]);
    bench_embree_free(b->embree[1]);
    bvh_free(b->tree);
    bench_mesh_free(b->mesh);
    b->opencl = NULL;
    b->embree[0] = b->embree[1] = NULL;
    b->tree = NULL;
    b->mesh = NULL;
}

/* Counts the rays that radsig's packets answer otherwise than Embree's robust single rays: in hit or
 * miss, and by more than 1e-4 in range. */
static status compare(bench *b, const bench_rays *rays)
{
    status rc = STATUS_OK;
    double wall_s, cpu_s;
    uint32_t other = 0, farther = 0, met = 0;
    const bench_met *e = &b->expected;

    TRY(bench_embree_trace(b->embree[0], rays, 0, 2, e, &wall_s, &cpu_s));
    TRY(trace(b, OPENCL_PACKETS, 2, rays, &wall_s, &cpu_s));
    for (uint32_t i = 0; i < rays->count; i++) {
        const bool hit = rays->any_hit ? e->triangle[i] : isfinite(e->range[i]);
        const bool found = rays->any_hit ? b->met.triangle[i] : isfinite(b->met.range[i]);
        met += hit;
        other += hit != found;
        if (!rays->any_hit && hit && found)
            farther += fabsf(e->range[i] - b->met.range[i]) > 1e-4f * e->range[i];
    }
    printf("%s, %s: %u rays, %.1f %% meet something; %u differ in that, %u in range\n",
           b->mesh->name, rays->name, rays->count, 100.0 * met / rays->count, other, farther);
out:
    return rc;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return x < y ? -1 : x > y;
}

static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, by_size);
    return values[count / 2];
}

static status measure(bench *b, const bench_rays *rays)
{
    status rc = STATUS_OK;
    double wall_s, cpu_s;

    for (int m = 0; m < MODES; m++) TRY(trace(b, m, 2, rays, &wall_s, &cpu_s));
    for (int round = 0; round < b->rounds; round++)
        for (int cores = 1; cores <= 2; cores++)
            for (int m = 0; m < MODES; m++) {
                TRY(trace(b, m, cores, rays, &wall_s, &cpu_s));
                b->mode[m].wall_s[cores - 1][round] = wall_s;
                b->mode[m].cpu_s[cores - 1][round] = cpu_s;
                b->noisy += cpu_s < busy * cores * wall_s;
                b->runs++;
            }
out:
    return rc;
}

static void note_terrain(bench *b, const bench_rays *rays, double radsig, double embree)
{
    bench_growth *g = &b->growth[rays - b->rays];
    const uint32_t facets = b->mesh->facet_count;

    if (strncmp(b->mesh->name, "terrain-", 8)) return;
    for (int i = 0; i < 2; i++) {
        const bool is_beyond = i == 0 ? facets < g->facets[0] : facets > g->facets[1];
        if (g->facets[i] && !is_beyond) continue;
        g->class_name = rays->name;
        g->facets[i] = facets;
        g->radsig[i] = radsig;
        g->embree[i] = embree;
    }
}

static void print_growth(const bench *b)
{
    for (int c = 0; c < BENCH_CLASSES; c++) {
        const bench_growth *g = &b->growth[c];
        if (g->facets[0] == g->facets[1]) continue;
        printf("terrain of %u to %u facets, %s: the cost per ray grows %.2f times, Embree's %.2f "
               "times\n",
               g->facets[0], g->facets[1], g->class_name, g->radsig[0] / g->radsig[1],
               g->embree[0] / g->embree[1]);
    }
}

/* Prints the rays per second of all modes, and adds the cell to the verdict. */
static void report(bench *b, const bench_rays *rays)
{
    const double millions = rays->count / 1e6;
    double rate[MODES][2][2], best[2][2] = {{0}};

    for (int m = 0; m < MODES; m++)
        for (int cores = 0; cores < 2; cores++) {
            rate[m][cores][0] = millions / median(b->mode[m].wall_s[cores], b->rounds);
            rate[m][cores][1] = millions / median(b->mode[m].cpu_s[cores], b->rounds);
            fprintf(b->csv, "%s,%u,%s,%s,%s,%d,%.4f,%.4f\n", b->mesh->name, b->mesh->facet_count,
                    rays->name, b->mode[m].side, b->mode[m].name, cores + 1, rate[m][cores][0],
                    rate[m][cores][1]);
        }
    for (int m = OPENCL_MODES; m < OPENCL_MODES + EMBREE_MODES; m++)
        for (int i = 0; i < 4; i++)
            best[i / 2][i % 2] = fmax(best[i / 2][i % 2], rate[m][i / 2][i % 2]);
    printf("  %-14s %-17s %9s %9s %9s %9s   to Embree's robust best\n", "", "Mray/s", "1 core",
           "by CPU", "2 cores", "by CPU");
    for (int m = 0; m < MODES; m++)
        printf("  %-14s %-17s %9.2f %9.2f %9.2f %9.2f   %.2f %.2f\n", b->mode[m].side,
               b->mode[m].name, rate[m][0][0], rate[m][0][1], rate[m][1][0], rate[m][1][1],
               rate[m][0][0] / best[0][0], rate[m][0][1] / best[0][1]);
    for (int by = 0; by < 2; by++) {
        const double to_best = rate[OPENCL_PACKETS][0][by] / best[0][by];
        const double to_filled =
            rate[OPENCL_PACKETS][0][by] / rate[OPENCL_MODES + EMBREE_PREFILLED][0][by];
        b->log_best[by] += log(to_best);
        b->log_prefilled[by] += log(to_filled);
        if (by == 1) b->worst = fmin(b->worst, to_best);
    }
    b->cells++;
    note_terrain(b, rays, rate[OPENCL_PACKETS][0][1], best[0][1]);
}

static status run(bench *b, int mesh_count, char **mesh)
{
    status rc = STATUS_OK;

    for (int i = 0; i < mesh_count; i++) {
        TRY(prepare(b, mesh[i]));
        for (int c = 0; c < BENCH_CLASSES; c++) {
            TRY(compare(b, &b->rays[c]));
            TRY(measure(b, &b->rays[c]));
            report(b, &b->rays[c]);
            fflush(stdout);
        }
        release(b);
    }
    printf("packets on one core, geometric mean over %d cells, by wall and by CPU time:\n",
           b->cells);
    printf(
        "  to Embree's robust best %.2f %.2f (worst cell %.2f), to its prefilled single ray %.2f "
        "%.2f\n",
        exp(b->log_best[0] / b->cells), exp(b->log_best[1] / b->cells), b->worst,
        exp(b->log_prefilled[0] / b->cells), exp(b->log_prefilled[1] / b->cells));
    print_growth(b);
    if (b->noisy > b->runs / 10)
        printf("%d of %d runs were kept from their cores by other processes: the machine was too "
               "noisy for a verdict by wall time\n",
               b->noisy, b->runs);
out:
    release(b);
    return rc;
}

int main(int argc, char **argv)
{
    bench *b = calloc(1, sizeof *b);
    status rc = STATUS_MEMORY;

    if (argc < 4 || !b) {
        fprintf(stderr, "usage: bench-rays CSV ROUNDS MESH...\n");
        free(b);
        return 2;
    }
    b->rounds = atoi(argv[2]) < 1 ? 1 : atoi(argv[2]) > ROUNDS_LIMIT ? ROUNDS_LIMIT : atoi(argv[2]);
    b->worst = INFINITY;
    b->csv = fopen(argv[1], "w");
    name_modes(b);
    if (b->csv) {
        fprintf(b->csv, "mesh,facets,class,side,mode,cores,mray_s,mray_cpu_s\n");
        rc = run(b, argc - 3, argv + 3);
        fclose(b->csv);
    }
    if (rc != STATUS_OK) fprintf(stderr, "bench-rays: %s: %s\n", argv[1], status_message());
    free(b);
    return rc != STATUS_OK;
}
