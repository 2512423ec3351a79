/* Material conversion: `radsig material convert`: a spectrum of any layout as a library or as an .ems. */
#ifndef MATERIAL_CONVERSION_H
#define MATERIAL_CONVERSION_H

int material_conversion_run(int argc, char **argv);

#endif
