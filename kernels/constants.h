/* Physical constants, SI. CODATA 2018 unless a line says otherwise. */
#ifndef CONSTANTS_H
#define CONSTANTS_H

#define PI_F 3.14159265358979f
#define STEFAN_BOLTZMANN 5.670374419e-8f /* W m-2 K-4 */
#define ZERO_CELSIUS_K 273.15f           /* K */

/* Planck's law per micrometre: B = FIRST / (l^5 (exp(SECOND / (l T)) - 1)), l in um, T in K. */
#define PLANCK_FIRST 1.191042972397188e8  /* 2 h c^2, W um4 m-2 sr-1 */
#define PLANCK_SECOND 1.438776877503933e4 /* h c / k, um K */

/* The same with the constants that the thesis prints below eq. 2.4-5: c 2.99792458e10 cm/s,
 * h 6.626176e-34 J s, k 1.380662e-23 J/K. */
#define PLANCK_FIRST_THESIS 1.191061999044322e8  /* W um4 m-2 sr-1 */
#define PLANCK_SECOND_THESIS 1.438786314232309e4 /* um K */

#define SUN_RADIUS_RAD 4.6505e-3f   /* IAU 2015: 695700 km seen from 1 au */
#define SOLAR_CONSTANT_W_M2 1367.0f /* World Radiation Centre 1981, as the thesis' time used it */
#define LANGLEY_PER_HOUR_W_M2 11.62222f /* 1 ly = 1 thermochemical cal/cm2 = 41840 J/m2 */

#endif
