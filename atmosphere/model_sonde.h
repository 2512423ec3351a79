/* Model sonde: the lower levels of one of LOWTRAN's model atmospheres as if a radiosonde had sent
 * them. Kneizys and others (1988). */
#ifndef MODEL_SONDE_H
#define MODEL_SONDE_H

#include "sonde.h"

/* Gives the levels from sea level to the first that is not below `top_m`.
 *   model   LOWTRAN's MODEL, 1 to 6
 * Dew points are those that LOWTRAN turns back into the model's water vapour. */
status model_sonde_make(sonde **out, int model, double top_m);

#endif
