"""radsig render --probe: the spectra of one pixel, term by term."""
import csv

import numpy as np
import pytest

TERMS = ["emitted", "reflected_sun", "reflected_sky", "reflected_background", "path"]
UNIT = "_w_m2_sr_um"
PIXELS = [12, 8]
# The wall stands in the north, on top of the picture; behind it there is sky.
SCENE = dict(
    meshes={"plane.obj": """usemtl ground
v -50 -50 0\nv 50 -50 0\nv 50 10 0\nv -50 10 0\nf 1 2 3 4
usemtl wall
v -50 10 0\nv 0 10 0\nv 0 10 30\nv -50 10 30\nf 5 6 7 8
"""},
    material=[{"name": "ground", "emissivity": 0.7, "temperature_k": 310.0},
              {"name": "wall", "emissivity": 0.4, "temperature_k": 290.0, "two_sided": True,
               "specular_share": 1.0}],
    atmosphere={"uniform": {"sky_temperature_k": 250.0, "sky_radiance_w_m2_sr_um": 0.3,
                            "sun_irradiance_w_m2_um": 20.0, "transmission": 0.8,
                            "path_temperature_k": 280.0}},
    camera={"position_m": [0.0, -40.0, 12.0], "target_m": [0.0, 10.0, 12.0],
            "focal_length_mm": 20.0, "pixels": PIXELS},
    band=[{"name": "lwir", "wavelength_um": [8.0, 14.0]},
          {"name": "filter", "response": "filter.csv"},
          {"name": "mwir", "wavelength_um": [3.0, 5.0]}])
FILTER = "wavelength_um,response\n9,0\n10,1\n10.5,0.6\n11.5,0\n"


def read(folder, column, row):
    with open(folder / f"plane_probe_{column}_{row}.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([r[key] for r in rows], str if key == "band" else float)
            for key in rows[0]}


def probed(program, folder, mode, column, row, mean="band"):
    folder.mkdir()
    (folder / "filter.csv").write_text(FILTER)
    planes = ",".join(f"{t}_{b['name']}" for t in [*TERMS, "transmission"] for b in SCENE["band"])
    got = program.render(folder, "--mode", mode, "--planes", f"interaction,{planes}",
                         "--probe", f"{column},{row}",
                         "--set", f"render.radiance={mean}", **SCENE)
    got.planes = {name: plane[row, column] for name, plane in got.planes.items()}
    return got, read(got.folder, column, row)


@pytest.fixture(scope="module", params=[("exact", 9, 0, 0), ("exact", 9, 7, 1), ("exact", 2, 2, 2),
                                        ("thesis", 2, 5, 3), ("thesis", 9, 7, 1)],
                ids=["sky", "ground", "mirrored sky", "mirrored ground", "ground as the thesis"])
def pixel(request, program, tmp_path_factory):
    """What a render says of one pixel, and its spectra."""
    mode, column, row, interaction = request.param
    got, spectra = probed(program, tmp_path_factory.mktemp("probe") / "p", mode, column, row)
    assert got.planes["interaction"] == interaction
    return got.planes, spectra


def band_integral(spectra, band, values):
    of_band = spectra["band"] == band["name"]
    return (spectra["weight_um"][of_band] * values[of_band]).sum()


def test_a_probe_s_terms_add_up_to_its_total(pixel):
    spectra = pixel[1]

    total = sum(spectra[term + UNIT] for term in TERMS)

    assert total == pytest.approx(spectra["total" + UNIT], rel=1e-6)  # sums of five float32


@pytest.mark.parametrize("term", [*TERMS, "total"])
def test_a_probe_integrates_to_the_pixel_s_planes(pixel, term):
    planes, spectra = pixel

    for band in SCENE["band"]:
        plane = planes[f"{'radiance' if term == 'total' else term}_{band['name']}"]
        integral = band_integral(spectra, band, spectra[term + UNIT])
        assert integral == pytest.approx(plane, rel=1e-5, abs=1e-9)  # float32 sums of 300 samples


def test_a_probe_has_the_mean_radiance_as_its_weighted_mean(program, tmp_path):
    got, spectra = probed(program, tmp_path / "p", "exact", 9, 7, "mean")

    for band in SCENE["band"]:
        mean = (band_integral(spectra, band, spectra["total" + UNIT])
                / band_integral(spectra, band, np.ones(len(spectra["band"]))))
        assert mean == pytest.approx(got.planes["radiance_" + band["name"]], rel=1e-5)


def test_a_probe_s_transmission_has_the_plane_s_mean(pixel):
    planes, spectra = pixel
    band = SCENE["band"][1]

    mean = (band_integral(spectra, band, spectra["transmission"])
            / band_integral(spectra, band, np.ones(len(spectra["band"]))))

    assert mean == pytest.approx(planes["transmission_filter"], rel=1e-5)


def test_a_probe_of_the_ground_emits_planck_through_the_path(program, radiance, tmp_path):
    spectra = probed(program, tmp_path / "p", "exact", 9, 7)[1]

    expected = 0.8 * 0.7 * radiance.planck(spectra["wavelength_um"], 310.0)

    # float32: an exponent of up to 15 costs 15 roundings of 6e-8 in Planck's law.
    assert spectra["emitted" + UNIT] == pytest.approx(expected, rel=2e-6)


def test_a_probe_is_drawn_and_changes_no_other_file(program, tmp_path):
    scene = program.write_scene(tmp_path)
    for folder, options in (("plain", []), ("probed", ["--probe", "0,5"])):
        done = program.run("render", scene, "-o", tmp_path / folder, *options)
        assert done.returncode == 0, done.stderr

    extra = {"plane_probe_0_5.csv", "plane_probe_0_5.png", "plane_probe_0_5_transmission.png"}
    files = {each.name: each.read_bytes() for each in (tmp_path / "probed").iterdir()}
    assert set(files) == extra | {each.name for each in (tmp_path / "plain").iterdir()}
    for name in set(files) - extra - {"plane.json"}:
        assert files[name] == (tmp_path / "plain" / name).read_bytes()


@pytest.mark.parametrize("at", ["8,0", "0,6", "4000000000,0"])
def test_a_probe_outside_the_picture_is_refused(program, tmp_path, at):
    done = program.run("render", program.write_scene(tmp_path), "-o", tmp_path / "out",
                       "--probe", at)

    assert done.returncode in (1, 2) and not (tmp_path / "out").exists()
    assert at in done.stderr or "expected 0,0 to 7,5" in done.stderr


@pytest.mark.parametrize("at", ["", "1", "1,", "a,b", "-1,2", "1,2,3", "1.5,2", "1 2", "0x1,2"])
def test_a_probe_that_is_no_pixel_is_refused(program, tmp_path, at):
    done = program.run("render", program.write_scene(tmp_path), "-o", tmp_path / "out",
                       "--probe", at)

    assert done.returncode == 2 and f"--probe: found '{at}', expected COLUMN,ROW" in done.stderr
