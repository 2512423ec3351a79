"""radsig-atmosphere show: what a database holds, in words and pictures."""

import pathlib

import numpy
import pytest
import radiance_database

from png import read_png

SHIPPED = pathlib.Path(__file__).parents[2] / "scenes" / "atmosphere"
DISC = dict(x=240, y=270, radius=200)  # of the sky's picture


def plot(atmosphere, folder, name):
    atmosphere("show", SHIPPED / name, "--plot", folder / "air")
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def brightness(picture, zenith, azimuth):
    """The colours' sum rises all along the map."""
    radius, angle = DISC["radius"] * zenith / 90, numpy.radians(azimuth)
    x, y = DISC["x"] + radius * numpy.sin(angle), DISC["y"] - radius * numpy.cos(angle)
    return picture[round(y), round(x)].sum() / 255


def test_a_day_is_drawn_in_six_pictures_the_same_each_time(atmosphere, tmp_path):
    first = plot(atmosphere, tmp_path, "june24_noon.radc")
    second = plot(atmosphere, tmp_path, "june24_noon.radc")

    assert sorted(first) == [f"air_{x}.png" for x in ("emitted", "path", "scattered", "sky", "sun", "tau")]
    assert all(content[:8] == b"\x89PNG\r\n\x1a\n" for content in first.values())
    assert first == second


def test_by_night_no_sunlight_is_drawn(atmosphere, tmp_path):
    pictures = plot(atmosphere, tmp_path, "january_night.radc")

    assert sorted(pictures) == ["air_emitted.png", "air_path.png", "air_sky.png", "air_tau.png"]


def test_a_bright_direction_stands_where_it_lies_in_the_sky(atmosphere, tmp_path):
    plot(atmosphere, tmp_path, "june24_1500z_vis.radc")
    picture = read_png(tmp_path / "air_scattered.png")
    sky = radiance_database.read_container(SHIPPED / "june24_1500z_vis.radc")["sky"][..., 1].sum(axis=2)
    zenith, azimuth = numpy.unravel_index(sky.argmax(), sky.shape)
    zenith, azimuth = 5 * zenith, 15 * azimuth

    assert brightness(picture, zenith, azimuth) > 2.0  # near white; black is 0
    assert brightness(picture, zenith, azimuth) > 1.3 * brightness(picture, zenith, azimuth + 60)
    assert brightness(picture, zenith, azimuth) > 1.3 * brightness(picture, zenith, azimuth - 60)


def test_the_thermal_sky_is_brightest_at_the_rim(atmosphere, tmp_path):
    plot(atmosphere, tmp_path, "june24_lwir_10.radc")
    picture = read_png(tmp_path / "air_emitted.png")

    for azimuth in (5, 95, 185, 275):
        row = [brightness(picture, zenith, azimuth) for zenith in (2, 40, 65, 85)]
        assert row == sorted(row) and row[-1] > row[0] + 1


def test_a_wide_range_of_wavelengths_has_a_logarithmic_axis(atmosphere, tmp_path):
    plot(atmosphere, tmp_path, "june24_noon.radc")
    row = read_png(tmp_path / "air_tau.png")[62]  # below the frame's top, above all curves
    lines = numpy.flatnonzero((row == 215).all(axis=-1))
    first, last = 1e4 / 24980, 1e4 / 500

    # the axis begins in column 64 and is 710 wide
    assert lines.tolist() == [64 + round(709 * numpy.log(x / first) / numpy.log(last / first)) for x in (0.5, 1, 2, 5, 10, last)]


def test_the_summary_fits_on_a_page(atmosphere):
    said = atmosphere("show", SHIPPED / "june24_noon.radc").stdout

    assert "sha256 of lowtran7.f" in said and "sky at 90 degrees, north" in said
    assert "path_05.000" not in said and len(said.splitlines()) < 50


@pytest.mark.parametrize("arguments, code, expected", [
    (["{file}", "--plot", "{folder}/absent/air"], 1, "absent/air_sky.png: No such file or directory"),
    (["{file}", "--plot"], 2, "needs a value"),
    (["{file}", "-o", "x.rad"], 2, "unknown option '-o'"),
    (["{folder}/none.rad"], 1, "none.rad"),
])
def test_what_cannot_be_shown_is_explained(atmosphere, tmp_path, arguments, code, expected):
    given = [a.format(file=SHIPPED / "january_night.radc", folder=tmp_path) for a in arguments]

    assert expected in atmosphere("show", *given, code=code).stderr
    assert list(tmp_path.iterdir()) == []
