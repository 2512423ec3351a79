/* Sonde profile: levels of a radiosonde or of a bent model atmosphere as LOWTRAN's cards 2C.
 * Thesis 2.4.4, Figure 2.4.4-1. */
#ifndef SONDE_PROFILE_H
#define SONDE_PROFILE_H

#include "database_plan.h"

/* The profile starts at the ground. Below the plan's inversion altitude, if it states one,
 * temperature and dew point go linearly to those of the scene's weather at its time. Of the levels
 * those are kept that linear interpolation needs most; above the last, LOWTRAN's model goes on, as
 * it does for humidity that the sonde does not tell and for every other gas.
 *   out   the cards, "" without radiosonde and inversion; the caller frees them
 * Fails with STATUS_ARGUMENT where the sounding does not reach down to the ground or up to the
 * inversion. */
status sonde_profile_cards(char **out, const database_plan *g);

#endif
