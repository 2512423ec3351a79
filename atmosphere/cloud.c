#include "cloud.h"

#include "deck_text.h"
#include "files/output_file.h"
#include "lowtran.h"
#include "lowtran_source.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const cloud_model cloud_models[CLOUD_COUNT] = {{"cumulus", 1, .66, 3.0},
                                               {"altostratus", 2, 2.4, 3.0},
                                               {"stratus", 3, .33, 1.0},
                                               {"stratocumulus", 4, .66, 2.0},
                                               {"nimbostratus", 5, .16, .66}};

/* Paths: one clear and one cloudy at each altitude, then a look at the sun. */
enum {
    ALTITUDES = 50,
    RUNS = 2 * ALTITUDES + 1,
    TABLE = 47,
    BEFORE_CLOUDS = 48 + 18,
    NAME_SIZE = 16
};

#define PATH_KM .02
#define PER_KM 1e-3 /* per metre */
#define FIRST_BROAD_CM1 4000.0
#define LAST_BROAD_CM1 25000.0 /* 2.5 to 0.4 um */

/* LOWTRAN's tables over wavelength; for each cloud extinction and absorption, relative to the
 * extinction at 0.55 um, and asymmetry. */
extern struct {
    float wavelength_um[TABLE], others[BEFORE_CLOUDS][TABLE], cloud[CLOUD_COUNT][3][TABLE];
} extd_;

/* Transmissions, and the sun, at ascending wavenumbers. */
typedef struct paths {
    double tau[2 * ALTITUDES][WAVENUMBER_ROWS];
    double sun[WAVENUMBER_ROWS];
} paths;

static status take(void *receiver, size_t index, const lowtran_run *run)
{
    status rc = STATUS_OK;
    paths *p = receiver;

    NEED(run->point_count == WAVENUMBER_ROWS, STATUS_FORMAT, "LOWTRAN gave %d points, expected %d",
         run->point_count, WAVENUMBER_ROWS);
    for (int i = 0; i < WAVENUMBER_ROWS; i++) {
        if (index < 2 * ALTITUDES)
            p->tau[index][i] = (double)run->tau[i];
        else
            p->sun[i] = (double)run->irradiance[i];
    }
out:
    return rc;
}

/* Run 2 k is clear, 2 k + 1 cloudy at the middle of slice k. */
static status write_deck(char **out, const cloud_model *model, int run)
{
    const double fraction = (run / 2 + .5) / ALTITUDES;
    card_deck deck = {.model = 2, .itype = 1, .noprt = 1, .ihaze = 1, .icstl = 1, .dv_cm1 = 100.0};

    deck.v1_cm1 = WAVENUMBER_ROWS_FIRST_CM1 - (WAVENUMBER_ROWS - 1) * WAVENUMBER_ROWS_STEP_CM1;
    deck.v2_cm1 = WAVENUMBER_ROWS_FIRST_CM1;
    if (run == 2 * ALTITUDES) {
        deck.itype = 3;
        deck.iemsct = 3;
        deck.iday = 94; /* the sun at its mean distance */
        return deck_text(out, &deck, "", "");
    }
    deck.icld = run % 2 ? model->icld : 0;
    deck.h1_km = model->base_km + fraction * (model->top_km - model->base_km);
    deck.range_km = PATH_KM;
    return deck_text(out, &deck, "", "");
}

static status run_paths(paths *p, const cloud_model *model)
{
    status rc = STATUS_OK;
    char *decks[RUNS] = {NULL}, names[RUNS][NAME_SIZE];
    const char *name[RUNS];

    for (int i = 0; i < RUNS; i++) {
        snprintf(names[i], NAME_SIZE, "run %d", i);
        name[i] = names[i];
        TRY(write_deck(&decks[i], model, i));
    }
    TRY(lowtran_run_decks((const char *const *)decks, name, RUNS, take, p));
out:
    for (int i = 0; i < RUNS; i++) free(decks[i]);
    return rc;
}

/* Linear in wavelength, as LOWTRAN reads its tables. */
static double look_up(const float *table, double wavelength_um)
{
    int i = 1;

    while (i + 1 < TABLE && (double)extd_.wavelength_um[i] < wavelength_um) i++;
    const double low = (double)extd_.wavelength_um[i - 1], high = (double)extd_.wavelength_um[i];
    const double fraction = (wavelength_um - low) / (high - low);
    return (double)table[i - 1] + fraction * ((double)table[i] - (double)table[i - 1]);
}

/* Eq. 2.4.3-2 and -4, and the mean over the layer. Rows of the file descend in wavenumber. */
static void set_extinction(cloud *c, const paths *p)
{
    double sum = 0.0, weight = 0.0;

    for (int i = 0; i < WAVENUMBER_ROWS; i++) {
        const int from = WAVENUMBER_ROWS - 1 - i;
        const double wavenumber = WAVENUMBER_ROWS_FIRST_CM1 - i * WAVENUMBER_ROWS_STEP_CM1;
        double total = 0.0;
        for (int k = 0; k < ALTITUDES; k++)
            total -= log(p->tau[2 * k + 1][from] / p->tau[2 * k][from]) / PATH_KM;
        c->per_m[i] = fmax(0.0, total / ALTITUDES) * PER_KM;
        if (wavenumber < FIRST_BROAD_CM1 || wavenumber > LAST_BROAD_CM1) continue;
        /* Irradiance is per um: per wavenumber it has the square of the wavelength. */
        const double fraction = p->sun[from] / (wavenumber * wavenumber);
        sum += fraction * c->per_m[i];
        weight += fraction;
    }
    c->broad_band_per_m = sum / weight;
}

static void set_scattering(cloud *c, const cloud_model *model)
{
    const float(*const table)[TABLE] = extd_.cloud[model->icld - 1];

    for (int i = 0; i < WAVENUMBER_ROWS; i++) {
        const double um = 1e4 / (WAVENUMBER_ROWS_FIRST_CM1 - i * WAVENUMBER_ROWS_STEP_CM1);
        c->albedo[i] = 1.0 - look_up(table[1], um) / look_up(table[0], um);
        c->asymmetry[i] = look_up(table[2], um);
    }
}

static status check(const paths *p, const cloud_model *model)
{
    status rc = STATUS_OK;

    for (int k = 0; k < 2 * ALTITUDES; k++)
        for (int i = 0; i < WAVENUMBER_ROWS; i++)
            NEED(p->tau[k][i] > 0.0, STATUS_FORMAT, "%s: LOWTRAN's path number %d is opaque",
                 model->name, k);
out:
    return rc;
}

status cloud_compute(cloud **out, const cloud_model *model)
{
    status rc = STATUS_OK;
    paths *p = malloc(sizeof *p);
    cloud *c = calloc(1, sizeof *c);

    NEED(p && c, STATUS_MEMORY, "no memory for the spectra of a cloud");
    TRY(run_paths(p, model));
    TRY(check(p, model));
    set_extinction(c, p);
    set_scattering(c, model);
    *out = c;
    c = NULL;
out:
    cloud_free(c);
    free(p);
    return rc;
}

void cloud_free(cloud *c)
{
    free(c);
}

status cloud_write_extinction(const cloud *c, const cloud_model *model, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    FILE *stream = output_file_stream(file);
    fprintf(stream,
            "# Extinction of LOWTRAN 7's cloud %s, %g to %g km, per km: mean over the layer from "
            "level\n# paths of 20 m every 2 %% of it, mid-latitude summer, rural aerosol (thesis "
            "2.4.3, Appendix B).\n"
            "# First the mean over .4 to 2.5 um weighted by the sun, then wavenumber, extinction.\n"
            "# radsig-atmosphere cloud %s\n" LOWTRAN_SOURCE_HEADER,
            model->name, model->base_km, model->top_km, model->name);
    fprintf(stream, "%.6f\n", c->broad_band_per_m / PER_KM);
    for (int i = 0; i < WAVENUMBER_ROWS; i++)
        fprintf(stream, "%d %.6f\n", WAVENUMBER_ROWS_FIRST_CM1 - i * WAVENUMBER_ROWS_STEP_CM1,
                c->per_m[i] / PER_KM);
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

status cloud_write_scattering(const cloud *c, const cloud_model *model, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    FILE *stream = output_file_stream(file);
    fprintf(stream,
            "# Scattering of LOWTRAN 7's cloud %s, from its tables.\n" LOWTRAN_SOURCE_HEADER,
            model->name);
    fputs("wavenumber_cm1,single_scattering_albedo,asymmetry\n", stream);
    for (int i = 0; i < WAVENUMBER_ROWS; i++)
        fprintf(stream, "%d,%.6f,%.6f\n", WAVENUMBER_ROWS_FIRST_CM1 - i * WAVENUMBER_ROWS_STEP_CM1,
                c->albedo[i], c->asymmetry[i]);
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}
