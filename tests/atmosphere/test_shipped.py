"""The databases under scenes/atmosphere."""

import pathlib

import numpy
import pytest
import radiance_database

ROOT = pathlib.Path(__file__).parents[2]
SHIPPED = ROOT / "scenes" / "atmosphere"


def test_the_shipped_files_fit_in_6_mb():
    databases = [path for kind in ("rad", "radc") for path in SHIPPED.parent.glob(f"*/*.{kind}")]

    assert len(databases) > 30
    assert sum(path.stat().st_size for path in [*databases, *SHIPPED.glob("*.ext"), *SHIPPED.glob("*.csv")]) < 6e6


@pytest.mark.parametrize("path", sorted(SHIPPED.parent.glob("*/*.radc")), ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_a_container_is_whole_and_its_integral_is_that_of_its_sky(path):
    database = radiance_database.read_container(path)
    sky = database["sky"]
    zenith = numpy.radians(numpy.linspace(0, 90, sky.shape[0]))
    fine = numpy.linspace(0, numpy.pi / 2, 2001)
    ring = sky[:, :-1].mean(axis=1)
    weigh = lambda i, k: numpy.trapz(2 * numpy.interp(fine, zenith, ring[:, i, k]) * numpy.sin(fine) * numpy.cos(fine), fine)
    middle = sky.shape[2] // 2

    assert sky.min() >= 0 and (sky[:, 0] == sky[:, -1]).all()  # azimuth 360 is 0
    for k in range(2):
        # float32 numbers, a trapezoid of 2000 steps
        assert database["integrated"][middle, k] == pytest.approx(weigh(middle, k), rel=1e-5)


FINE = """name = "fine"
[site]
latitude_deg = 39.773333
longitude_deg = -84.108888
time = {time}
[atmosphere.generate]
model = "midlatitude-{season}"
sensor_altitude_m = 10000.0
sensor_azimuth_deg = 45.0
path_zenith_deg = [0.0, 0.0, 1.0]
ground_albedo = {albedo}
wavenumber_cm1 = [{low}, {high}]
wavenumber_step_cm1 = {step}
sample_step_cm1 = {sample}
sky_step_deg = {{ zenith = 2.5, azimuth = {azimuth} }}
"""


@pytest.mark.parametrize("name, albedo, low, high, sample, azimuth", [
    ("june24_lwir_10", 0.03, 900, 920, 5, 30),  # alike in all azimuths
    ("june24_1500z_mwir", 0.1, 2600, 2620, 5, 10),
    ("june24_1500z_vis", 0.15, 18000, 18200, 100, 5),
    ("january_night", 0.1, 900, 920, 5, 90),
    ("january_night", 0.1, 2600, 2620, 5, 90),
])
def test_the_sky_of_a_shipped_table_is_that_of_2_5_degrees(atmosphere, tmp_path, name, albedo, low, high, sample, azimuth):
    shipped = radiance_database.read_container(SHIPPED / f"{name}.radc")
    season, time = ("winter", "1987-01-15T23:00:00-05:00") if name == "january_night" else ("summer", "1987-06-24T10:00:00-05:00")
    (tmp_path / "scene.toml").write_text(
        FINE.format(season=season, time=time, albedo=albedo, low=low, high=high, step=high - low, sample=sample, azimuth=azimuth))
    atmosphere("make", tmp_path / "scene.toml", "-o", tmp_path / "fine.rad")
    fine = radiance_database.read(tmp_path / "fine.rad")
    at = [int(numpy.flatnonzero(shipped["wavenumber"] == nu)[0]) for nu in (high, low)]

    assert shipped["integrated"][at].sum(axis=1) == pytest.approx(1e4 * fine["integrated"].sum(axis=1), rel=0.01)


@pytest.mark.parametrize("name", ["june24_1500z_vis", "june24_lwir_10"])  # the bands of the scene
def test_the_sky_of_the_clouds_is_that_of_the_finer_tables(name):
    clouds = radiance_database.read_container(SHIPPED.parent / "cloud/june24_1500z.radc")
    finer = radiance_database.read_container(SHIPPED / f"{name}.radc")
    fine = numpy.linspace(*(1e4 / finer["wavenumber"][[1, -2]]), 5000)
    band = lambda air: numpy.trapz(numpy.interp(fine, 1e4 / air["wavenumber"], air["integrated"].sum(axis=1)), fine)

    # the finer tables themselves are checked above
    assert band(clouds) == pytest.approx(band(finer), rel=0.005)


def test_a_shipped_database_is_made_again_bit_for_bit(atmosphere, tmp_path):
    for name in ("appendix_a.rad", "june24_lwir_12.radc"):
        scene = SHIPPED / {"appendix_a.rad": "appendix_a.toml"}.get(name, "june24_lwir.toml")
        atmosphere("make", scene, "-o", tmp_path / name)
        assert (tmp_path / name).read_bytes() == (SHIPPED / name).read_bytes()


def test_a_shipped_cloud_is_made_again_bit_for_bit(atmosphere, tmp_path):
    atmosphere("cloud", "stratus", "-o", tmp_path / "stratus.ext")
    for name in ("stratus.ext", "stratus.scattering.csv"):
        assert (tmp_path / name).read_bytes() == (SHIPPED / name).read_bytes()
