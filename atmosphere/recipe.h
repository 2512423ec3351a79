/* Recipe: the LOWTRAN runs that make a radiance database, and what each of them gives. Thesis 2.4,
 * Figure 2.4-3; the cards follow Kneizys and others (1988). */
#ifndef RECIPE_H
#define RECIPE_H

#include "atmosphere.h"
#include "atmosphere_plan.h"
#include "lowtran.h"
#include "site.h"
#include "sun.h"

typedef struct recipe recipe;

/* Writes the decks.
 *   profile_cards, phase_cards   cards 2C and 3B, "" for none */
status recipe_open(recipe **out, const atmosphere_plan *plan, const site *place,
                   const char *profile_cards, const char *phase_cards);
void recipe_free(recipe *r);

size_t recipe_count(const recipe *r);
const char *const *recipe_decks(const recipe *r); /* shape (recipe_count) */
/* sun, path_46.000, sky_15.000_330.000, target_002000_46.000, range_005000, level_source; with a number of the spectrum's piece behind it where there
 * are several */
const char *const *recipe_names(const recipe *r);
sun_position recipe_sun(const recipe *r);
bool recipe_is_night(const recipe *r);

/* Averages a run over the steps of the database and stores it; a lowtran_taker. */
status recipe_take(void *receiver, size_t index, const lowtran_run *run);

/* Integrates the sky and hands the database over, without a header. */
status recipe_finish(recipe *r, atmosphere **out);

#endif
