/* Command sensitivity: what `radsig thermal --sensitivity` does once its arguments are read. */
#ifndef COMMAND_SENSITIVITY_H
#define COMMAND_SENSITIVITY_H

#include "base/status.h"
#include "kernels/records.h"
#include "material/material.h"
#include "sky/site.h"
#include "weather/forcing.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct sensitivity_request {
    const char *materials, *weather;
    const char *material; /* NULL: every one of the list */
    const char *objects;  /* a table of objects; NULL: materials as `facet` */
    const char *plot;     /* NULL: none */
    facet_record facet;
    site place;
    forcing_laws laws;
    bool is_layered;
    uint32_t runs, seed;
} sensitivity_request;

/* Runs the study and prints its table. */
status command_sensitivity(const sensitivity_request *request);

/* The record of a material for temperatures. */
material_record command_material_record(const material *m);

/* Fails: the library has no such material. */
status command_refuse_material(const material_library *library, const char *path, const char *name);

#endif
