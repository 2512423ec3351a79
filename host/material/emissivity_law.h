/* Emissivity law: how emissivity changes with the angle from the normal. */
#ifndef EMISSIVITY_LAW_H
#define EMISSIVITY_LAW_H

/* Unpolarised 1 - reflectance of a smooth surface with the optical constants n and k in air: Fresnel's formulas;
 * Born and Wolf, Principles of Optics, 14.2. */
double emissivity_law_optical(double n, double k, double angle_deg);

/* The same of the real index that has this normal emissivity, (1 + r) / (1 - r) with r = sqrt(1 - e). */
double emissivity_law_fresnel(double normal, double angle_deg);

/* assumed: e (1 - 0.12 (1 - cos angle)^4): 0.987 e at 65 degrees, 0.917 e at 85, as rough ground was measured
 * to keep its emissivity to 60 degrees and lose a few hundredths beyond. */
double emissivity_law_rough(double normal, double angle_deg);

/* Flat to 60 degrees, then a quarter of a cosine wave down to 0 at 90: the library of 1994's files. */
double emissivity_law_thesis(double normal, double angle_deg);

#endif
