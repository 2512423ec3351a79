"""The files of a render as other programs read them: python3-spectral, OpenImageIO, PNG readers."""
import re
import shutil
import struct
import subprocess

import numpy as np
import pytest
import spectral.io.envi

BANDS = [{"name": "lwir", "wavelength_um": [8.0, 14.0]},
         {"name": "mwir", "wavelength_um": [3.0, 5.0]}]
# Planes of the contract and their units
UNITS = {"material": "number", "background_material": "number", "sunlit": "0..1",
         "background_sunlit": "0..1", "temperature_c": "C", "background_temperature_c": "C",
         "interaction": "number", "view_angle_deg": "degrees", "shape_factor": "cosine",
         "range_m": "m", "facet": "number"}
UNITS |= {name.format(band): unit for band in ("lwir", "mwir") for name, unit in (
    ("counts_{}", "counts"), ("apparent_temperature_{}_c", "C"), ("emissivity_{}", "1"),
    ("background_emissivity_{}", "1"))}


@pytest.fixture(scope="module")
def made(program, tmp_path_factory):
    """Half of the picture is a plane, half is sky: 40 x 30 pixels."""
    return program.render(tmp_path_factory.mktemp("formats"), band=BANDS,
                          camera={"position_m": [0.0, -40.0, 2.0], "target_m": [0.0, 0.0, 2.0],
                                  "focal_length_mm": 20.0, "pixels": [40, 30]})


def cube(made, stem):
    return spectral.io.envi.open(f"{made.folder}/{stem}.hdr", f"{made.folder}/{stem}.img")


def test_the_cube_opens_with_its_wavelengths_and_unit(made):
    image = cube(made, "plane")

    assert image.shape == (30, 40, 2)
    assert image.bands.centers == pytest.approx([11, 4])
    assert image.bands.bandwidths == pytest.approx([6, 2])
    assert image.bands.band_unit == "Micrometers"
    assert image.metadata["band names"] == ["radiance_lwir", "radiance_mwir"]
    assert image.metadata["data units"] == "W m-2 sr-1"


def test_every_truth_plane_carries_its_unit(made):
    names = cube(made, "plane_truth").metadata["band names"]

    assert set(names) >= {f"{name} [{unit}]" for name, unit in UNITS.items()}
    assert all(re.fullmatch(r"[a-z0-9_]+ \[.+\]", name) for name in names)


@pytest.mark.parametrize("stem", ["plane", "plane_truth"])
def test_headers_keep_the_convention(made, stem):
    metadata = cube(made, stem).metadata

    for key, value in (("samples", "40"), ("lines", "30"), ("header offset", "0"),
                       ("data type", "4"), ("interleave", "bsq"), ("byte order", "0"),
                       ("data ignore value", "-9999"),
                       ("file type", "ENVI Standard"),
                       ("acquisition time", "1992-06-21T17:20:00Z")):
        assert metadata[key] == value
    assert metadata["radsig materials"] == ["1 wall"]


def test_the_images_hold_nothing_but_their_planes(made):
    for stem in ("plane", "plane_truth"):
        planes = int(cube(made, stem).metadata["bands"])
        assert (made.folder / f"{stem}.img").stat().st_size == 40 * 30 * 4 * planes


def test_a_pixel_without_a_value_holds_the_ignore_value(made):
    values = np.array(cube(made, "plane_truth").load())
    names = [name.split(" [")[0] for name in cube(made, "plane_truth").metadata["band names"]]
    sky = values[0, :]

    assert (sky[:, names.index("interaction")] == 0).all()
    for name in ("material", "temperature_c", "range_m", "facet", "shape_factor",
                 "emissivity_lwir"):
        assert (sky[:, names.index(name)] == -9999).all()


def test_no_value_is_nan_or_infinite(made):
    for stem in ("plane", "plane_truth"):
        assert np.isfinite(np.fromfile(made.folder / f"{stem}.img", "<f4")).all()


def test_rows_run_from_the_top(made):
    interaction = made.planes["interaction"]

    assert (interaction[0] == 0).all() and (interaction[-1] == 1).all()


def png_size(path):
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and data[-8:-4] == b"IEND"
    return struct.unpack(">II", data[16:24])


def test_a_quick_look_shows_pixels_enlarged_by_a_whole_factor_beside_its_bar(made):
    factor = -(-256 // 30)  # the shorter side gets 256 or more
    for name in made.planes:
        width, height = png_size(made.folder / f"plane_{name}.png")
        assert 40 * factor <= width <= 40 * factor + 400
        assert 30 * factor <= height <= 30 * factor + 200


@pytest.fixture(scope="module")
def channels(made):
    """The EXR's channels by name, (rows, columns), as oiiotool prints them, and all it said."""
    if not shutil.which("oiiotool"):
        pytest.skip("oiiotool (openimageio-tools) is not installed")
    said = subprocess.run(["oiiotool", "--info", "-v", "--dumpdata", made.folder / "plane.exr"],
                          capture_output=True, text=True, check=True).stdout
    names = re.search(r"channel list: (.*)", said).group(1).split(", ")
    values = [line.split() for line in re.findall(r"Pixel \(\d+, \d+\): (.*)", said)]
    planes = np.array(values, float).reshape(30, 40, len(names))
    return {name: planes[..., i] for i, name in enumerate(names)}, said


def test_the_exr_holds_every_plane_by_its_name(made, channels):
    assert sorted(channels[0]) == sorted(made.planes)


def test_the_exr_holds_the_values_of_the_envi_files(made, channels):
    for name, values in made.planes.items():
        expected = np.nan_to_num(values, nan=-9999.0)
        assert channels[0][name] == pytest.approx(expected, abs=1e-9)  # nine decimals are printed


def test_the_exr_names_the_unit_of_every_plane(channels):
    for name, unit in UNITS.items():
        assert f'unit.{name}: "{unit}"' in channels[1]
    assert 'unit.radiance_lwir: "W m-2 sr-1"' in channels[1]
