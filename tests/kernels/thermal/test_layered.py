"""Layered facets against closed forms; ladders of conductances are made here in double."""
import pathlib

import numpy as np
import pyopencl as cl
import pytest
from records import FORCING, LAYERED, SPAN
from thermal_reference import SIGMA

import table_d1

ROOT = pathlib.Path(__file__).resolve().parents[3]
NODES, STEP_S = 8, 900.0
ADIABATIC, AIR, STATED = range(3)
ASPHALT = (0.689, 2114.0 * 920.0)  # W/m/K, J/m3/K


def ladder(layers, ratio=1.5):
    """Capacities and conductances of 8 nodes whose thickness grows by `ratio`;
    layers: (thickness, conductivity, capacity per volume) from the front, summed finely."""
    depth = sum(layer[0] for layer in layers)
    fraction = ratio ** np.arange(NODES) if ratio != 1 else np.ones(NODES)
    edge = np.concatenate([[0], np.cumsum(fraction) / fraction.sum()]) * depth
    ends = np.concatenate([[0], np.cumsum([layer[0] for layer in layers])])
    heat = np.concatenate([[0], np.cumsum([layer[0] * layer[2] for layer in layers])])
    resist = np.concatenate([[0], np.cumsum([layer[0] / layer[1] for layer in layers])])
    centre = (edge[1:] + edge[:-1]) / 2
    place = np.concatenate([[0], centre, [depth]])
    return np.diff(np.interp(edge, ends, heat)), 1 / np.diff(np.interp(place, ends, resist))


def facet(layers, ratio=1.5, **values):
    record = np.zeros(1, LAYERED)
    record["capacity_j_m2_k"], record["conductance_w_m2_k"] = ladder(layers, ratio)
    record["normal"], record["sky_fraction"] = (0, 0, 1), 1
    record["resistance_day_s_m"] = record["resistance_night_s_m"] = -1
    for name, value in values.items():
        record[name] = value
    return record


def steady(steps, **values):
    forcing = np.zeros(steps, FORCING)
    forcing["sun"] = (0, 0, 1)
    forcing["air_temperature_k"] = forcing["rain_temperature_k"] = 290.0
    forcing["pressure_pa"] = 101325
    for name, value in values.items():
        forcing[name] = value
    return forcing


@pytest.fixture(scope="module")
def layered(opencl):
    """Temperatures of the front, shape (steps, facets)."""
    def run(facets, forcing, step_s=STEP_S, width=16, power=None):
        span = np.zeros(1, SPAN)
        span[0] = (len(facets), 0, len(forcing), 0, 1.0, step_s, 0, len(forcing))
        out = np.empty((len(forcing), len(facets)), np.float32)
        opencl.run("layered", ((len(facets) + width - 1) // width,), options=f"-DLANES_WIDTH={width}",
                   span=span, facets=facets,
                   load={"forcing": forcing, "power": power,
                         "power_materials": 0 if power is None else power.shape[1]},
                   exchange={"lateral_columns": 0, "received_columns": 0}, temperature_k=out)
        return out.astype(float)

    return run


def test_nafems_t2_a_bar_radiates_from_its_end(layered):
    bar = facet([(0.1, 55.6, 7850 * 460.0)], emissivity=0.98, back=STATED, back_k=1000.0)
    forcing = steady(100, air_temperature_k=300.0, sky_longwave_w_m2=SIGMA * 300.0**4)

    assert layered(bar, forcing)[-1, 0] == pytest.approx(927.00, abs=0.1)  # K; notes' bound


def test_nafems_t3_a_bar_follows_a_sine_at_its_end(opencl):
    """Front at 100 sin(pi t / 40) C by a huge h, back at 0 C: 36.60 C at .02 m and 32 s."""
    ratio = 1.5
    capacity, conductance = ladder([(0.1, 35.0, 7200 * 440.5)], ratio)
    values = ", ".join(f"{c:.8e}f" for c in capacity), ", ".join(f"{c:.8e}f" for c in conductance)
    source = f"""#include "kernels/thermal/layered.h"
    constant float capacity[8] = {{{values[0]}}}, conductance[9] = {{{values[1]}}};
    kernel void bar(global float *out) {{
        layered_record r = {{.normal = {{0, 0, 1}}, .sky_fraction = 1, .back = LAYERED_STATED, .back_k = 273.15f,
                            .resistance_day_s_m = -1, .resistance_night_s_m = -1}};
        for (int i = 0; i < 8; i++) r.capacity_j_m2_k[i] = capacity[i];
        for (int i = 0; i < 9; i++) r.conductance_w_m2_k[i] = conductance[i];
        layered_body body; layered_set_body(&body, 0, &r);
        facet_state s; layered_profile(&s, &body, 273.15f, 273.15f); s.film_kg_m2 = 0;
        forcing_record f = {{.convection_w_m2_k = 1e6f, .pressure_pa = 1e5f, .sun = {{0, 0, 1}},
                            .air_temperature_k = 273.15f}};
        const layered_elimination e = layered_eliminate(&body, 0.0f, 0.05f);
        for (int i = 1; i <= 640; i++) {{
            f.air_temperature_k = 273.15f + 100 * sin(PI_F * 0.05f * i / 40);
            const thermal_load load = thermal_load_of(&body.face, f, 1.0f);
            layered_step(&s, &body, &e, &load, layered_air_of(f), 0.0f, 0.05f);
        }}
        for (int j = 0; j < 8; j++) out[j] = s.node_k[j];
    }}"""
    program = cl.Program(opencl.context, source).build(
        f"-cl-std=CL1.2 -I {ROOT} -DLANES_WIDTH=1")
    out = np.zeros(8, np.float32)
    memory = cl.Buffer(opencl.context, cl.mem_flags.WRITE_ONLY, out.nbytes)
    program.bar(opencl.queue, (1,), None, memory)
    cl.enqueue_copy(opencl.queue, out, memory)

    edge = 0.1 * np.concatenate([[0], np.cumsum(ratio ** np.arange(8))]) / sum(ratio ** np.arange(8))
    curve = np.polyfit((edge[1:] + edge[:-1])[2:6] / 2, out[2:6] - 273.15, 3)
    assert np.polyval(curve, 0.02) == pytest.approx(36.60, rel=0.01)


@pytest.mark.parametrize("h, gain, lag_h", [(10.0, 0.5447, 1.490), (20.0, 0.7177, 0.967)])
def test_deep_asphalt_follows_a_daily_wave_of_the_air(layered, h, gain, lag_h):
    hour = np.arange(193) * 0.25
    forcing = steady(193, convection_w_m2_k=h)
    forcing["air_temperature_k"] = 290 + 10 * np.sin(2 * np.pi * hour / 24)

    surface = layered(facet([(1.0, *ASPHALT)]), forcing)[-96:, 0] - 290

    wave = np.mean(surface * np.exp(-2j * np.pi * hour[-96:] / 24)) * 2j / 10
    assert abs(wave) == pytest.approx(gain, rel=0.01)
    assert -np.angle(wave) * 24 / (2 * np.pi) == pytest.approx(lag_h, abs=4 / 60)


@pytest.mark.parametrize("back, back_k", [(ADIABATIC, 0), (AIR, 0), (STATED, 295.0)])
def test_the_start_is_the_end_of_endless_equal_days(layered, back, back_k):
    hour = np.arange(193) * 0.25
    forcing = steady(193, convection_w_m2_k=12.0)
    forcing["air_temperature_k"] = 290 + 8 * np.sin(2 * np.pi * hour / 24)
    forcing["direct_w_m2"] = 500 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24))
    forcing["sky_longwave_w_m2"] = 300.0

    surface = layered(facet([(1.0, *ASPHALT)], absorptance=0.9, emissivity=0.9, back=back,
                            back_k=back_k), forcing)[:, 0]

    assert abs(surface[96:] - surface[:97]).max() < 0.02  # .01 K a day of the slowest node


def test_power_by_the_clock_enters_at_the_front(layered):
    facets = np.concatenate([facet([(0.01, *ASPHALT)], material=m) for m in (0, 1)])
    power = np.zeros((400, 2), np.float32)
    power[:, 1] = 150.0

    front = layered(facets, steady(400, convection_w_m2_k=10.0), power=power)[-1]

    assert front == pytest.approx([290.0, 305.0], abs=0.02)  # 150 W/m2 over 10 W/m2/K


def test_layers_pass_heat_as_resistances_in_series(layered):
    layers = [(0.02, 0.5, 1e6), (0.05, 0.04, 5e4), (0.01, 1.2, 2e6)]
    wall = facet(layers, absorptance=1.0, back=AIR)

    front = layered(wall, steady(2000, convection_w_m2_k=12.0, direct_w_m2=400.0))[-1, 0]

    through = 1 / (sum(d / k for d, k, _ in layers) + 1 / 12.0)
    assert front == pytest.approx(290 + 400 / (12 + through), abs=0.01)  # settled to .01 K


def wet_bulb_k(air_k, humidity, pressure_pa):
    """cp (Ta - T) = L (q*(T) - q), by bisection."""
    low, high = air_k - 40, air_k
    for _ in range(100):
        t = (low + high) / 2
        c = t - 273.15
        e = 611.2 * np.exp(17.62 * c / (243.12 + c))
        q = 0.622 * e / (pressure_pa - 0.378 * e)
        cools = (2.501e6 - 2361 * c) * (q - humidity) > 1005 * (air_k - t)
        low, high = (low, t) if cools else (t, high)
    return t


def test_a_wet_surface_cools_to_the_wet_bulb(layered):
    wet = facet([(0.01, *ASPHALT)], resistance_day_s_m=0, resistance_night_s_m=0)
    forcing = steady(400, convection_w_m2_k=15.0, specific_humidity=0.005,
                     air_temperature_k=300.0)

    front = layered(wet, forcing)[-1, 0]

    assert front == pytest.approx(wet_bulb_k(300.0, 0.005, 101325.0), abs=0.01)


def test_a_surface_resistance_slows_evaporation_down(layered):
    facets = np.concatenate([facet([(0.01, *ASPHALT)], resistance_day_s_m=r) for r in
                             (0, 50, 500, -1)])

    front = layered(facets, steady(400, convection_w_m2_k=15.0, specific_humidity=0.005))[-1]

    assert (np.diff(front) > 0.2).all() and front[-1] == pytest.approx(290.0, abs=1e-3)


def test_rain_leaves_a_film_that_evaporates(layered):
    facets = np.concatenate([facet([(0.05, *ASPHALT)], film_limit_kg_m2=limit) for limit in (0, 1)])
    forcing = steady(193, convection_w_m2_k=15.0, specific_humidity=0.005)
    forcing["rain_w_m2_k"][116:120] = 4.182e6 * 1e-3 / 3600  # 1 mm/h for an hour

    dry, wet = layered(facets, forcing).T

    assert (wet[:116] == dry[:116]).all()
    assert (dry - wet)[122] > 0.5
    assert (dry - wet)[-1] < (dry - wet).max()


def test_energy_closes_over_a_day(opencl, layered):
    """In a periodic day what enters leaves: the mean of the fluxes at the front is none."""
    hour = np.arange(193) * 0.25
    forcing = steady(193, convection_w_m2_k=12.0)
    forcing["direct_w_m2"] = 700 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24))
    forcing["sky_longwave_w_m2"] = 300.0

    front = layered(facet([(0.3, *ASPHALT)], absorptance=0.9, emissivity=0.9), forcing, STEP_S)[:, 0]

    absorbed = 0.9 * forcing["direct_w_m2"][97:]
    lost = 0.9 * (SIGMA * front[97:]**4 - 300.0) + 12.0 * (front[97:] - 290.0)
    # Records are 15 min apart: the trapezoid rule on a smooth day; steps are first order.
    assert lost.mean() == pytest.approx(absorbed.mean(), rel=1e-3)


def test_lanes_equal_their_scalar_twin(layered):
    random = np.random.default_rng(4)
    facets = np.concatenate([
        facet([(d, *ASPHALT)], absorptance=0.8, emissivity=0.9, back=i % 3, back_k=288.0,
              resistance_day_s_m=[-1, 100][i % 2])
        for i, d in enumerate(random.uniform(0.001, 0.5, 21))])
    hour = np.arange(193) * 0.25
    forcing = steady(193, convection_w_m2_k=12.0, specific_humidity=0.005)
    forcing["direct_w_m2"] = 700 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24))
    forcing["sky_longwave_w_m2"] = 300.0

    together, alone = layered(facets, forcing), layered(facets, forcing, width=1)

    assert abs(together - alone).max() < 0.02  # the start settles to .01 K, and exp has two twins
    order = random.permutation(21)
    assert (layered(facets[order], forcing) == together[:, order]).all()


def test_a_tenth_of_a_millimetre_of_steel_stays_stable(layered):
    sheet = facet([(1e-4, 54.0, 7833 * 465.0)], absorptance=0.88, emissivity=0.44, back=AIR)
    forcing = steady(193, convection_w_m2_k=11.0, sky_longwave_w_m2=300.0)
    forcing["direct_w_m2"][60:] = 900.0

    front = layered(sheet, forcing)[:, 0]

    # It answers at once: the balance of the last record, faces alike.
    t = front[-1]
    both = 0.44 * (300.0 + SIGMA * 290.0**4 - 2 * SIGMA * t**4) + 22 * (290 - t) + 0.88 * 900
    assert abs(both) < 0.5 and front.max() < t + 0.01


def deep_asphalt(depth_m=1.0):
    """Absorbs all, emits nothing; its back keeps 290 K, far below."""
    return facet([(depth_m, *ASPHALT)], absorptance=1.0, back=STATED, back_k=290.0)


def test_a_wave_of_300_w_m2_warms_deep_asphalt_by_30_c_three_hours_later(layered):
    """Amplitude / sqrt(2 pi / day x k rho c), an eighth of a day behind."""
    hour = np.arange(20 * 96 + 1) * 0.25
    forcing = steady(len(hour))
    forcing["direct_w_m2"] = 300 + 300 * np.sin(2 * np.pi * hour / 24)

    surface = layered(deep_asphalt(), forcing)[-96:, 0]

    wave = np.mean(surface * np.exp(-2j * np.pi * hour[-96:] / 24)) * 2j
    assert abs(wave) == pytest.approx(30.39, rel=0.02)  # 8 nodes over ten damping depths: 1.7 %
    assert -np.angle(wave) * 24 / (2 * np.pi) == pytest.approx(3.0, abs=4 / 60)


def test_an_hour_of_500_w_m2_warms_deep_asphalt_as_the_root_of_time(layered):
    """29.243 C after an hour: 2 q sqrt(t / (pi k rho c)). The sun of a record is held from half a step
    before it on."""
    step_s = 225.0
    forcing = steady(120)
    forcing["direct_w_m2"][100:] = 500.0

    rise = layered(deep_asphalt(0.4), forcing, step_s)[100:117, 0] - 290.0

    after_h = (np.arange(17) + 0.5) * step_s / 3600
    at_an_hour = np.interp(1.0, after_h, rise)
    assert at_an_hour == pytest.approx(29.243, rel=0.02)  # nodes that grow by half: 1.7 %


def test_energy_closes_over_a_day_for_every_material_of_table_d1(layered):
    """As above, with the rows' absorptance, emissivity, thickness and matter."""
    rows = [r for r in table_d1.ROWS if r.conductivity_cal_cm_h_c > 0]
    facets = np.concatenate([
        facet([(0.01 * r.thickness_cm, 0.11622 * r.conductivity_cal_cm_h_c,
                1000 * r.density_g_cm3 * 4184 * r.specific_heat_cal_g_c)],
              absorptance=r.visible_emissivity, emissivity=r.thermal_emissivity)
        for r in rows])
    hour = np.arange(193) * 0.25
    forcing = steady(193, convection_w_m2_k=12.0)
    forcing["direct_w_m2"] = 700 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24)) ** 2
    forcing["sky_longwave_w_m2"] = 300.0

    front = layered(facets, forcing)[97:]

    absorbed = facets["absorptance"].astype(float) * forcing["direct_w_m2"][97:, None]
    lost = facets["emissivity"] * (SIGMA * front**4 - 300.0) + 12.0 * (front - 290.0)
    assert lost.mean(axis=0) == pytest.approx(absorbed.mean(axis=0), rel=1e-3)  # the notes' bound
