"""Paths to targets above the ground, and level ones along it."""

import re

import numpy
import pytest
import radiance_database

SCENE = """name = "steps"
[site]
latitude_deg = 39.773333
longitude_deg = -84.108888
time = {time}
[atmosphere.generate]
model = "midlatitude-summer"
sensor_altitude_m = 10000.0
wavenumber_cm1 = [{low}, {high}]
wavenumber_step_cm1 = 5.0
path_zenith_deg = [0.0, 60.0, 30.0]
{more}
"""


@pytest.fixture
def make(atmosphere, tmp_path):
    def run(more, low=800.0, high=1000.0, time="1987-06-24T12:00:00-05:00", name="out.radc", code=0):
        (tmp_path / "scene.toml").write_text(SCENE.format(low=low, high=high, time=time, more=more))
        done = atmosphere("make", tmp_path / "scene.toml", "-o", tmp_path / name, code=code)
        return done if code else radiance_database.read_container(tmp_path / name)

    run.path = tmp_path / "out.radc"
    return run


def planck(wavenumber_cm1, temperature_k):
    """W m-2 sr-1 um-1, CODATA 2018."""
    wavelength_um = 1e4 / wavenumber_cm1
    return 1.191042972e8 / wavelength_um**5 / numpy.expm1(1.438776877e4 / (wavelength_um * temperature_k))


def test_a_target_a_metre_up_has_the_ground_s_paths(make):
    air = make("target_altitude_m = [1.0]")

    # the lowest metre of 10 km, in which a 6000th of the water lies
    assert air["target_tau"][0] == pytest.approx(air["path_tau"], rel=1e-3)
    assert air["target_emitted"][0] == pytest.approx(air["path_emitted"], rel=1e-3)
    assert air["target_scattered"][0] == pytest.approx(air["path_scattered"], rel=2e-3)


def test_higher_targets_have_shorter_clearer_paths(make):
    air = make("target_altitude_m = [500, 2000, 5000, 9000]")

    assert air["target_range"][:, 0] == pytest.approx([9500, 8000, 5000, 1000], abs=1)
    assert (numpy.diff(air["target_tau"], axis=0) > 0).all()
    assert (numpy.diff(air["target_emitted"], axis=0) < 0).all()


def test_a_level_path_emits_what_it_absorbs_at_the_ground_s_temperature(make):
    air = make("range_m = [100, 1000, 5000, 20000]")

    assert air["range"].tolist() == [100, 1000, 5000, 20000]
    # LOWTRAN's constants of Planck's law are older
    assert air["range_emitted"] == pytest.approx((1 - air["range_tau"]) * planck(air["wavenumber"], 294.2), rel=5e-4)


def test_sunlight_along_a_level_path_of_pure_air_is_rayleigh_s(make):
    air = make('aerosol = "none"\nrange_m = [1000, 10000]', low=11450.0, high=11550.0)  # little water vapour
    zenith, azimuth = (numpy.radians(float(x)) for x in re.search(
        rb"Sun: zenith angle (\S+), azimuth (\S+) ", make.path.read_bytes()).groups())
    cosine = numpy.sin(zenith) * numpy.cos(azimuth - numpy.pi)  # the camera looks south, away from the sensor
    phase = 3 / (16 * numpy.pi) * (1 + cosine**2)
    expected = air["sun"] * air["tau1"] * phase * (1 - air["range_tau"])

    # light scattered more than once adds some percent, what vapour absorbs takes some
    assert air["range_scattered"].mean(axis=1) == pytest.approx(expected.mean(axis=1), rel=0.12)


def test_by_night_no_sunlight_is_in_any_of_them(make):
    air = make("range_m = [1000]\ntarget_altitude_m = [1000]", time="1987-06-24T01:00:00-05:00")

    assert air["range_scattered"].max() == 0 and air["target_scattered"].max() == 0
    assert air["range_emitted"].min() > 0 and air["target_emitted"].min() > 0


def test_show_lists_them(make, atmosphere):
    make("range_m = [1000]\ntarget_altitude_m = [2000]")
    said = atmosphere("show", make.path).stdout

    assert "target at 2000 m" in said and "level path of 1000 m" in said


@pytest.mark.parametrize("more, expected", [
    ("target_altitude_m = [2000, 1000]", "target_altitude_m: expected rising numbers"),
    ("target_altitude_m = [20000]", "target_altitude_m"),
    ("range_m = []", "range_m: found"),
    ("range_m = 5000", "range_m: found"),
    ('range_m = [0]', "range_m"),
    ('mode = "thesis"\nrange_m = [1000]', 'mode "thesis" has neither'),
])
def test_broken_steps_are_explained(make, more, expected):
    assert expected in make(more, code=1).stderr


def test_a_text_file_has_no_place_for_them(make):
    assert ".radc" in make("range_m = [1000]", name="out.rad", code=1).stderr


@pytest.mark.parametrize("old, new, expected", [
    (b'"range_count": 1', b'"range_count": 9', "bytes of numbers"),
    (b'"range_count": 1', b'"range_count": 0', "range_count: found 0"),
    (b'"target_count": 1', b'"target_count": 2', "bytes of numbers"),
])
def test_a_container_whose_counts_do_not_fit_is_explained(make, atmosphere, old, new, expected):
    make("range_m = [1000]\ntarget_altitude_m = [2000]")
    data = make.path.read_bytes()
    assert old in data
    make.path.write_bytes(data.replace(old, new))

    assert expected in atmosphere("show", make.path, code=1).stderr
