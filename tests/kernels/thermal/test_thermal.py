
import numpy as np
import pytest
import thermal_reference as reference
from records import FACET, FORCING, MATERIAL, SPAN
from thermal_reference import SIGMA

import table_d1

STEP_S = 900.0
ASPHALT = {"density_kg_m3": 2114.0, "specific_heat_j_kg_k": 920.0, "conductivity_w_m_k": 0.689}


def launch(opencl, width, facets, materials, forcing, *, first=0, rows=None, weight=1.0,
           step_s=STEP_S, lit=None, fraction=None, period=0, power=None, thesis=1):
    """Temperatures of shape (rows, facets); `width` facets a work-item."""
    rows = len(forcing) if rows is None else rows
    bit_words = 0 if lit is None else (len(lit) + 31) // 32
    words = bit_words * (1 if fraction is None else 9)
    span = np.zeros(1, SPAN)
    span[0] = (len(facets), first, rows, words, weight, step_s, period, len(forcing))
    mask = None if lit is None else packed(lit, bit_words)
    if fraction is not None:
        mask = np.concatenate([mask, packed_bytes(fraction, words - bit_words)])
    out = np.empty((rows, len(facets)), np.float32)
    opencl.run("thermal", ((len(facets) + width - 1) // width,), options=f"-DLANES_WIDTH={width}",
               span=span, thesis=thesis, facets=facets, materials=materials,
               load={"forcing": forcing, "sunlit": mask, "power": power,
                     "power_materials": 0 if power is None else power.shape[1]},
               temperature_k=out)
    return out


@pytest.fixture(scope="module")
def thermal(opencl):
    """Runs the kernel: temperatures of shape (rows, facets)."""
    return lambda *what, **how: launch(opencl, 16, *what, **how)


def packed(lit, words):
    """Bit step % 32 of word step / 32, shape (words, facets); lit: (steps, facets)."""
    steps = np.zeros((words * 32, lit.shape[1]), np.uint64)
    steps[: len(lit)] = lit
    bits = steps.reshape(words, 32, -1) << np.arange(32, dtype=np.uint64)[None, :, None]
    return np.ascontiguousarray(bits.sum(axis=1).astype(np.uint32))


def packed_bytes(fraction, words):
    """Byte slot % 4 of word slot / 4, shape (words, facets); fraction: (slots, facets)."""
    slots = np.zeros((words * 4, fraction.shape[1]), np.uint32)
    slots[: len(fraction)] = fraction
    return (slots.reshape(words, 4, -1) << np.arange(0, 32, 8, dtype=np.uint32)[:, None]).sum(
        axis=1, dtype=np.uint32)


def towards(slope_deg, azimuth_deg):
    slope, azimuth = np.radians([slope_deg, azimuth_deg])
    return np.sin(slope) * np.sin(azimuth), np.sin(slope) * np.cos(azimuth), np.cos(slope)


def one_facet(thickness_m, exposed_area, **material):
    facets, materials = np.zeros(1, FACET), np.zeros(1, MATERIAL)
    facets["normal"] = (0, 0, 1)
    facets["thickness_m"] = thickness_m
    for name, value in (dict(ASPHALT, exposed_area=exposed_area) | material).items():
        materials[name] = value
    return facets, materials


def steady_forcing(steps, **values):
    forcing = np.zeros(steps, FORCING)
    forcing["sun"] = (0, 0, 1)
    forcing["air_temperature_k"] = forcing["rain_temperature_k"] = 290.0
    for name, value in values.items():
        forcing[name] = value
    return forcing


@pytest.fixture(scope="module")
def table():
    facets, materials = (np.zeros(len(table_d1.ROWS), kind) for kind in (FACET, MATERIAL))
    for i, row in enumerate(table_d1.ROWS):
        facets[i]["normal"] = towards(row.slope_deg, row.azimuth_deg)
        facets[i]["material"] = i
        facets[i]["thickness_m"] = 0.01 * row.thickness_cm
        facets[i]["power_w_m2"] = row.power_ly_h * table_d1.LANGLEY_PER_HOUR_W_M2
        materials[i] = np.array((1000 * row.density_g_cm3, 4184 * row.specific_heat_cal_g_c,
                                 0.11622 * row.conductivity_cal_cm_h_c, row.visible_emissivity,
                                 row.thermal_emissivity, row.exposed_area) + (0,) * 7 + ((0,) * 3,), MATERIAL)
    return facets, materials


@pytest.fixture(scope="module")
def two_days():
    """48 h at 15 min, sun at 43 degrees north in June, a shower in the second morning."""
    hour = np.arange(193) * 0.25
    angle, latitude, declination = np.radians(15 * (hour - 12)), np.radians(43), np.radians(23.4)
    sun = np.array([
        -np.cos(declination) * np.sin(angle),
        np.cos(latitude) * np.sin(declination)
        - np.sin(latitude) * np.cos(declination) * np.cos(angle),
        np.sin(latitude) * np.sin(declination)
        + np.cos(latitude) * np.cos(declination) * np.cos(angle)]).T
    height = np.maximum(0, sun[:, 2])
    air = 288 + 6 * np.cos(2 * np.pi * (hour - 15) / 24)
    rain = (hour >= 33) & (hour < 34)
    forcing = np.zeros(193, FORCING)
    forcing["sun"] = sun
    forcing["direct_w_m2"] = 1000 * (1 - np.exp(-5 * height)) * (height > 0)
    forcing["diffuse_w_m2"] = 120 * height
    forcing["air_temperature_k"] = air
    forcing["sky_longwave_w_m2"] = 0.75 * SIGMA * air**4
    forcing["convection_w_m2_k"] = 9 + 1.2 * (1.5 + np.sin(hour))
    forcing["rain_w_m2_k"] = 5.0 * rain
    forcing["rain_temperature_k"] = np.where(rain, 280.0, air)
    return forcing


def test_every_material_of_table_d1_equals_double_precision(thermal, table, two_days):
    single = thermal(*table, two_days)

    # 0.05 C: the acceptance of the thermal model at any step
    assert abs(single - reference.history(*table, two_days, STEP_S)).max() < 0.05


@pytest.mark.parametrize("celsius", [10.0, -4.0])
def test_every_material_with_dew_or_frost_equals_double_precision(thermal, table, two_days, celsius):
    wet = two_days.copy()
    vapour = 611.2 * np.exp(17.62 * celsius / (243.12 + celsius))
    wet["pressure_pa"], wet["specific_humidity"] = 101325, 0.622 * vapour / (101325 - 0.378 * vapour)
    wet["wet_below_k"] = 275.15 + celsius
    for name in ("air_temperature_k", "rain_temperature_k"):
        wet[name] += celsius - 10
    wet["sky_longwave_w_m2"] *= 0.9

    single = thermal(*table, wet)

    double = reference.history(*table, wet, STEP_S)
    wet["wet_below_k"] = 0
    assert abs(single - double).max() < 0.05
    assert abs(double - reference.history(*table, wet, STEP_S)).max() > 0.5  # C: it was wet


def many_days(forcing, days):
    """The first day over and over, then all of it."""
    return np.concatenate([np.tile(forcing[:96], days), forcing])


def test_the_settled_start_is_where_many_days_end(thermal, table, two_days):
    """In double precision, with the unequal nodes, through 15 first days."""
    forcing = two_days.copy()
    forcing["convection_w_m2_k"] = 11 + np.sin(2 * np.pi * np.arange(193) / 96)  # as every day

    settled = thermal(*table, forcing, thesis=0)

    double = reference.history(*table, many_days(forcing, 15), STEP_S, ratio=1.5)[15 * 96:]
    # settled to 0.01 K a day of the thickest; 0.05 C of rounding
    assert abs(settled - double).max() < 0.1


@pytest.mark.parametrize("thickness_m, exposed_area", [(0.001, 0.5), (1.0, 0.5), (3.0, 0.7), (1.0, -0.5), (0.3, -0.8)])
def test_equal_days_are_equal_from_the_start(thermal, thickness_m, exposed_area):
    facets, materials = one_facet(thickness_m, exposed_area, solar_absorptance=0.9, thermal_emissivity=0.9)
    hour = np.arange(193) * 0.25
    forcing = steady_forcing(193, convection_w_m2_k=12.0, sky_longwave_w_m2=300.0)
    forcing["direct_w_m2"] = 500 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24))

    front = thermal(facets, materials, forcing, thesis=0)[:, 0].astype(float)

    assert abs(front[96:] - front[:97]).max() < 0.02  # .01 K a day of what is slowest


def test_power_into_what_exchanges_nothing_is_not_run_for_days(thermal):
    facets, materials = one_facet(1e5 / (2114 * 920), 0.0)
    power = np.full((193, 1), 1.0)

    front = thermal(facets, materials, steady_forcing(193), power=power.astype(np.float32), thesis=0)[:, 0]

    assert front[0] == pytest.approx(290.0, abs=1e-3)
    assert front[-1] == pytest.approx(290 + 2 * 86400 / 1e5, abs=0.01)  # 1 W/m2 for two days


@pytest.mark.parametrize("h, gain, lag_h", [(10.0, 0.5447, 1.490), (20.0, 0.7177, 0.967)])
def test_thick_ground_of_unequal_nodes_follows_a_daily_wave(thermal, h, gain, lag_h):
    """Semi-infinite asphalt; with equal nodes it lags by 34 minutes more."""
    facets, materials = one_facet(1.0, -0.5)
    hour = np.arange(193) * 0.25
    forcing = steady_forcing(193, convection_w_m2_k=h)
    forcing["air_temperature_k"] = 290 + 10 * np.sin(2 * np.pi * hour / 24)

    surface = thermal(facets, materials, forcing, thesis=0)[-96:, 0].astype(float) - 290

    wave = np.mean(surface * np.exp(-2j * np.pi * hour[-96:] / 24)) * 2j / 10
    assert abs(wave) == pytest.approx(gain, rel=0.01)
    assert -np.angle(wave) * 24 / (2 * np.pi) == pytest.approx(lag_h, abs=4 / 60)


def test_a_settled_facet_does_not_depend_on_its_neighbours(thermal, table, two_days):
    facets, materials = table
    order = np.random.default_rng(12).permutation(22)

    assert (thermal(facets[order], materials, two_days, thesis=0)
            == thermal(facets, materials, two_days, thesis=0)[:, order]).all()


def test_shorter_steps_change_the_table_by_less_than_a_quarter_degree(thermal, table, two_days):
    fine = reference.history(*table, two_days, STEP_S, sub_steps=40)
    rms = np.sqrt(np.mean((thermal(*table, two_days) - fine) ** 2, axis=0))

    assert rms.max() < 0.25  # first-order in time; the thesis' own rms against measurement is 1.83


def test_two_points_with_the_same_sun_now_and_different_pasts_keep_their_own(
        thermal, table, two_days):
    lit = np.random.default_rng(7).random((193, 22)) < 0.5
    lit[150:] = True

    single = thermal(*table, two_days, lit=lit)

    assert abs(single - reference.history(*table, two_days, STEP_S, lit=lit)).max() < 0.05


def test_shade_is_never_hotter(thermal, table, two_days):
    lit = np.random.default_rng(8).random((193, 22)) < 0.5

    shade, sun = thermal(*table, two_days, lit=lit), thermal(*table, two_days)

    assert (shade - sun).max() < 1e-3  # rounding of single precision over 768 steps


def test_a_mask_of_all_ones_changes_nothing(thermal, table, two_days):
    lit = np.ones((193, 22), bool)

    assert (thermal(*table, two_days, lit=lit) == thermal(*table, two_days)).all()


def test_a_facet_does_not_depend_on_its_neighbours(thermal, table, two_days):
    facets, materials = table
    order = np.random.default_rng(9).permutation(22)

    assert (thermal(facets[order], materials, two_days)
            == thermal(facets, materials, two_days)[:, order]).all()


def test_lanes_equal_their_scalar_twin(opencl, table, two_days):
    lit = np.random.default_rng(10).random((193, 22)) < 0.5
    together = launch(opencl, 16, *table, two_days, lit=lit)
    alone = launch(opencl, 1, *table, two_days, lit=lit)

    # exp of a vector and of a scalar differ in their last digit; 768 sub-steps add it up
    assert abs(together - alone).max() < 1e-3


def test_the_mask_of_a_day_begins_anew_after_its_period(thermal, table, two_days):
    day = np.random.default_rng(11).random((96, 22)) < 0.5

    two = thermal(*table, two_days, lit=day, period=96)

    assert (two == thermal(*table, two_days, lit=np.concatenate([day, day, day[:1]]))).all()


def test_power_by_the_clock_is_that_of_the_facet_s_material(thermal):
    facets, materials = one_facet(0.01, 0.5)
    facets, materials = np.repeat(facets, 3), np.repeat(materials, 2)
    facets["material"] = (0, 1, 0)
    facets["stated_temperature_k"][2] = 281.0
    power = np.zeros((400, 2), np.float32)
    power[:, 1] = 150.0

    last = thermal(facets, materials, steady_forcing(400, convection_w_m2_k=10.0), power=power)[-1]

    assert last == pytest.approx([290.0, 305.0, 281.0], abs=1e-3)  # 150 W/m2 over 10 W/m2/K


def test_power_goes_on_and_off_midway_between_two_steps(thermal):
    facets, materials = one_facet(1e5 / (2114 * 920), 0.5)  # 1e5 J/m2/K and nothing exchanged
    power = np.zeros((41, 1), np.float32)
    power[10:20] = 100.0

    last = thermal(facets, materials, steady_forcing(41), power=power)[-1, 0]

    assert last == pytest.approx(290.0 + 100.0 * 10 * STEP_S / 1e5, abs=1e-2)


def test_a_time_between_steps_is_linear(thermal, table, two_days):
    full = thermal(*table, two_days)

    row = thermal(*table, two_days, first=61, rows=1, weight=0.25)[0]

    assert row == pytest.approx(full[60] + 0.25 * (full[61] - full[60]), abs=1e-4)  # ulps at 300


def test_a_stated_temperature_stays(thermal, table, two_days):
    facets = table[0].copy()
    facets["stated_temperature_k"][3] = 295.5

    assert (thermal(facets, table[1], two_days)[:, 3] == np.float32(295.5)).all()


def test_a_lump_relaxes_exponentially(thermal):
    facets, materials = one_facet(0.05, 0.5)
    forcing = steady_forcing(40, convection_w_m2_k=15.0)
    forcing["air_temperature_k"][1:] = 390.0

    excess = 390.0 - thermal(facets, materials, forcing)[1:, 0].astype(float)

    decay = 15.0 * STEP_S / (2114 * 920 * 0.05)
    assert excess == pytest.approx(excess[0] * np.exp(-decay * np.arange(39)), abs=1e-5 * excess[0])


def test_a_black_plate_cools_from_400_to_300_k_in_12587_s(thermal):
    facets, materials = one_facet(1e5 / (2114 * 920), 0.5, thermal_emissivity=1.0)
    forcing = steady_forcing(20)
    forcing["sky_longwave_w_m2"][0] = SIGMA * 400.0**4

    temperature = thermal(facets, materials, forcing)[:, 0].astype(float)

    assert temperature[0] == pytest.approx(400.0, abs=1e-3)
    at_300_k = np.interp(-300.0, -temperature, STEP_S * np.arange(20))
    # The sky fades over the first step, which costs half of it. C / 3 sigma (300^-3 - 400^-3).
    assert at_300_k - STEP_S / 2 == pytest.approx(12587.08, rel=0.005)


@pytest.mark.parametrize("fraction, expected_k", [(1.0, 393.606), (0.25, 278.321)])
def test_a_black_plate_in_1361_w_m2_starts_at_393_6_k_and_a_sphere_at_278_3(
        thermal, fraction, expected_k):
    """(fraction x 1361 / sigma)^(1/4); of a sphere a quarter is in the sun."""
    facets, materials = one_facet(0.01, 0.5, thermal_emissivity=1.0, solar_absorptance=1.0)

    start = thermal(facets, materials, steady_forcing(2, direct_w_m2=1361.0 * fraction))[0, 0]

    assert start == pytest.approx(expected_k, abs=2e-3)


def test_a_slab_with_both_faces_in_air_starts_with_its_conductances_in_series(thermal):
    facets, materials = one_facet(0.1, -1.0, solar_absorptance=1.0)

    start = thermal(facets, materials,
                    steady_forcing(2, direct_w_m2=500.0, convection_w_m2_k=12.0))[0, 0]

    through = 1 / (0.1 / 0.689 + 1 / 12.0)
    assert start == pytest.approx(290.0 + 500.0 / (12.0 + through), abs=1e-3)


@pytest.mark.parametrize("thickness_m, gain, lag_h", [
    (0.024, 0.9672, 0.841), (0.05, 0.8549, 1.528), (0.20, 0.6417, 1.150)])
def test_a_slab_follows_a_daily_wave_of_the_air(thermal, thickness_m, gain, lag_h):
    facets, materials = one_facet(thickness_m, -0.5)
    hour = np.arange(20 * 96 + 1) * 0.25
    forcing = steady_forcing(len(hour), convection_w_m2_k=15.0)
    forcing["air_temperature_k"] = 290 + 10 * np.sin(2 * np.pi * hour / 24)

    surface = thermal(facets, materials, forcing)[-96:, 0].astype(float) - 290

    wave = np.mean(surface * np.exp(-2j * np.pi * hour[-96:] / 24)) * 2j / 10
    assert abs(wave) == pytest.approx(gain, rel=0.01)
    assert -np.angle(wave) * 24 / (2 * np.pi) == pytest.approx(lag_h, abs=4 / 60)


def test_a_slab_of_biot_number_one_cools_as_the_series_says(thermal):
    facets, materials = one_facet(0.5, -0.5)
    forcing = steady_forcing(1600, convection_w_m2_k=0.689 / 0.5)
    forcing["air_temperature_k"][0] = 390.0

    surface = (thermal(facets, materials, forcing)[:, 0].astype(float) - 290) / 100

    fourier = 0.689 / (2114 * 920 * 0.5**2) * STEP_S * (np.arange(1600) - 0.5)
    for number, expected in ((0.2, 0.6434), (0.5, 0.5045), (1.0, 0.3482), (2.0, 0.1661)):
        assert np.interp(number, fourier, surface) == pytest.approx(expected, abs=0.005)


@pytest.mark.parametrize("thickness_m, exposed_area, material", [
    (0.02, 0.5, {}), (0.1, -0.5, {}), (0.001, 0.5, {"conductivity_w_m_k": 54.0})],
    ids=["lump", "slab", "sheet"])
def test_energy_closes_over_a_day_as_therm_has_it(thermal, thickness_m, exposed_area, material):
    """Days alike: what the front takes in on the last of them it gives back, to .1 %."""
    facets, materials = one_facet(thickness_m, exposed_area, solar_absorptance=0.9, thermal_emissivity=0.9,
                                  **material)
    hour = np.arange(10 * 96 + 1) * 0.25
    forcing = steady_forcing(len(hour), convection_w_m2_k=12.0, sky_longwave_w_m2=300.0)
    forcing["direct_w_m2"] = 700 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24)) ** 2

    front = thermal(facets, materials, forcing)[-96:, 0].astype(float)

    absorbed = 0.9 * forcing["direct_w_m2"][-96:].astype(float)
    lost = 0.9 * (SIGMA * front**4 - 300.0) + 12.0 * (front - 290.0)
    assert lost.mean() == pytest.approx(absorbed.mean(), rel=1e-3)


def test_cold_rain_cools_a_level_facet_and_leaves_a_ceiling_dry(thermal):
    facets, materials = one_facet(0.05, 0.5)
    facets = np.repeat(facets, 2)
    facets["normal"][1] = (0, 0, -1)
    forcing = steady_forcing(2, convection_w_m2_k=10.0, rain_w_m2_k=5.0, rain_temperature_k=275.0)

    start = thermal(facets, materials, forcing)[0]

    # Weighted mean of 290 K air and 275 K rain.
    assert start == pytest.approx([(10 * 290 + 5 * 275) / 15, 290.0], abs=1e-3)


def test_a_two_sided_facet_takes_sun_from_behind(thermal):
    facets, materials = one_facet(0.01, 0.5, solar_absorptance=0.5)
    facets = np.repeat(facets, 2)
    facets["normal"] = (0, 0, -1)
    facets["two_sided"] = (0, 1)
    forcing = steady_forcing(2, convection_w_m2_k=10.0, direct_w_m2=200.0)

    one, two = thermal(facets, materials, forcing)[0]

    assert two - one == pytest.approx(0.5 * 200.0 / 10.0, abs=1e-3)


@pytest.mark.parametrize("fraction, direct_w_m2", [(255, 800), (102, 320), (0, 0)])
def test_a_share_of_the_sun_heats_as_that_much_less_of_it(thermal, fraction, direct_w_m2):
    facets, materials = one_facet(.05, -.4, solar_absorptance=.8, thermal_emissivity=.9)
    fractions = np.full((96, 1), fraction)

    dimmed = thermal(facets, materials, steady_forcing(150, direct_w_m2=800.0),
                     lit=np.ones((96, 1), np.uint64), fraction=fractions, period=96)

    clear = thermal(facets, materials, steady_forcing(150, direct_w_m2=direct_w_m2))
    assert dimmed == pytest.approx(clear, abs=1e-3)  # float32 kelvin
