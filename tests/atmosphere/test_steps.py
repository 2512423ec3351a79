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
sensor_altitude_m = {sensor}
wavenumber_cm1 = [{low}, {high}]
wavenumber_step_cm1 = 5.0
path_zenith_deg = [0.0, 60.0, 30.0]
{more}
"""


@pytest.fixture
def make(atmosphere, tmp_path):
    def run(more, low=800.0, high=1000.0, time="1987-06-24T12:00:00-05:00", name="out.radc", code=0, sensor=10000.0):
        (tmp_path / "scene.toml").write_text(SCENE.format(low=low, high=high, time=time, more=more, sensor=sensor))
        done = atmosphere("make", tmp_path / "scene.toml", "-o", tmp_path / name, code=code)
        run.said = done.stderr
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


BANDS_UM = {"lwir": (7.5, 14.0), "10": (10.0, 12.0), "8": (8.0, 9.3), "mwir": (3.0, 5.0), "3": (3.4, 4.1), "4": (4.5, 5.0)}


def band_radiance(air, tau, low_um, high_um):
    """Of a surface 20 K above the air, seen level: W m-2 sr-1."""
    nu = air["wavenumber"]
    inside = (1e4 / nu >= low_um) & (1e4 / nu <= high_um)
    black = planck(nu, AIR_K)
    return ((tau * planck(nu, AIR_K + 20) + (1 - tau) * black) / nu**2)[..., inside].sum(axis=-1)


AIR_K = 294.2  # midlatitude summer at the ground


@pytest.mark.parametrize("sensor_m, low, high, bands", [(10000.0, 700.0, 1340.0, ("lwir", "10", "8")), (10000.0, 1990.0, 3340.0, ("mwir", "3", "4")),
                                                        (2.0, 1990.0, 3340.0, ("mwir", "3", "4"))])
def test_ranges_that_are_chosen_err_by_half_a_per_cent_at_64_between_them(make, sensor_m, low, high, bands):
    """LOWTRAN at 64 ranges against ln tau linear between the database's, as a render takes it."""
    sight = lambda ranges: make(f"range_m = {ranges}\nsky_step_deg = {{ zenith = 45, azimuth = 180 }}", low=low, high=high, sensor=sensor_m)
    air = sight(30000)
    between = numpy.unique(numpy.round(numpy.geomspace(3, 29000, 86)))
    between = between[~numpy.isin(between, air["range"])][:64]
    truth = numpy.concatenate([sight(between[i:i + 16].tolist())["range_tau"] for i in range(0, 64, 16)])
    ranges, depth = numpy.r_[0, air["range"]], numpy.vstack([0 * air["range_tau"][:1], -numpy.log(numpy.maximum(air["range_tau"], 1e-30))])
    taken = numpy.exp(-numpy.array([numpy.interp(between, ranges, depth[:, i]) for i in range(depth.shape[1])]).T)

    assert len(air["range"]) == 16 and air["range"][[0, -1]].tolist() == [1, 30000] and len(truth) == 64
    for band in bands:
        assert band_radiance(air, taken, *BANDS_UM[band]) == pytest.approx(band_radiance(air, truth, *BANDS_UM[band]), rel=0.005)
    assert air["range_emitted"] == pytest.approx((1 - air["range_tau"]) * planck(air["wavenumber"], AIR_K), rel=2e-3, abs=1e-5)


def test_ranges_that_lie_far_apart_are_told(make, atmosphere):
    make("range_m = [1000, 10000]", low=1990.0, high=3340.0)
    said = make.said
    make("range_m = 10000", low=1990.0, high=3340.0)

    assert "range_m: between 0 and 1000 m the radiance of a surface 20 K above the air errs by" in said
    assert "range_m = 10000, the farthest alone" in said and "range_m" not in make.said


def test_show_lists_them(make, atmosphere):
    make("range_m = [1000]\ntarget_altitude_m = [2000]")
    said = atmosphere("show", make.path).stdout

    assert "target at 2000 m" in said and "level path of 1000 m" in said


@pytest.mark.parametrize("more, expected", [
    ("target_altitude_m = [2000, 1000]", "target_altitude_m: expected rising numbers"),
    ("target_altitude_m = [20000]", "target_altitude_m"),
    ("range_m = []", "range_m: found"),
    ("range_m = 5", "range_m: found"),
    ("range_m = [1.5, 20]", "range_m: found 1.5, expected whole metres"),
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
