#include "run_deck.h"

#include <math.h>
#include <time.h>

enum { OWN_PROFILE = 7, TRANSMITTED_SUN = 3, RADIANCE = 2, LEVEL = 1, BETWEEN = 2, TO_SPACE = 3 };

#define EARTH_RADIUS_KM 6371.23 /* LOWTRAN's */
#define DEGREE (M_PI / 180.0)
#define KILOMETRE 1000.0
#define SOURCE_KM 20.0

/* Cards hold three decimals. */
static double card_value(double value)
{
    return round(value * 1000.0) / 1000.0;
}

static double wrap_deg(double angle)
{
    return angle - 360.0 * floor((angle + 180.0) / 360.0);
}

static void set_air(const run_sight *r, card_deck *deck)
{
    const atmosphere_plan *plan = r->plan;

    deck->model = r->has_profile ? OWN_PROFILE : plan->model;
    if (r->has_profile) {
        for (int i = 0; i < 6; i++) deck->m[i] = plan->model;
        deck->mdef = 1;
        deck->im = 1;
    }
    deck->noprt = 1;
    deck->ihaze = plan->aerosol;
    deck->icstl = 1;
    deck->vis_km = card_value(plan->visibility_km);
    deck->gndalt_km = card_value(plan->ground_altitude_m / KILOMETRE);
}

bool run_sight_is_night(const run_sight *r)
{
    return r->sun.zenith_rad >= M_PI / 2.0;
}

/* A path that leaves towards an azimuth. */
static void set_scattering(const run_sight *r, card_deck *deck, double azimuth_deg)
{
    const atmosphere_plan *plan = r->plan;
    const time_t now = (time_t)floor(r->place.time_s);
    struct tm utc;

    gmtime_r(&now, &utc);
    deck->iday = utc.tm_yday + 1;
    deck->iph = (int)plan->phase;
    deck->g = card_value(plan->asymmetry);
    deck->tbound_k = plan->thesis ? 300.0 : -1.0;
    if (plan->thesis) {
        deck->iparm = 1;
        deck->parm[0] = card_value(r->place.latitude_deg);
        deck->parm[1] = card_value(-r->place.longitude_deg);
        deck->time_h = card_value(utc.tm_hour + (utc.tm_min + utc.tm_sec / 60.0) / 60.0);
        deck->psipo_deg = card_value(azimuth_deg);
    } else {
        deck->iparm = 2;
        /* By night all azimuths are alike, and so are their decks. */
        if (!run_sight_is_night(r))
            deck->parm[0] = card_value(wrap_deg(r->sun.azimuth_rad / DEGREE - azimuth_deg));
        deck->parm[1] = card_value(r->sun.zenith_rad / DEGREE);
    }
}

/* Adds what all runs have in common. */
static card_deck start(const run_sight *r, double azimuth_deg)
{
    card_deck deck = {0};

    set_air(r, &deck);
    set_scattering(r, &deck, azimuth_deg);
    deck.iemsct = RADIANCE;
    deck.imult = 1;
    return deck;
}

card_deck run_deck_sun(const run_sight *r)
{
    card_deck deck = start(r, 0.0);

    deck.itype = TO_SPACE;
    deck.iemsct = TRANSMITTED_SUN;
    deck.imult = 0;
    deck.tbound_k = 0.0;
    deck.h1_km = deck.gndalt_km;
    deck.angle_deg = run_sight_is_night(r) ? 0.0 : card_value(r->sun.zenith_rad / DEGREE);
    return deck;
}

card_deck run_deck_path(const run_sight *r, double target_m, double zenith_deg)
{
    const double target_km = target_m / KILOMETRE;
    const double sensor_km = r->plan->sensor_altitude_m / KILOMETRE;
    const double nadir = asin((EARTH_RADIUS_KM + target_km) / (EARTH_RADIUS_KM + sensor_km) *
                              sin(zenith_deg * DEGREE));
    card_deck deck = start(r, r->plan->sensor_azimuth_deg + 180.0);

    deck.itype = BETWEEN;
    deck.h1_km = card_value(sensor_km);
    deck.h2_km = card_value(target_km);
    deck.angle_deg = card_value(180.0 - nadir / DEGREE);
    return deck;
}

card_deck run_deck_sky(const run_sight *r, double zenith_deg, double azimuth_deg)
{
    card_deck deck = start(r, azimuth_deg);

    deck.itype = TO_SPACE;
    deck.h1_km = deck.gndalt_km;
    deck.angle_deg = card_value(zenith_deg);
    return deck;
}

card_deck run_deck_range(const run_sight *r, double range_m)
{
    card_deck deck = start(r, r->plan->sensor_azimuth_deg + 180.0);

    deck.itype = LEVEL;
    deck.imult = 0;
    deck.h1_km = deck.gndalt_km;
    deck.range_km = card_value(range_m / KILOMETRE);
    return deck;
}

card_deck run_deck_source(const run_sight *r)
{
    card_deck deck = start(r, r->plan->sensor_azimuth_deg + 180.0);

    deck.itype = BETWEEN;
    deck.h1_km = deck.gndalt_km;
    deck.angle_deg = 90.0;
    deck.range_km = SOURCE_KM;
    return deck;
}
