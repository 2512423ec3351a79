/* LOWTRAN sheet: what radsig-lowtran leaves of one run, a file in the run's folder. Both programs are
 * built together, so its bytes are those of the record. */
#ifndef LOWTRAN_SHEET_H
#define LOWTRAN_SHEET_H

enum { LOWTRAN_LEVELS = 34, LOWTRAN_POINTS = 12000 };

#define LOWTRAN_SHEET_FILE "sheet"

/* Spectra ascend in wavenumber. */
typedef struct lowtran_sheet {
    int level_count, point_count;
    float range_km;
    float altitude_km[LOWTRAN_LEVELS], temperature_k[LOWTRAN_LEVELS];
    float wavenumber_cm1[LOWTRAN_POINTS];
    float tau[LOWTRAN_POINTS]; /* transmission of the path */
    float
        emitted[LOWTRAN_POINTS]; /* W cm-2 sr-1 um-1, with the boundary where TBOUND asks for it */
    float irradiance[3][LOWTRAN_POINTS]; /* of the sun at the ground and outside, W cm-2 um-1; light
                                          * that the path scatters, W cm-2 sr-1 um-1 */
} lowtran_sheet;

#endif
