#include "database_header.h"

#include "lowtran_source.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEGREE (M_PI / 180.0)

static const char quantities[] =
    "#\n"
    "# Lines that begin with # are skipped. Rows ascend in wavelength; the order of the lines is\n"
    "# that of Figure 2.4-3, after twelve grid values. Units: um, cm-1, degrees, km, K, W cm-2 "
    "um-1,\n"
    "# W cm-2 um-1, W cm-2 sr-1 um-1; of a .radc: W m-2 and m.\n"
    "#   E_S      sun outside the atmosphere, normal to the beam, at the distance of the day\n"
    "#   tau1     transmission from space to the ground towards the sun\n"
    "#   tau2     transmission from the ground to the sensor, by zenith angle at the ground\n"
    "#   LuE LuS  emitted by the path, sunlight scattered by it; nothing of the ground itself\n"
    "#   LDE LDS  the same of the sky seen from the ground, by zenith angle and azimuth clockwise\n"
    "#            from north; integrated: (1/pi) integral of L cos sin over the hemisphere\n";

static void write_site(FILE *stream, const database_plan *g, const run_list *r)
{
    const sun_position sun = run_list_sun(r);
    char time[SITE_TIME_SIZE];

    site_format_time(g->s->place.time_s, g->s->place.utc_offset_min, time);
    fprintf(stream,
            "# Radiance database of the scene %s (thesis Figure 2.4-3, Appendix A item 4).\n",
            g->s->name);
    fprintf(stream, "# %s, latitude %.6f, longitude %.6f (east-positive).\n", time,
            g->s->place.latitude_deg, g->s->place.longitude_deg);
    fprintf(stream,
            "# Sun: zenith angle %.4f, azimuth %.4f degrees clockwise from north (PSA, without\n"
            "# refraction)%s.\n",
            sun.zenith_rad / DEGREE, sun.azimuth_rad / DEGREE,
            run_list_is_night(r) ? "; it is down, so every solar term is 0" : "");
}

static void write_plan(FILE *stream, const atmosphere_plan *plan)
{
    fprintf(stream,
            "# The sensor stands %g m high at azimuth %.3f degrees, seen from the target.\n",
            plan->sensor_altitude_m, plan->sensor_azimuth_deg);
    fputs("# Ground albedo:", stream);
    for (int i = 0; i < plan->piece_count; i++) {
        fprintf(stream, " %g", plan->thesis ? 1.0 : plan->albedo[i]);
        if (i + 1 < plan->piece_count) fprintf(stream, " to %g um,", plan->edge_um[i]);
    }
    fputs(".\n", stream);
    if (plan->radiosonde)
        fprintf(stream, "# Profile of the radiosonde %s, above it LOWTRAN's model %d.\n",
                strrchr(plan->radiosonde, '/') ? strrchr(plan->radiosonde, '/') + 1
                                               : plan->radiosonde,
                plan->model);
    if (plan->inversion_altitude_m > 0.0)
        fprintf(stream,
                "# Below %g m the profile goes linearly to the hour's surface weather (thesis "
                "2.4.4).\n",
                plan->inversion_altitude_m);
}

static void write_method(FILE *stream, const atmosphere_plan *plan)
{
    if (plan->thesis)
        fputs(
            "# Mode thesis: as the deck of Appendix A item 2 (TBOUND 300, SALB 1, LOWTRAN's sun);\n"
            "# values at the row's wavenumber; the sky is integrated by rectangles, which makes "
            "an\n"
            "# isotropic sky of 15 degrees steps 2.3 % too low.\n",
            stream);
    else if (plan->wavenumber_step_cm1 > plan->sample_step_cm1)
        fprintf(stream,
                "# LOWTRAN every %g cm-1, averaged over %g cm-1 about the row's wavenumber by the\n"
                "# trapezoid rule. The sky's integral is exact for radiance that is linear in the\n"
                "# zenith angle between directions.\n",
                plan->sample_step_cm1, plan->wavenumber_step_cm1);
    fputs("# Known limits: LOWTRAN resolves 20 cm-1; its multiple scattering is a two-stream "
          "estimate,\n"
          "# 11 to 18 % low; between the angles of the tables the reader interpolates linearly.\n",
          stream);
}

static void write_lines(FILE *stream, const char *text)
{
    for (; *text; text += strcspn(text, "\n") + 1)
        fprintf(stream, "#    %.*s\n", (int)strcspn(text, "\n"), text);
}

/* Every card: the first deck of a family whole, of the others the lines that differ from it. */
static void write_decks(FILE *stream, const run_list *r)
{
    const char *const *decks = run_list_decks(r), *const *names = run_list_names(r);
    size_t whole = 0;

    fputs(DATABASE_HEADER_CARDS
          "; below the first of its kind, a deck's lines that differ from it.\n",
          stream);
    for (size_t i = 0; i < run_list_count(r); i++) {
        const char *line = decks[i], *model = decks[whole];
        fprintf(stream, "#  %s\n", names[i]);
        if (i == 0 || strncmp(names[whole], names[i], 2) != 0) {
            write_lines(stream, line);
            whole = i;
            continue;
        }
        while (*line && *model) {
            const size_t length = strcspn(line, "\n"), other = strcspn(model, "\n");
            if (length != other || strncmp(line, model, length) != 0)
                fprintf(stream, "#    %.*s\n", (int)length, line);
            line += length + 1;
            model += other + 1;
        }
    }
}

status database_header(char **out, const database_plan *g, const run_list *r)
{
    status rc = STATUS_OK;
    char *text = NULL;
    size_t length;
    FILE *stream = open_memstream(&text, &length);

    NEED(stream, STATUS_MEMORY, "no memory for the header of a radiance database");
    write_site(stream, g, r);
    write_plan(stream, &g->plan);
    fputs(quantities, stream);
    write_method(stream, &g->plan);
    fputs("#\n" LOWTRAN_SOURCE_HEADER, stream);
    write_decks(stream, r);
    NEED(fclose(stream) == 0, STATUS_MEMORY, "no memory for the header of a radiance database");
    *out = text;
out:
    return rc;
}
