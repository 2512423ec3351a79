/* Card deck: the runs of LOWTRAN 7 or MODTRAN. Appendix A item 2 (.cdk); fields by the manuals' names
 * (Kneizys and others 1988; Berk and others 1989) and in their units. */
#ifndef CARD_DECK_H
#define CARD_DECK_H

#include "base/status.h"
#include "files/record_file.h"

#include <stdbool.h>

typedef struct card_deck {
    bool modtran;      /* card 1 starts with T or F, card 4 ends with a resolution */
    bool modtran_band; /* that letter is T: the 2 cm-1 band model */
    /* card 1 */
    int model, itype, iemsct, imult, m[6], mdef, im, noprt;
    double tbound_k, salb;
    /* card 2 */
    int ihaze, iseasn, ivulcn, icstl, icld, ivsa;
    double vis_km, wss_m_s, whh_m_s, rainrt_mm_h, gndalt_km;
    /* card 3 */
    double h1_km, h2_km, angle_deg, range_km, beta_deg, ro_km;
    int len;
    /* cards 3A1 and 3A2, only if iemsct is 2; iemsct 3 has iday, isourc, anglem on its card 3 */
    int iparm, iph, iday, isourc;
    double parm[4], time_h, psipo_deg, anglem_deg, g;
    /* card 4 */
    double v1_cm1, v2_cm1, dv_cm1;
    int resolution_cm1; /* MODTRAN only */
    /* card 5 */
    int irpt;
} card_deck;

/* What card 5 says of the next run: there is none, it has all cards, card 3 with 3A1 and 3A2, card 4;
 * it keeps the others. */
enum { DECK_END = 0, DECK_NEW_CARDS = 1, DECK_NEW_GEOMETRY = 3, DECK_NEW_WAVENUMBERS = 4 };

/* Reads a deck of one run. A card that holds all its numbers may be spaced freely, as the printed one is;
 * otherwise the manual's columns count and blank fields are 0. Fails with STATUS_FORMAT on what
 * asks for further cards: MODEL 0 or 7, IHAZE 7, ICLD above 10, IVSA 1, IPH 1, IRPT not 0. */
status card_deck_read(card_deck *out, const char *path);

/* Reads one run of several: all cards, or those that the IRPT of the run before it asks for.
 *   deck   the run before it, or zeros; becomes the run
 * Fails likewise. */
status card_deck_read_next(card_deck *deck, record_file *file);

/* Fails with STATUS_FORMAT at the file's last line on an IRPT at which LOWTRAN stops: 2, above 4, or
 * 3 with IEMSCT 2 or 3. */
status card_deck_check_irpt(int irpt, int iemsct, const record_file *file);

/* The cards of a run in the manual's columns; the caller frees them.
 *   after   IRPT of the run before it: which cards; DECK_END: all */
status card_deck_text(char **out, const card_deck *deck, int after);

/* Writes the same. */
status card_deck_write(const card_deck *deck, const char *path);

#endif
