"""Convection that depends on the surface, against the published formulas in float64 numpy."""
import numpy as np
import probe
import pyopencl as cl
import pytest
from records import FACET, FORCING, MATERIAL, SPAN

TARP, SIMILARITY, BLENDED = 1, 2, 3
AIR_K, STEP_S = 290.0, 900.0
GRAVITY, KARMAN = 9.80665, 0.4


def tarp_natural(up, rise_k):
    """EnergyPlus Engineering Reference, TARP algorithm: vertical, enhanced and reduced."""
    root, tilt = np.cbrt(np.abs(rise_k)), np.abs(up)
    enhanced, reduced = 9.482 * root / (7.238 - tilt), 1.810 * root / (1.382 + tilt)
    return np.where(np.asarray(up) == 0, 1.31 * root, np.where(rise_k * up > 0, enhanced, reduced))


def louis(wind_m_s, rise_k, height_m=10.0, length_m=0.01, heat_j_m3_k=1200.0):
    """Louis 1979, eqs. 11 to 17, of heat: 9.4 = 2 x 4.7, C* = 5.3, R = .74."""
    drag = (KARMAN / np.log(height_m / length_m)) ** 2
    number = -GRAVITY * height_m * rise_k / (AIR_K * wind_m_s**2)
    c = 5.3 * drag * 9.4 * np.sqrt(height_m / length_m)
    with np.errstate(invalid="ignore"):
        unstable = 1 - 9.4 * number / (1 + c * np.sqrt(np.abs(number)))
    stable = 1 / (1 + 4.7 * number) ** 2
    return heat_j_m3_k * drag * wind_m_s / 0.74 * np.where(number < 0, unstable, stable)


def similarity_terms(wind_m_s, height_m=10.0, length_m=0.01, heat_j_m3_k=1200.0):
    """What the host gives: the wind's part, buoyancy, roughness."""
    drag = (KARMAN / np.log(height_m / length_m)) ** 2
    return (heat_j_m3_k * drag * wind_m_s / 0.74, GRAVITY * height_m / wind_m_s**2,
            5.3 * 9.4 * drag * np.sqrt(height_m / length_m))


def of_law(opencl, law, up, rise_k, wind=0.0, buoyancy=0.0, roughness=0.0, plate=0.0):
    body = (f"const convection_air a = {{{law}u, {AIR_K}f, in2[i], in3[i], in4[i], in5[i]}};"
            f"out[0] = convection_of(a, in0[i], {AIR_K}f + in1[i]);")
    values = np.broadcast_arrays(up, rise_k, wind, buoyancy, roughness, plate)
    return probe.probe(opencl, "convection.h", body, values, options="-DLANES_WIDTH=1")[0]


UP = np.repeat([1.0, 0.5, 0.0, -0.5, -1.0], 5)
RISE_K = np.tile([-20.0, -2.0, 0.0, 5.0, 30.0], 5)


def test_what_rises_by_itself_is_tarp_s(opencl):
    # 290 K + rise in float32 leaves 3e-5 K of a rise of 2 K, and 1.31 against 9.482 / 7.238
    assert of_law(opencl, TARP, UP, RISE_K, wind=6.0) == pytest.approx(
        6.0 + tarp_natural(UP, RISE_K), rel=4e-4)


@pytest.mark.parametrize("wind", [0.5, 5.7, 13.3])
def test_wind_and_what_rises_blend_by_their_cubes(opencl, wind):
    expected = (wind**3 + tarp_natural(UP, RISE_K) ** 3) ** (1 / 3)

    assert of_law(opencl, BLENDED, UP, RISE_K, wind=wind) == pytest.approx(expected, rel=4e-4)


@pytest.mark.parametrize("wind_m_s", [0.1, 1.0, 2.0, 5.0])
def test_stable_air_takes_no_less_than_from_a_plate(opencl, wind_m_s):
    wind, buoyancy, roughness = similarity_terms(wind_m_s)
    plate = 3.86 * np.sqrt(wind_m_s)

    found = of_law(opencl, SIMILARITY, UP, RISE_K, wind, buoyancy, roughness, plate)

    cold = np.maximum(louis(wind_m_s, RISE_K), plate + tarp_natural(UP, RISE_K))
    expected = np.where(RISE_K > 0, louis(wind_m_s, RISE_K), cold)
    assert found == pytest.approx(np.maximum(expected, 2.0), rel=4e-4)
    assert found.min() >= 2.0  # W m-2 K-1


@pytest.mark.parametrize("wind_m_s", [0.1, 1.0, 5.0])
def test_over_a_roughness_length_it_is_louis_s(opencl, wind_m_s):
    wind, buoyancy, roughness = similarity_terms(wind_m_s)

    found = of_law(opencl, SIMILARITY, UP, RISE_K, wind, buoyancy, roughness)

    assert found == pytest.approx(louis(wind_m_s, RISE_K), rel=2e-4)


def test_equally_warm_air_takes_what_the_logarithmic_wind_takes(opencl):
    wind, buoyancy, roughness = similarity_terms(3.0)

    assert of_law(opencl, SIMILARITY, [1.0], [0.0], wind, buoyancy, roughness)[0] == pytest.approx(
        1200 * 0.16 * 3.0 / (0.74 * np.log(1000) ** 2), rel=1e-5)


def run(opencl, forcing, area, **matter):
    facets, materials = np.zeros(1, FACET), np.zeros(1, MATERIAL)
    facets["normal"], facets["thickness_m"] = (0, 0, 1), 0.002
    for name, value in {"density_kg_m3": 7800.0, "specific_heat_j_kg_k": 500.0,
                        "conductivity_w_m_k": 45.0, "solar_absorptance": 0.8,
                        "thermal_emissivity": 0.0, "exposed_area": area, **matter}.items():
        materials[name] = value
    span = np.zeros(1, SPAN)
    span[0] = (1, 0, len(forcing), 0, 1.0, STEP_S, 0, len(forcing))
    out = np.empty(len(forcing), np.float32)
    opencl.run("thermal", (1,), span=span, thesis=1, facets=facets, materials=materials,
               load={"forcing": forcing, "power_materials": 0}, temperature_k=out)
    return out


def sunny(steps, **law):
    forcing = np.zeros(steps, FORCING)
    forcing["sun"], forcing["direct_w_m2"] = (0, 0, 1), 500.0
    forcing["air_temperature_k"] = forcing["rain_temperature_k"] = AIR_K
    forcing["pressure_pa"] = 101325
    for name, value in law.items():
        forcing[name] = value
    return forcing


def warmest(takes, gained_w_m2):
    """Where a sheet loses what it gains, by bisection."""
    low, high = 0.0, 500.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if takes(middle) * middle < gained_w_m2 else (low, middle)
    return AIR_K + low


def test_a_sunny_sheet_settles_where_tarp_s_air_takes_what_it_gains(opencl):
    last = run(opencl, sunny(97, convection_law=TARP, convection_w_m2_k=5.0), area=0.5)[-1]

    assert last == pytest.approx(warmest(lambda k: 5.0 + tarp_natural(1.0, k), 400.0), abs=0.01)


def test_both_sides_of_a_sheet_lose_by_their_own_tilt(opencl):
    last = run(opencl, sunny(97, convection_law=TARP, convection_w_m2_k=5.0), area=1.0)[-1]

    both = lambda k: 10.0 + tarp_natural(1.0, k) + tarp_natural(-1.0, k)
    assert last == pytest.approx(warmest(both, 400.0), abs=0.01)


def test_a_sheet_that_the_sun_leaves_follows_louis_s_air(opencl):
    wind, buoyancy, roughness = similarity_terms(2.0)
    forcing = sunny(25, convection_law=SIMILARITY, convection_w_m2_k=wind, buoyancy=buoyancy,
                    roughness=roughness)
    forcing["direct_w_m2"][13:] = 0
    found = run(opencl, forcing, area=0.5)

    # Euler steps of a second; the beam is held to the nearer record
    heat_j_m2_k, t = 7800.0 * 500.0 * 0.002, warmest(lambda k: louis(2.0, k), 400.0)
    exact = [t]
    for second in range(24 * 900):
        gained = 400.0 if second < 12.5 * 900 else 0.0
        t += (gained - louis(2.0, t - AIR_K) * (t - AIR_K)) / heat_j_m2_k
        if second % 900 == 899:
            exact.append(t)
    # steps of 300 s, with the slope of the law left out
    assert np.abs(found - exact).max() < 0.5 and found[12] == pytest.approx(exact[12], abs=0.01)


def test_evaporation_meets_the_same_air(opencl):
    """9 W m-2 K-1, stated as the wind's alone and as what rises and the rest."""
    source = """#include "kernels/thermal/layered.h"
kernel void probe(global float *out) {
    forcing_record f = {.air_temperature_k = 290, .convection_w_m2_k = 9, .pressure_pa = 1e5f,
                        .specific_humidity = .004f};
    layered_body body;
    for (int i = 0; i < 3; i++) body.face.normal[i] = i == 2;
    body.day_s_m = body.night_s_m = 0;
    out[0] = layered_latent(&body, layered_air_of(f), 300.0f, 0.0f, 300.0f).w_m2;
    f.convection_law = CONVECTION_TARP;
    f.convection_w_m2_k = 9 - 9.482f * cbrt(10.0f) / (7.238f - 1);
    out[1] = layered_latent(&body, layered_air_of(f), 300.0f, 0.0f, 300.0f).w_m2;
}
"""
    program = cl.Program(opencl.context, source).build(
        f"-cl-std=CL1.2 -DLANES_WIDTH=1 -I {probe.ROOT}")
    usual, same = probe.launch(opencl, program.probe, 1, [], (2,))

    assert usual > 100 and same == pytest.approx(usual, rel=1e-5)
