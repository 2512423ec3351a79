/* Run list: the LOWTRAN runs that make a radiance database, and what each of them gives. Thesis 2.4,
 * Figure 2.4-3; the cards follow Kneizys and others (1988). */
#ifndef RUN_LIST_H
#define RUN_LIST_H

#include "lowtran.h"
#include "scene/atmosphere_plan.h"
#include "sky/atmosphere.h"
#include "sky/site.h"
#include "sky/sun.h"

typedef struct run_list run_list;

/* Writes the decks.
 *   profile_cards, phase_cards   cards 2C and 3B, "" for none */
status run_list_open(run_list **out, const atmosphere_plan *plan, const site *place,
                     const char *profile_cards, const char *phase_cards);
void run_list_free(run_list *r);

size_t run_list_count(const run_list *r);
const char *const *run_list_decks(const run_list *r); /* shape (run_list_count) */
/* sun, path_46.000, sky_15.000_330.000, target_002000_46.000, range_005000, level_source; with a number of the spectrum's piece behind it where there
 * are several */
const char *const *run_list_names(const run_list *r);
sun_position run_list_sun(const run_list *r);
bool run_list_is_night(const run_list *r);

/* Averages a run over the steps of the database and stores it; a lowtran_taker. */
status run_list_take(void *receiver, size_t index, const lowtran_run *run);

/* Integrates the sky and hands the database over, without a header. */
status run_list_finish(run_list *r, atmosphere **out);

#endif
