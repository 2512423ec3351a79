#include "thermal.h"

#include "../kernels/thermal.h"
#include "sun.h"

#include <math.h>
#include <stdlib.h>

#define WATER_J_M3_K 4.182e6 /* density times specific heat of water at 20 C */

/* Rise of the sky's emissivity under an overcast of each cloud type: Bolz. */
static const double cloud_rise[WEATHER_CLOUD_TYPES] = {0.0,  0.04, 0.08, 0.17, 0.20,
                                                       0.22, 0.24, 0.25, 0.25};

/* Brunt's clear sky with the share and kind of cloud. */
static double sky_emissivity(const weather_record *w)
{
    const double vapour_mbar = weather_saturation_pa(w->dew_point_k) / 100.0;
    const double cover = 1.0 - w->sky_exposure;
    const double clear = 0.605 + 0.048 * sqrt(vapour_mbar);

    return fmin(1.0, clear * (1.0 + cloud_rise[w->cloud_type] * cover * cover));
}

static forcing_record forcing_of(const weather_record *w, sun_position sun)
{
    const double air_k = w->air_temperature_k;
    const double rain_m_s = w->precipitation_type ? w->precipitation_m_s : 0.0;
    double direction[3];
    forcing_record out = {
        .air_temperature_k = (float)air_k,
        .sky_longwave_w_m2 =
            (float)(sky_emissivity(w) * (double)STEFAN_BOLTZMANN * air_k * air_k * air_k * air_k),
        .convection_w_m2_k = (float)(9.0 + 1.2 * w->wind_m_s),
        .direct_w_m2 = sun.zenith_rad < 0.5 * M_PI ? (float)w->direct_w_m2 : 0.0f,
        .diffuse_w_m2 = (float)w->diffuse_w_m2,
        .rain_w_m2_k = (float)(WATER_J_M3_K * rain_m_s),
        /* Dry steps take the air's, so that a value between steps is one of rain. */
        .rain_temperature_k = (float)(rain_m_s > 0.0 ? w->precipitation_temperature_k : air_k),
    };

    sun_direction(sun, direction);
    for (int i = 0; i < 3; i++) out.sun[i] = (float)direction[i];
    return out;
}

void thermal_forcing(forcing_record *out, const weather *w, const site *place)
{
    const double origin_s = weather_origin_s(w, place);

    for (size_t i = 0; i < w->count; i++) {
        const double time_s = origin_s + 3600.0 * w->record[i].time_h;
        out[i] =
            forcing_of(&w->record[i], sun_at(time_s, place->latitude_deg, place->longitude_deg));
    }
}

double thermal_time_h(const weather *w, const site *place)
{
    return (place->time_s - weather_origin_s(w, place)) / 3600.0 - w->record[0].time_h;
}

/* Launches the kernel; the forcing's memory lives until the launch has ended. */
static status launch(device *dev, device_memory facets, device_memory materials,
                     const forcing_record *forcing, thermal_span span, device_memory temperature_k)
{
    status rc = STATUS_OK;
    device_memory steps = NULL, always_lit = NULL;
    const size_t count = span.first_step + span.row_count;

    TRY(device_allocate(dev, &steps, count * sizeof *forcing, forcing));
    TRY(device_run(dev, "thermal", shape1(span.facet_count), ARG(span), ARG(facets), ARG(materials),
                   ARG(steps), ARG(always_lit), ARG(temperature_k)));
out:
    device_release(steps);
    return rc;
}

status thermal_run(device *dev, device_memory facets, device_memory materials, size_t facet_count,
                   const forcing_record *forcing, size_t step_count, double step_s, double time_h,
                   device_memory out_temperature_k)
{
    status rc = STATUS_OK;
    const double position = time_h * 3600.0 / step_s;

    NEED(position >= 0.0 && position <= (double)step_count - 1.0, STATUS_ARGUMENT,
         "temperatures: %g h after the first weather record is outside the weather's %g h", time_h,
         ((double)step_count - 1.0) * step_s / 3600.0);
    rc = launch(dev, facets, materials, forcing,
                (thermal_span){.facet_count = (uint)facet_count,
                               .first_step = (uint)ceil(position),
                               .row_count = 1,
                               .weight = (float)(1.0 - (ceil(position) - position)),
                               .step_s = (float)step_s},
                out_temperature_k);
out:
    return rc;
}

status thermal_history(device *dev, device_memory facets, device_memory materials,
                       size_t facet_count, const forcing_record *forcing, size_t step_count,
                       double step_s, float *out_temperature_k)
{
    status rc = STATUS_OK;
    device_memory history = NULL;
    const size_t bytes = step_count * facet_count * sizeof *out_temperature_k;

    TRY(device_allocate(dev, &history, bytes, NULL));
    TRY(launch(dev, facets, materials, forcing,
               (thermal_span){.facet_count = (uint)facet_count,
                              .row_count = (uint)step_count,
                              .weight = 1.0f,
                              .step_s = (float)step_s},
               history));
    TRY(device_download(dev, history, 0, bytes, out_temperature_k));
out:
    device_release(history);
    return rc;
}
