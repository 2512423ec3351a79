/* radsig-lowtran: runs one deck through LOWTRAN 7, for radsig-atmosphere. Of libraries it needs only
 * Fortran's, so that it starts in a millisecond; LOWTRAN keeps its state in static storage, so it
 * runs one deck and ends.
 *   radsig-lowtran FOLDER   the folder holds the deck TAPE5 and empty out/TAPE6, out/TAPE7 and
 *                           out/TAPE8; the result comes as the file of lowtran_sheet.h */
#include "lowtran_sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* The longest deck takes seconds of a processor, which may be shared by many. */
enum { PROCESSOR_S = 60, PATIENCE_S = 600, COLUMNS = 63 };

/* lowtran7.f; the names of its arguments and common blocks are its own. */
extern void lwtrn7_(const int *python, const int *nwl, const float *v1, const float *v2,
                    const float *dv, float *tx, float *v, float *alam, float *trace, float *unif,
                    float *suma, float *irrad, float *sumvv, const int *model, const int *itype,
                    const int *iemsct, const int *im, const int *iseasn, const int *ml,
                    const int *ird1, const float *zmdl, const float *p, const float *t,
                    const float *wmol, const float *h1, const float *h2, const float *angle,
                    const float *range);
extern struct {
    float h1, h2, angle, range, beta, re;
    int len;
} card3_;
extern struct {
    float v1, v2, dv;
} card4_;
extern struct {
    float zm[LOWTRAN_LEVELS], pm[LOWTRAN_LEVELS], tm[LOWTRAN_LEVELS];
} model_;
extern struct {
    int kmax, m, ikmax, nl, ml, iklo, issgeo, imult;
} cntrl_;

static lowtran_sheet sheet;
static float transmissions[COLUMNS][LOWTRAN_POINTS], unused[4][LOWTRAN_POINTS];

/* All that LOWTRAN reads is in the deck, so the other arguments are zero. */
static void run_deck(void)
{
    const int no = 0, points = LOWTRAN_POINTS;
    const float zero = 0.0f, empty[COLUMNS] = {0.0f};

    lwtrn7_(&no, &points, &zero, &zero, &zero, transmissions[0], sheet.wavenumber_cm1, unused[0],
            unused[1], unused[2], unused[3], sheet.irradiance[0], sheet.emitted, &no, &no, &no, &no,
            &no, &no, &no, empty, empty, empty, empty, &zero, &zero, &zero, &zero);
}

static void fill_sheet(void)
{
    /* Subroutine TRANS ends its loop so; behind may lie points of an earlier run of the deck. */
    const float last = 5.0f * (float)(int)(card4_.v2 / 5.0f + 0.99f);
    int count = 0;

    while (count < LOWTRAN_POINTS && sheet.wavenumber_cm1[count++] < last) continue;
    sheet.point_count = sheet.wavenumber_cm1[count - 1] >= last ? count : 0;
    memcpy(sheet.tau, transmissions[0], sizeof sheet.tau);
    sheet.range_km = card3_.range;
    sheet.level_count = cntrl_.ml < LOWTRAN_LEVELS ? cntrl_.ml : LOWTRAN_LEVELS;
    memcpy(sheet.altitude_km, model_.zm, sizeof sheet.altitude_km);
    memcpy(sheet.temperature_k, model_.tm, sizeof sheet.temperature_k);
}

int main(int argc, char **argv)
{
    FILE *file;

    if (argc != 2 || chdir(argv[1]) != 0) {
        fputs("usage: radsig-lowtran FOLDER (radsig-atmosphere starts it)\n", stderr);
        return 2;
    }
    alarm(PATIENCE_S);
    setrlimit(RLIMIT_CPU, &(struct rlimit){PROCESSOR_S, PROCESSOR_S + 1});
    run_deck();
    fill_sheet();
    file = fopen(LOWTRAN_SHEET_FILE, "wb");
    if (!file || fwrite(&sheet, sizeof sheet, 1, file) != 1 || fclose(file) != 0) {
        perror("ERROR " LOWTRAN_SHEET_FILE);
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
