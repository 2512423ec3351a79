/* Run deck: the cards of each run that a radiance database needs. Thesis 2.4; the cards follow
 * Kneizys and others (1988). */
#ifndef RUN_DECK_H
#define RUN_DECK_H

#include "scene/atmosphere_plan.h"
#include "sky/card_deck.h"
#include "sky/sun.h"

/* From where and when all runs look. */
typedef struct run_sight {
    const atmosphere_plan *plan;
    site place;
    sun_position sun;
    bool has_profile; /* the decks get an own profile */
} run_sight;

/* The centre of the sun is at or below the geometric horizon. */
bool run_sight_is_night(const run_sight *r);

/* Each returns a deck without albedo and wavenumbers. The first looks at the sun, by night at the
 * zenith, for its profile alone; the second from the sensor down to the altitude where its
 * zenith angle is the stated one; the third from the ground up; the fourth along the ground, towards
 * where the sensor looks, for transmission and emission alone: LOWTRAN's sunlight there is several
 * times too bright; the fifth leaves the ground level and is 20 km long, for the sunlight. In mode thesis TBOUND and the sun are those of Appendix
 * A item 2. */
card_deck run_deck_sun(const run_sight *r);
card_deck run_deck_path(const run_sight *r, double target_m, double zenith_deg);
card_deck run_deck_sky(const run_sight *r, double zenith_deg, double azimuth_deg);
card_deck run_deck_range(const run_sight *r, double range_m);
card_deck run_deck_source(const run_sight *r);

#endif
