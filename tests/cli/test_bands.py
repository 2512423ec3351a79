"""Responses of bands, and series of them, against quadrature in double."""
import os

import exr
import numpy as np
import pytest

BAND = 2e-4
BLACK = [{"name": "wall", "emissivity": 1.0, "temperature_k": 300.0}]


def weighted(radiance, points_um, values, temperature_k=300.0):
    """Planck's law times a table that is linear in wavelength, piece by piece."""
    values = np.asarray(values, float) / max(values)
    return sum(radiance.integral(
        lambda um: radiance.planck(um, temperature_k) * np.interp(um, points_um, values), a, b)
        for a, b in zip(points_um, points_um[1:]))


@pytest.mark.parametrize("heading, scale", [
    ("wavelength_um", lambda um: um), ("wavelength_nm", lambda um: 1000 * um),
    ("wavenumber_cm1", lambda um: 1e4 / um)])
def test_a_tabulated_response_is_integrated(program, radiance, tmp_path, heading, scale):
    um, values = np.array([7.9, 8.05, 8.4, 11.9, 12.34]), [0, 3, 2.5, 4, 0]
    rows = "".join(f"{x!r},{v}\n" for x, v in zip(scale(um).tolist(), values))
    (tmp_path / "filter.csv").write_text(f"# a filter\n{heading},response\n{rows}")

    got = program.render(tmp_path, band=[{"name": "b", "response": "filter.csv"}])

    expected = weighted(radiance, um, values)
    assert got.planes["radiance_b"] == pytest.approx(expected, rel=BAND)
    width = float(got.header["fwhm"][0])
    assert width == pytest.approx(np.trapz(np.array(values) / 4, um), rel=1e-6)


# the last one is narrower than the steps of 2 cm-1
@pytest.mark.parametrize("centre_um, fwhm_um", [(10.0, 1.0), (4.3, 0.02), (12.0, 0.01)])
def test_a_gaussian_response_is_integrated(program, radiance, tmp_path, centre_um, fwhm_um):
    got = program.render(tmp_path, band=[{"name": "b", "centre_um": centre_um,
                                          "fwhm_um": fwhm_um}])

    expected = radiance.integral(
        lambda um: radiance.planck(um, 300.0) * np.exp(-4 * np.log(2)
                                                       * ((um - centre_um) / fwhm_um) ** 2),
        centre_um - 4 * fwhm_um, centre_um + 4 * fwhm_um)
    assert got.planes["radiance_b"] == pytest.approx(expected, rel=BAND)


def test_a_black_plane_appears_at_its_own_temperature_through_a_filter(program, tmp_path):
    (tmp_path / "filter.csv").write_text("wavelength_um,response\n8,0\n9,1\n12,.2\n")

    got = program.render(tmp_path, band=[{"name": "b", "response": "filter.csv"}])

    assert got.planes["apparent_temperature_b_c"] == pytest.approx(26.85, abs=0.01)


@pytest.mark.parametrize("rows", [
    "8,0\n8,1\n12,1\n12,0\n", "12,0\n12,1\n8,1\n8,0\n", "8,1\n8,1\n12,1\n12,1\n",
    "7.9,0\n8,0\n8,.5\n8,1\n9,1\n9,1\n9,1\n12,1\n12,0\n12.1,0\n"])
def test_a_wavelength_that_comes_twice_is_a_step(program, tmp_path, rows):
    (tmp_path / "filter.csv").write_text("wavelength_um,response\n" + rows)
    (tmp_path / "wide.csv").write_text("wavelength_um,response\n8,1\n12,1\n")

    got = program.render(tmp_path, band=[{"name": "b", "response": "filter.csv"},
                                         {"name": "wide", "response": "wide.csv"}])

    assert got.planes["radiance_b"] == pytest.approx(got.planes["radiance_wide"], rel=1e-4)


def test_noise_below_zero_is_zero_and_told(program, tmp_path):
    (tmp_path / "filter.csv").write_text("wavelength_um,response\n7,-.01\n8,0\n9,1\n10,0\n13,-.04\n")
    (tmp_path / "clean.csv").write_text("wavelength_um,response\n7,0\n8,0\n9,1\n10,0\n13,0\n")
    bands = [{"name": "b", "response": "filter.csv"}, {"name": "clean", "response": "clean.csv"}]

    got = program.render(tmp_path, band=bands)
    said = program.run("check", program.write_scene(tmp_path, band=bands)).stderr

    assert got.planes["radiance_b"].tolist() == got.planes["radiance_clean"].tolist()
    assert "filter.csv: responses below 0, down to -0.04 of a peak of 1, are taken as 0" in said


def test_a_response_of_a_spreadsheet_with_decimal_commas_is_one(program, tmp_path):
    (tmp_path / "filter.csv").write_text("sep=;\nwavelength_um;response\n8,25;0\n9;0,5\n10,5;1\n11;0\n")

    done = program.run("check", program.write_scene(tmp_path, band=[{"name": "b", "response": "filter.csv"}]))

    assert done.returncode == 0 and "8.25 to 11 um" in done.stdout


@pytest.mark.parametrize("rows, expected", [
    ("8,-.2\n9,1\n", "filter.csv:2: found a response of -0.2, expected 0 or more, but for noise"),
    ("8,0\n9,-999\n10,1\n11,0\n", "filter.csv:3: found a response of -999"),
    ("8,1\n9,1\n8.5,1\n", "filter.csv:4: found '8.5,1', expected wavelengths that only rise or only fall"),
    ("8,1\n8,1\n", "wavelengths that only rise or only fall"),
    ("8,0\n9,0\n", "a response above 0")])
def test_a_table_that_is_no_response_is_refused(program, tmp_path, rows, expected):
    (tmp_path / "filter.csv").write_text("wavelength_um,response\n" + rows)

    assert expected in program.run("check", program.write_scene(tmp_path, band=[{"name": "b", "response": "filter.csv"}])).stderr


def test_a_broken_table_is_refused_with_its_line(program, tmp_path):
    (tmp_path / "filter.csv").write_text("wavelength_um,response\n8,0\n9;1\n")

    done = program.run("check", program.write_scene(
        tmp_path, band=[{"name": "b", "response": "filter.csv"}]))

    assert done.returncode == 1
    assert "filter.csv:3: found '9;1', expected a wavelength and a response" in done.stderr


@pytest.mark.parametrize("band, expected", [
    ({"name": "b"}, "expected one of wavelength_um"),
    ({"name": "b", "wavelength_um": [8, 9], "centre_um": 8.5, "fwhm_um": 1},
     "expected one of wavelength_um"),
    ({"name": "b", "centre_um": 8.5}, "fwhm_um: missing"),
    ({"name": "b", "centre_um": 1.0, "fwhm_um": 0.5}, "lie below 0.2 um"),
    ({"name": "b", "centre_um": 8.5, "fwhm_um": 1, "count": 3}, "beside wavelength_um"),
    ({"name": "b", "wavelength_um": [8, 9], "count": 2.5}, "expected a whole number"),
    ({"name": "b", "wavelength_um": [8, 9], "count": 5000}, "from 1 to 4096"),
])
def test_a_wrong_band_is_refused(program, tmp_path, band, expected):
    done = program.run("check", program.write_scene(tmp_path, band=[band]))

    assert done.returncode == 1 and expected in done.stderr


def test_a_series_is_cut_into_bands_of_equal_width(program, radiance, tmp_path):
    got = program.render(tmp_path, band=[
        {"name": "b", "wavelength_um": [8.0, 14.0], "count": 12}])

    edges = np.linspace(8, 14, 13)
    for i in range(12):
        expected = radiance.band_planck(edges[i], edges[i + 1], 300.0)
        assert got.planes[f"radiance_b_{i:02}"] == pytest.approx(expected, rel=BAND)
    # whose sum is the band as a whole
    total = sum(got.planes[f"radiance_b_{i:02}"].astype(float) for i in range(12))
    assert total == pytest.approx(radiance.band_planck(8, 14, 300.0), rel=BAND)


def test_a_hyperspectral_cube_has_spectral_channels(program, tmp_path):
    got = program.render(tmp_path, "--exr", band=[
        {"name": "b", "wavelength_um": [8.0, 14.0], "count": 24}])

    header = exr.read_header(got.folder / "plane.exr")
    spectral = [name for name in exr.channels(header) if name.startswith("S0.")]
    assert {"R", "G", "B"} <= set(exr.channels(header))
    # the centre of a flat band is its middle; names sort by wavelength
    assert spectral == [f"S0.{8125 + 250 * i:05},0000nm" for i in range(24)]
    assert header["spectralLayoutVersion"] == b"1.0"


def peak_mib(program, folder, pixels):
    """The most memory that a render of 100 bands takes; the cube is pixels^2 x 400 bytes."""
    folder.mkdir()
    scene = program.write_scene(folder, camera={"pixels": [pixels, pixels]}, band=[
        {"name": "b", "wavelength_um": [8.0, 14.0], "count": 100}])
    pid = os.spawnv(os.P_NOWAIT, program.path, ["radsig", "render", str(scene), "-o",
                                                str(folder / "out")])
    _, code, usage = os.wait4(pid, 0)
    assert code == 0
    return usage.ru_maxrss / 1024


def test_memory_does_not_grow_with_the_cube(program, tmp_path):
    small = peak_mib(program, tmp_path / "small", 192)  # 14 MiB, more than one tile
    large = peak_mib(program, tmp_path / "large", 448)  # 77 MiB

    assert large < small + 40  # 63 more in the file; the device takes some 20 more or less


def test_a_band_narrower_than_the_grid_of_a_uniform_sky_is_rendered_in_thesis_mode(
        program, radiance, tmp_path):
    got = program.render(tmp_path, "--mode", "thesis", material=BLACK, band=[
        {"name": "wide", "wavelength_um": [8.0, 14.0]},
        {"name": "narrow", "wavelength_um": [10.0011, 10.0021]}])  # .1 cm-1; the grid has 2

    expected = radiance.band_planck(10.0011, 10.0021, 300.0)
    assert got.planes["radiance_narrow"] == pytest.approx(expected, rel=BAND)
