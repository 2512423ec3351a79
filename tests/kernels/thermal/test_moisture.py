"""Dew and frost on surfaces colder than the dew point, against balances in float64."""
import numpy as np
import pytest
from records import FACET, FORCING, MATERIAL, SPAN
from test_layered import ASPHALT, facet
from thermal_reference import SIGMA

STEP_S, PRESSURE_PA, FILM_KG_M2 = 900.0, 101325.0, 0.3
LUMP, SLAB, LAYERS = "lump", "slab", "layers"


def saturated(celsius):
    """Specific humidity; Magnus over water and over ice: WMO-No. 8 (2008)."""
    over_ice = 22.46 * celsius / (272.62 + celsius)
    vapour_pa = 611.2 * np.exp(np.where(celsius < 0, over_ice, 17.62 * celsius / (243.12 + celsius)))
    return 0.622 * vapour_pa / (PRESSURE_PA - 0.378 * vapour_pa)


def heat(celsius):
    """J/kg: 2.83e6 of frost; of water that at 0 C less 2361 a kelvin."""
    return np.where(celsius < 0, 2.83e6, 2.501e6 - 2361 * celsius)


def nights(steps, air_c, humidity, h=12.0, sky_w_m2=0.0, **values):
    forcing = np.zeros(steps, FORCING)
    forcing["sun"] = (0, 0, -1)
    forcing["air_temperature_k"] = forcing["rain_temperature_k"] = 273.15 + air_c
    forcing["pressure_pa"], forcing["specific_humidity"] = PRESSURE_PA, humidity
    forcing["convection_w_m2_k"], forcing["sky_longwave_w_m2"] = h, sky_w_m2
    forcing["wet_below_k"] = 330.0  # the device finds the dew point by itself
    for name, value in values.items():
        forcing[name] = value
    return forcing


def run_therm(opencl, forcing, area, emissivity, thickness_m, power=None, own_w_m2=(0,), melts_k=0.0):
    """Of the last of so many facets as have a power of their own."""
    facets, materials = np.zeros(len(own_w_m2), FACET), np.zeros(1, MATERIAL)
    facets["normal"], facets["thickness_m"], facets["power_w_m2"] = (0, 0, 1), thickness_m, own_w_m2
    for name, value in zip(("conductivity_w_m_k", "density_kg_m3", "specific_heat_j_kg_k",
                            "thermal_emissivity", "exposed_area", "melts_k"),
                           (0.689, 2114.0, 920.0, emissivity, area, melts_k)):
        materials[name] = value
    span = np.zeros(1, SPAN)
    span[0] = (len(facets), 0, len(forcing), 0, 1.0, STEP_S, 0, len(forcing))
    out = np.empty((len(forcing), len(facets)), np.float32)
    opencl.run("thermal", (1,), span=span, thesis=1, facets=facets, materials=materials,
               load={"forcing": forcing, "power": power, "power_materials": power is not None},
               temperature_k=out)
    return out[:, -1].astype(float) - 273.15


def run_layered(opencl, forcing, emissivity, thickness_m, power=None, **values):
    layers = facet([(thickness_m, *ASPHALT)], emissivity=emissivity, **values)
    span = np.zeros(1, SPAN)
    span[0] = (1, 0, len(forcing), 0, 1.0, STEP_S, 0, len(forcing))
    out = np.empty((len(forcing), 1), np.float32)
    opencl.run("layered", (1,), span=span, facets=layers,
               load={"forcing": forcing, "power": power, "power_materials": power is not None},
               exchange={"lateral_columns": 0, "received_columns": 0}, temperature_k=out)
    return out[:, 0].astype(float) - 273.15


@pytest.fixture(scope="module")
def run(opencl):
    """Temperatures of a level facet in C, by the model and how it is built."""
    def of(kind, forcing, emissivity=0.9, thickness_m=0.005, power=None, melts_k=0.0):
        if kind == LAYERS:
            return run_layered(opencl, forcing, emissivity, thickness_m, power, melts_k=melts_k,
                               lateral_fraction=np.full(8, 0.125))
        return run_therm(opencl, forcing, 0.5 if kind == LUMP else -0.5, emissivity, thickness_m,
                         power, melts_k=melts_k)

    return of


def balance_c(air_c, humidity, h, sky_w_m2, emissivity=0.9):
    """Where what comes from air, vapour and sky is what the surface emits, by bisection."""
    low, high = air_c - 60.0, air_c
    for _ in range(100):
        t = 0.5 * (low + high)
        gains = (h * (air_c - t) + h / 1005 * heat(t) * max(0, humidity - saturated(t))
                 + emissivity * (sky_w_m2 - SIGMA * (t + 273.15) ** 4))
        low, high = (t, high) if gains > 0 else (low, t)
    return t


@pytest.mark.parametrize("kind", [LUMP, SLAB, LAYERS])
@pytest.mark.parametrize("air_c, dew_c, h, sky_w_m2", [
    (15.0, 14.2, 6.0, 312.0), (15.0, 14.2, 13.0, 312.0), (15.0, 2.0, 6.0, 312.0), (2.0, 1.0, 8.0, 230.0),
    (-5.0, -6.0, 8.0, 200.0)], ids=["calm", "wind", "dry", "frost", "cold"])
def test_a_facet_settles_where_dew_and_air_feed_what_it_emits(run, kind, air_c, dew_c, h, sky_w_m2):
    humidity = float(saturated(max(dew_c, 0) or dew_c))

    last = run(kind, nights(400, air_c, humidity, h, sky_w_m2))[-1]

    # float32 at 300 K through some hundred steps, and a start that is settled to 0.01 K
    assert last == pytest.approx(balance_c(air_c, humidity, h, sky_w_m2), abs=0.02)


@pytest.mark.parametrize("kind", [LUMP, SLAB, LAYERS])
def test_without_humidity_nothing_condenses(run, kind):
    dry = run(kind, nights(400, 15.0, float(saturated(14.2)), 6.0, 312.0, wet_below_k=0.0))[-1]

    assert dry == pytest.approx(balance_c(15.0, 0.0, 6.0, 312.0), abs=0.02)


@pytest.mark.parametrize("kind", [LUMP, SLAB, LAYERS])
def test_a_film_holds_three_tenths_of_a_millimetre_and_evaporates_first(run, kind):
    """Cooled below the dew point for three days, then left alone in air of 17 C: the facet stays at the
    wet bulb until 0.3 kg/m2 are gone, then takes the air's temperature."""
    power, steps = np.zeros((400, 1), np.float32), 400
    power[:300] = -150.0
    humidity, h = 0.008, 15.0

    warm = run(kind, nights(steps, 17.0, humidity, h), emissivity=0.0, power=power)[300:]

    bulb = balance_wet_bulb(17.0, humidity)
    lasts_s = FILM_KG_M2 * heat(bulb) / (h * (17.0 - bulb))
    middle = 0.5 * (17.0 + bulb)
    dry = np.argmax(warm > middle) * STEP_S
    assert warm[8] == pytest.approx(bulb, abs=0.1)  # two hours: 20 times the facet's own time
    assert dry == pytest.approx(lasts_s, abs=2.5 * STEP_S)  # it warms and cools for half an hour
    assert warm[-1] == pytest.approx(17.0, abs=0.05)


def balance_wet_bulb(air_c, humidity):
    low, high = air_c - 30, air_c
    for _ in range(100):
        t = 0.5 * (low + high)
        low, high = (t, high) if 1005 * (air_c - t) > heat(t) * (saturated(t) - humidity) else (low, t)
    return t


@pytest.mark.parametrize("kind", [LUMP, SLAB, LAYERS])
def test_what_dew_frees_by_night_it_takes_in_the_morning(run, kind):
    """Equal days, each with dew that is gone at noon: sun and sky pay for air and emission alone."""
    hour = np.arange(12 * 96 + 1) * 0.25
    forcing = nights(len(hour), 15.0, float(saturated(10.5)), 8.0, 290.0)
    power = (300 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24)) ** 2)[:, None].astype(np.float32)

    found = run(kind, forcing, power=power, thickness_m=0.02)[-96:]

    lost = 0.9 * (SIGMA * (found + 273.15) ** 4 - 290.0) + 8.0 * (found - 15.0)
    assert (found < 10.5).sum() > 20
    assert lost.mean() == pytest.approx(power[-96:].mean(), rel=5e-3)  # a step that crosses the dew point


@pytest.mark.parametrize("area", [0.5, -0.5])
@pytest.mark.parametrize("power_w_m2", [0.0, 900.0, 4000.0])
def test_an_exhaust_beside_a_wet_sheet_is_as_warm_as_alone(opencl, area, power_w_m2):
    """Magnus' vapour pressure is beyond the air's own above 100 C."""
    forcing = nights(200, 15.0, float(saturated(14.2)), 6.0, 312.0)

    alone, beside = (run_therm(opencl, forcing, area, 0.9, 0.003, own_w_m2=own)
                     for own in ((power_w_m2,), (0.0, power_w_m2)))

    assert (alone == beside).all()


def test_dew_forms_on_grass_in_spite_of_its_resistance(opencl):
    """Stomata shut water in, not out: a lawn is as warm as a dry sheet in the dew."""
    forcing = nights(400, 15.0, float(saturated(14.2)), 6.0, 312.0)

    lawn = run_layered(opencl, forcing, 0.9, 0.005, resistance_day_s_m=50, resistance_night_s_m=200)

    assert lawn[-1] == pytest.approx(balance_c(15.0, float(saturated(14.2)), 6.0, 312.0), abs=0.02)


def test_a_rain_film_of_its_own_limit_still_evaporates(opencl):
    facets = [run_layered(opencl, rainy(), 0.0, 0.05, film_limit_kg_m2=limit) for limit in (0, 0.2)]

    dry, wet = facets
    assert (dry - wet)[122] > 0.5 and abs(dry - wet)[-1] < 0.5


def rainy():
    forcing = nights(193, 17.0, 0.005, 15.0)
    forcing["rain_w_m2_k"][116:120] = 4.182e6 * 1e-3 / 3600  # 1 mm/h for an hour
    return forcing


@pytest.mark.parametrize("kind", [LUMP, SLAB, LAYERS])
def test_snow_stays_at_0_c_while_it_melts(run, kind):
    """Air of 5 C, much power by day, a clear cold night: never above 0 C, and at night as cold as without."""
    hour = np.arange(5 * 96 + 1) * 0.25
    power = (500 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24)))[:, None].astype(np.float32)
    forcing = nights(len(hour), 5.0, 0.0, 8.0, 180.0, wet_below_k=0.0)

    snow = run(kind, forcing, power=power, thickness_m=0.1, melts_k=273.15)

    assert snow.max() == pytest.approx(0.0, abs=1e-4)  # float32 at 273 K
    assert (snow > -1e-4).sum() > 96 and snow.min() < -5


@pytest.mark.parametrize("kind", [SLAB, LAYERS])
def test_melting_snow_cools_down_as_a_slab_at_0_c(run, kind):
    """A front that is held at 0 C brings the whole slab there; from then on it follows what did not melt."""
    steps = 600
    power = np.zeros((steps, 1), np.float32)
    power[:400] = 300.0
    forcing = nights(steps, 0.0, 0.0, 8.0, SIGMA * 273.15**4, wet_below_k=0.0)
    forcing["air_temperature_k"][400:] = 263.15
    stays = forcing.copy()

    snow = run(kind, forcing, power=power, thickness_m=0.1, melts_k=273.15)
    usual = run(kind, stays, thickness_m=0.1)

    assert snow[:399] == pytest.approx(0.0, abs=1e-3)
    # the power lasts half a step longer, and keeps the face at 0 C
    assert snow[420:] == pytest.approx(usual[420:], abs=0.02)
