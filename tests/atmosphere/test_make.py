"""radsig-atmosphere make: the radiance database of a scene."""

import pathlib
import subprocess

import numpy
import printed
import pytest
import radiance_database

ROOT = pathlib.Path(__file__).parents[2]
MODEL_2 = [(0, 1013.0, 294.2), (1, 902.0, 289.7), (2, 802.0, 285.2), (3, 710.0, 279.2), (4, 628.0, 273.2),
           (5, 554.0, 267.2), (6, 487.0, 261.2), (7, 426.0, 254.7), (8, 372.0, 248.2), (9, 324.0, 241.7),
           (10, 281.0, 235.3), (11, 243.0, 228.8), (12, 209.0, 222.3), (13, 179.0, 215.8), (14, 153.0, 215.7)]

SCENE = """name = "test"
[site]
latitude_deg = 39.773333
longitude_deg = -84.108888
time = {time}
[atmosphere.generate]
model = "midlatitude-summer"
sensor_altitude_m = 10000.0
wavenumber_cm1 = [{low}, {high}]
wavenumber_step_cm1 = {step}
path_zenith_deg = [0.0, 60.0, 30.0]
{more}
"""


def planck(wavelength_um, temperature_k):
    """W cm-2 sr-1 um-1, CODATA 2018."""
    c1, c2 = 1.191042972e8, 1.438776877e4
    return c1 / wavelength_um**5 / numpy.expm1(c2 / (wavelength_um * temperature_k)) / 1e4


@pytest.fixture
def make(atmosphere, tmp_path):
    def run(time="1987-06-24T12:00:00-05:00", low=740.0, high=1260.0, step=20.0, more="", name="out.rad", code=0, options=()):
        scene = tmp_path / "scene.toml"
        scene.write_text(SCENE.format(time=time, low=low, high=high, step=step, more=more))
        done = atmosphere("make", scene, "-o", tmp_path / name, *options, code=code)
        return done if code else radiance_database.read(tmp_path / name)

    run.folder = tmp_path
    return run


def write_sonde(path, levels, head="pressure_hpa,altitude_km,temperature_k"):
    path.write_text("\n".join([head, *(",".join(map(str, (p, z, t))) for z, p, t in levels)]) + "\n")


def test_golden_mode_gives_the_printed_sky(make):
    result = make(time="1987-06-24T17:00:00Z", low=750.0, high=1250.0, step=100.0, more='mode = "thesis"')

    for direction, values in printed.SKY.items():
        # the decks differ from the printed one in half a thousandth of a degree of latitude
        assert result["sky"][direction] == pytest.approx(numpy.array(values), rel=1e-5)
    assert result["integrated"][-2:] == pytest.approx(numpy.array(printed.INTEGRATED), rel=1e-5)


def test_the_airport_s_database_is_made_again_bit_for_bit(atmosphere, tmp_path):
    atmosphere("make", ROOT / "scenes/airport/scene.toml", "-o", tmp_path / "out.rad")

    assert (tmp_path / "out.rad").read_bytes() == (ROOT / "scenes/airport/june24_1500z.rad").read_bytes()


def test_transmissions_are_shares_and_the_air_is_opaque_at_15_um(make):
    result = make(low=600.0, high=1000.0)
    transmissions = numpy.concatenate([result["tau1"], result["path"][:, :, 0].ravel()])

    assert (transmissions >= 0).all() and (transmissions <= 1).all()
    at_15_um = numpy.argmin(abs(result["wavelength"] - 15.0))
    assert result["path"][:, at_15_um, 0].max() < 1e-3  # the carbon dioxide band's centre


def test_the_plausible_figures_of_a_summer_noon_are_met(make):
    result = make(more="ground_albedo = 0.03")
    at = numpy.argmin(abs(result["wavelength"] - 10.5))
    fine = numpy.linspace(8.0, 1e4 / 750, 2001)
    band = lambda rows: numpy.trapz(numpy.interp(fine, result["wavelength"], rows.sum(axis=1) * 1e4), fine)

    # measured on its own 26-point grid by another driver, three digits given
    assert result["path"][0, at, 0] == pytest.approx(0.702, abs=0.003)
    assert result["tau1"][at] == pytest.approx(0.690, abs=0.003)
    assert band(result["sky"][0, 0]) == pytest.approx(17.2, rel=0.005)
    assert band(result["sky"][90, 0]) == pytest.approx(44.0, rel=0.005)


def test_by_night_every_solar_term_is_zero_and_the_thermal_ones_stay(make):
    night = make(time="1987-06-24T01:00:00-05:00")
    noon = make()

    assert night["sun"].max() == 0 and night["tau1"].max() == 0
    assert night["path"][:, :, 2].max() == 0 and night["integrated"][:, 1].max() == 0
    assert radiance_database.sky_array(night)[..., 1].max() == 0
    assert night["path"][:, :, 1] == pytest.approx(noon["path"][:, :, 1], rel=1e-6)  # the same air
    assert radiance_database.sky_array(night)[..., 0] == pytest.approx(radiance_database.sky_array(noon)[..., 0], rel=1e-6)


def test_a_database_of_sunlight_by_night_is_warned_about(make, atmosphere):
    make(time="1987-06-24T01:00:00-05:00", low=14000.0, high=14100.0)
    done = atmosphere("make", make.folder / "scene.toml", "-o", make.folder / "out.rad")

    assert "below the horizon" in done.stderr and "choose another time" in done.stderr


@pytest.mark.parametrize("mode, share", [("exact", 1.0), ("thesis", 0.9770)])
def test_an_isotropic_sky_integrates_to_its_share(make, mode, share):
    # 667 cm-1 at 300 K: the air is so opaque that every direction shows its first metres
    write_sonde(make.folder / "hot.csv", [(z, p, 300.0) for z, p, _ in MODEL_2])
    result = make(low=660.0, high=680.0, step=10.0, more=f'mode = "{mode}"\nradiosonde = "hot.csv"')
    sky = radiance_database.sky_array(result)[..., 1, 0]

    assert sky.max() / sky.min() == pytest.approx(1.0, abs=2e-4)  # isotropic indeed
    assert result["integrated"][1, 0] / sky.mean() == pytest.approx(share, abs=2e-4)  # 3.0695 / pi


def isothermal_deck(itype, card_3):
    levels = [f"{z:10.3f}{p:10.3f}{350.0:10.3f}" + 3 * f"{0.0:10.3f}" + "AA" + 12 * "2" for z, p, _ in MODEL_2]
    levels += [f"{z:10.3f}{p:10.3E}{350.0:10.3f}" + 3 * f"{0.0:10.3f}" + "AA" + 12 * "2"
               for z, p in [(20, 59.5), (30, 13.2), (50, 0.951), (100, 0.000258)]]
    return "\n".join([
        f"    7{itype:5d}    2    0" + 6 * "    2" + "    1    1    1  -1.000   0.00",
        "    1    0    0    1    0    0     0.000     0.000     0.000     0.000     0.000",
        f"{len(levels):5d}    0    0isothermal", *levels, card_3,
        "    2    2  175    0",
        "    10.000    37.000     0.000     0.000     0.000     0.000     0.000     0.000",
        "   730.000  1270.000     5.000", "    0", ""])


@pytest.mark.parametrize("itype, card_3", [
    (2, "    10.000     0.000   134.000     0.000     0.000     0.000    0"),
    (3, "     0.000     0.000    45.000     0.000     0.000     0.000    0"),
])
def test_an_isothermal_path_emits_what_it_absorbs(atmosphere, tmp_path, itype, card_3):
    (tmp_path / "0.cdk").write_text(isothermal_deck(itype, card_3))
    atmosphere("deck", tmp_path / "0.cdk", "-o", tmp_path / "out.runs")
    result = radiance_database.read(tmp_path / "out.runs")
    emitted = result["path"][0][:, 1] if itype == 2 else result["sky"][45, 10][:, 0]
    tau = result["path"][0][:, 0] if itype == 2 else result["tau1"]

    # so that L_uE + tau2 B = B; LOWTRAN's constants of Planck's law are older
    assert emitted == pytest.approx((1 - tau) * planck(result["wavelength"], 350.0), rel=2e-4)


def direct_sun(atmosphere, folder, zenith):
    """Direct normal irradiance from .4 to 4 um, W m-2, US standard atmosphere, 100 km visibility, 4 April."""
    (folder / "0.cdk").write_text(
        "    6    3    3    0    0    0    0    0    0    0    0    0    1   0.000   0.00\n"
        "    1    0    0    1    0    0   100.000     0.000     0.000     0.000     0.000\n"
        f"     0.000     0.000{zenith:10.3f}   94          0.000    0     0.000\n"
        "  2500.000 25000.000    20.000\n    0\n")
    atmosphere("deck", folder / "0.cdk", "-o", folder / "out.runs")
    result = radiance_database.read(folder / "out.runs")
    return numpy.trapz(result["sun"] * result["tau1"] * 1e4, result["wavelength"])


def test_the_clear_sun_is_that_of_astm_g173(atmosphere, tmp_path):
    # ASTM G173-03, direct normal, .4 to 4 um, air mass 1.5
    assert direct_sun(atmosphere, tmp_path, 48.19) == pytest.approx(870.0, rel=0.02)


# pvlib 0.16.1, spectrum.spectrl2: 1013.25 hPa, 1.42 cm water, .344 cm ozone, turbidity .10 at 500 nm, day 94
@pytest.mark.parametrize("zenith, expected", [(20.0, 935.1), (48.19, 867.8), (70.0, 700.7)])
def test_the_clear_sun_is_that_of_spectrl2(atmosphere, tmp_path, zenith, expected):
    # spectrl2 is a simple model and its aerosol is another one
    assert direct_sun(atmosphere, tmp_path, zenith) == pytest.approx(expected, rel=0.15)


def test_a_kept_deck_gives_what_the_database_holds(make, atmosphere):
    result = make(low=800.0, high=900.0, step=5.0, options=["--keep-decks", make.folder / "decks"])
    atmosphere("deck", make.folder / "decks/sky_45.000_090.000.cdk", "-o", make.folder / "one.runs")
    one = radiance_database.read(make.folder / "one.runs")

    assert (list(one["sky"].values())[0] == result["sky"][45, 90]).all()


def test_a_model_s_own_profile_as_a_radiosonde_changes_nothing(make):
    model = make()
    write_sonde(make.folder / "model.csv", MODEL_2)
    sonde = make(more='radiosonde = "model.csv"')

    # pressures are stated to three digits
    assert sonde["path"][:, :, :2] == pytest.approx(model["path"][:, :, :2], rel=1e-3)


def test_a_sounding_of_hundreds_of_levels_is_thinned(make):
    model = make()
    altitude = numpy.arange(0.0, 14.01, 0.05)
    z, p, t = numpy.array(MODEL_2).T
    write_sonde(make.folder / "long.csv", [(a, numpy.exp(numpy.interp(a, z, numpy.log(p))), numpy.interp(a, z, t))
                                           for a in altitude])
    sonde = make(more='radiosonde = "long.csv"')

    # linear between the model's own levels
    assert len(sonde["profile"]) <= 34
    assert sonde["path"][:, :, :2] == pytest.approx(model["path"][:, :, :2], rel=5e-3, abs=1e-9)


WYOMING = """72426 Somewhere Observations at 12Z 24 Jun 1987

-----------------------------------------------------------------------------
   PRES   HGHT   TEMP   DWPT   RELH   MIXR   DRCT   SKNT   THTA   THTE   THTV
    hPa     m      C      C      %    g/kg    deg   knot     K      K      K
-----------------------------------------------------------------------------
 1020.0    -50
 1013.0      0   17.0   14.0     82  10.00    240      3  290.0  318.0  292.0
  902.0   1000   16.0    8.0     59   7.50    250     10  298.0  320.0  299.0
  802.0   2000   12.0    2.0     50   5.50    250     15  303.0  320.0  304.0
  554.0   5000   -6.0  -20.0     32   1.50    260     20  316.0  321.0  316.3
  281.0  10000  -38.0  -50.0     26   0.20    270     30  338.0  338.8  338.0

Station information and sounding indices
"""


def test_a_sounding_in_the_wyoming_layout_is_the_profile(make):
    (make.folder / "sonde.txt").write_text(WYOMING)
    result = make(more='radiosonde = "sonde.txt"')

    assert result["profile"][:5].tolist() == [[0, 290.15], [1, 289.15], [2, 285.15], [5, 267.15], [10, 235.15]]
    assert result["profile"][-1, 0] == 100


def test_the_hour_s_weather_bends_the_profile_below_the_inversion(make):
    (make.folder / "sonde.txt").write_text(WYOMING)
    weather = """[weather]
air_temperature_sunrise_c = 15.0
air_temperature_peak_c = 29.0
peak_time_h = 15.0
relative_humidity_sunrise = 0.9
wind_m_s = 2.0
"""
    result = make(time="1987-06-24T15:00:00-05:00",
                  more='radiosonde = "sonde.txt"\ninversion_altitude_m = 2000.0\n' + weather)

    # 29 C at the ground at the hour of the peak; 2 km stays; 1 km lies on the line between them
    assert result["profile"][0, 1] == pytest.approx(302.15, abs=0.05)
    at_1_km = result["profile"][:, 0].searchsorted(1.0)
    assert numpy.interp(1.0, *result["profile"][:4].T) == pytest.approx((302.15 + 285.15) / 2, abs=0.05), at_1_km


def test_the_hour_s_weather_bends_a_model_s_profile_too(make):
    weather = 'inversion_altitude_m = 1500.0\n[weather]\nair_temperature_sunrise_c = 15.0\n' \
              'air_temperature_peak_c = 29.0\npeak_time_h = 15.0\nrelative_humidity_sunrise = 0.9\nwind_m_s = 2.0\n'
    result = make(time="1987-06-24T15:00:00-05:00", more=weather)
    at_inversion = (289.7 + 285.2) / 2  # of the model, between 1 and 2 km
    levels = dict(result["profile"].tolist())

    assert levels[0] == pytest.approx(302.15, abs=0.05)
    assert levels[1] == pytest.approx(302.15 + (at_inversion - 302.15) / 1.5, abs=0.05)
    assert levels[1.5] == pytest.approx(at_inversion, abs=0.01)
    assert [levels[z] for z, _, t in MODEL_2[2:]] == [t for _, _, t in MODEL_2[2:]]


def test_a_model_bent_to_its_own_surface_stays_as_it_is(make):
    # mid-latitude summer: 294.2 K and 14 g/m3 of water at sea level (McClatchey and others 1972): 19.0 hPa,
    # and 23.4 hPa saturate 20 C
    weather = 'inversion_altitude_m = 1000.0\n[weather]\nair_temperature_sunrise_c = 20.0\n' \
              'air_temperature_peak_c = 21.05\npeak_time_h = 15.0\nrelative_humidity_sunrise = 0.813\nwind_m_s = 2.0\n'
    time = "1987-06-24T15:00:00-05:00"
    model, bent = make(time=time), make(time=time, more=weather)

    # LOWTRAN's saturation density is good to 1 %
    assert bent["path"][..., 0] == pytest.approx(model["path"][..., 0], rel=0.01, abs=1e-3)
    assert bent["integrated"][:, 0] == pytest.approx(model["integrated"][:, 0], rel=0.003)


def henyey_greenstein(degrees, g):
    return (1 - g**2) / (4 * numpy.pi * (1 + g**2 - 2 * g * numpy.cos(numpy.radians(degrees))) ** 1.5)


def test_a_table_of_henyey_greenstein_is_henyey_greenstein(make):
    angles = numpy.unique(numpy.concatenate([numpy.arange(0, 30, 1.5), numpy.arange(30, 181, 6)]))
    (make.folder / "phase.txt").write_text("".join(f"{a} {henyey_greenstein(a, 0.6):.6e}\n" for a in angles))
    visible = dict(low=14000.0, high=16000.0, step=1000.0)
    sampled = "sample_step_cm1 = 1000.0\n"
    table = make(**visible, more=sampled + 'phase_function = "table"\nphase_table = "phase.txt"')
    stated = make(**visible, more=sampled + 'phase_function = "henyey-greenstein"\nasymmetry = 0.6')
    mie = make(**visible, more=sampled)

    # LOWTRAN interpolates the table between its angles
    assert table["integrated"][:, 1] == pytest.approx(stated["integrated"][:, 1], rel=0.01)
    assert mie["integrated"][0, 1] != pytest.approx(stated["integrated"][0, 1], rel=0.005)


def test_radsig_checks_the_table_too(tmp_path):
    text = (ROOT / "scenes/airport/scene.toml").read_text()
    (tmp_path / "scene.toml").write_text(text.replace("sky_step_deg =", "sky_steps_deg ="))
    done = subprocess.run([ROOT / "build/radsig", "check", tmp_path / "scene.toml"], capture_output=True, text=True)

    assert done.returncode == 1
    assert "atmosphere.generate.sky_steps_deg: unknown key" in done.stderr


@pytest.mark.parametrize("old, new, expected", [
    ("[site]", "[somewhere]", "[site]: the table is missing"),
    ("latitude_deg = 39.773333\n", "", "latitude_deg: missing"),
    ("model =", "modle =", "modle: unknown key"),
    ("midlatitude-summer", "midsummer", 'expected "tropical"'),
    ("wavenumber_step_cm1 = 20.0", "wavenumber_step_cm1 = 7.0", "expected multiples of 5"),
    ("sensor_altitude_m = 10000.0\n", "", "sensor_altitude_m"),
    ("[0.0, 60.0, 30.0]", "[0.0, 60.0, 25.0]", "a whole number of steps"),
    ("[atmosphere.generate]", "[atmosphere.generator]", "[atmosphere.generate]: the table is missing"),
    ("[0.0, 60.0, 30.0]", '[0.0, 60.0, 30.0]\nradiosonde = "none.csv"', "none.csv"),
    ("[0.0, 60.0, 30.0]", "[0.0, 60.0, 30.0]\ninversion_altitude_m = 1500.0", "[weather]: the table is missing"),
    ("[0.0, 60.0, 30.0]", '[0.0, 60.0, 30.0]\nphase_function = "henyey-greenstein"', "asymmetry: missing"),
])
def test_a_broken_scene_is_explained(make, atmosphere, old, new, expected):
    scene = make.folder / "scene.toml"
    text = SCENE.format(time="1987-06-24T12:00:00-05:00", low=740.0, high=1260.0, step=20.0, more="")
    assert old in text
    scene.write_text(text.replace(old, new))
    done = atmosphere("make", scene, "-o", make.folder / "out.rad", code=1)

    assert expected in done.stderr
    assert not (make.folder / "out.rad").exists()


@pytest.mark.parametrize("text, expected", [
    ("pressure,altitude_m,temperature_c\n1000,0,20\n", "columns with units"),
    ("pressure_hpa,altitude_m\n1000,0\n", "all of the columns"),
    ("pressure_hpa,altitude_m,temperature_c\n1000,0,20\n900,-10,15\n", "sonde:3"),
    ("pressure_hpa,altitude_m,temperature_c\n1000,0,20\n", "at least two levels"),
    ("pressure_hpa,altitude_m,temperature_c,dew_point_c\n1000,0,20,25\n", "a dew point up to the temperature"),
    ("pressure_hpa,altitude_m,temperature_c,relative_humidity_percent\n1000,0,20,150\n", "a relative humidity up to 100"),
    ("pressure_hpa,altitude_m,temperature_c\n900,1000,20\n500,5000,0\n", "ground_altitude_m"),
    (WYOMING.replace("hPa", "psi"), "the units hPa m C C"),
    ("a letter to a friend\n", "PRES HGHT TEMP DWPT"),
])
def test_a_broken_sounding_is_explained(make, text, expected):
    (make.folder / "sonde").write_text(text)

    assert expected in make(more='radiosonde = "sonde"', code=1).stderr
