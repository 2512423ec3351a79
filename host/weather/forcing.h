/* Forcing: what an hour of weather does to surfaces: the sky's longwave, the air, sun and diffuse
 * light, rain. Thesis Table 2.2-1; laws that the thesis does not tell can be chosen. */
#ifndef FORCING_H
#define FORCING_H

#include "kernels/records.h"
#include "sky/sun.h"
#include "weather/weather.h"

#include <stdbool.h>

/* Emissivity of the clear sky, from vapour pressure e in mbar, dew point td in C, air Ta in K:
 *   Brunt            0.605 + 0.048 sqrt(e)
 *   Berdahl, Martin  0.711 + 0.56 td/100 + 0.73 (td/100)^2 + 0.013 cos(2 pi t/24 h) + 0.00012 (p/mbar -
 *                    1000): Solar Energy 32 (1984) 663
 *   Brutsaert        1.24 (e/Ta)^(1/7): Water Resources Research 11 (1975) 742 */
typedef enum forcing_sky { FORCING_BRUNT, FORCING_BERDAHL_MARTIN, FORCING_BRUTSAERT } forcing_sky;

/* Heat that air takes, W m-2 K-1, at a wind of V m/s, 10 m high. The first two are blended with what
 * rises by itself, but for thesis mode: kernels/thermal/convection.h. */
typedef enum forcing_convection {
    FORCING_BY_MODEL, /* THERM's, of layered facets McAdams' */
    FORCING_THERM,    /* 9 + 1.2 V */
    FORCING_MCADAMS,  /* 5.7 + 3.8 V: McAdams 1954 */
    FORCING_TARP,     /* 3.86 sqrt(V), as of a medium rough plate of 4 m x 4 m (assumed), and what
                         rises by itself: kernels/thermal/convection.h */
    FORCING_SIMILARITY /* over a roughness length; V at least 0.1 m/s: kernels/thermal/convection.h */
} forcing_convection;

/* Where the sky's diffuse light comes from. Hay and Davies, 1980: what the beam is of that outside
 * the air, this fraction of the diffuse light comes from the sun's direction. */
typedef enum forcing_diffuse { FORCING_ISOTROPIC, FORCING_HAY_DAVIES } forcing_diffuse;

typedef struct forcing_laws {
    forcing_sky sky;
    forcing_convection convection;
    forcing_diffuse diffuse;
    double roughness_length_m; /* of similarity; 0: 0.001 */
    double
        wind_height_m; /* of the weather's wind; 0: 10. Between that and 10 m it is logarithmic over
                                  the roughness length; in thesis mode of similarity alone */
    bool thesis;       /* all as THERM is reconstructed, without what came later */
} forcing_laws;

enum { FORCING_SKIES = 3, FORCING_CONVECTIONS = 5, FORCING_DIFFUSES = 2 };

/* As scenes and the command line name them; the first convection is no name: "". */
extern const char *const forcing_sky_names[FORCING_SKIES];
extern const char *const forcing_convection_names[FORCING_CONVECTIONS];
extern const char *const forcing_diffuse_names[FORCING_DIFFUSES];

/* Ranges of the roughness length and of the height of the wind above it, in m. */
#define FORCING_ROUGHNESS_LOW_M 1e-5
#define FORCING_ROUGHNESS_HIGH_M 0.5
#define FORCING_HEIGHT_LOW_M 1.0
#define FORCING_HEIGHT_HIGH_M 100.0

/* Turns a record into what acts on a surface. Measured longwave goes before the law's; clouds raise
 * the law's by 1 + a n^2 with Bolz' a of their type and their cover n, to 1 at most. But for thesis mode
 * fog of cover 1 is black, and a cover without a type is altostratus. */
forcing_record forcing_of(const weather_record *w, sun_position sun, const forcing_laws *laws,
                          bool is_layered);

/* Warns, but in thesis mode, where clouds without a type raise the longwave.
 *   name   of the weather, which the message begins with */
void forcing_check(const weather *w, const forcing_laws *laws, const char *name);

#endif
