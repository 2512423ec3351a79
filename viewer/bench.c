#include "bench.h"

#include "base/clock.h"
#include "base/interrupt.h"
#include "motion.h"

static const double orbit_s = 5.0, orbit_deg = 0.5;

/* Steps until a frame of the last wish is drawn. */
static status draw_next(preview *p, bool is_exact)
{
    status rc = STATUS_OK;
    bool drew = false;
    event unused;

    while (!p->live || p->live->wish != p->wished || (is_exact && !p->live->is_exact)) {
        TRY(interrupt_check());
        TRY(preview_step(p, &drew));
        NEED(!p->state.error[0], STATUS_DEVICE, "%s", p->state.error);
        if (!drew) p->s->take(p->s, &unused, 0.001);
    }
out:
    return rc;
}

status bench_run(preview *p, double start_s, FILE *to)
{
    status rc = STATUS_OK;
    int frames = 0;

    TRY(draw_next(p, false));
    fprintf(to, "first picture after %.2f s\n", clock_now_s() - start_s);
    TRY(draw_next(p, true));
    fprintf(to, "first exact picture after %.2f s, %d x %d\n", clock_now_s() - start_s,
            p->live->camera.columns, p->live->camera.rows);
    const double begin_s = clock_now_s();
    p->wish.has_camera = true;
    for (; clock_now_s() < begin_s + orbit_s; frames++) {
        motion_orbit(&p->camera, orbit_deg, 0.0);
        preview_ask(p);
        TRY(draw_next(p, false));
    }
    fprintf(to, "moving: %.1f pictures a second, %d x %d\n", frames / (clock_now_s() - begin_s),
            p->live->camera.columns, p->live->camera.rows);
    const double rest_s = clock_now_s();
    TRY(draw_next(p, true));
    fprintf(to, "exact %.2f s after rest\n", clock_now_s() - rest_s);
out:
    return rc;
}
