"""[sensor]: the degraded radiance beside the clean one, against closed forms."""
import re

import numpy as np
import pytest

import envi
from png import read_png

FLAT = {"pixels": [256, 256]}
BLACK = {"name": "lwir", "wavelength_um": [8.0, 14.0]}


def rendered(program, folder, sensor, *options, **changes):
    """The clean radiance, the degraded one in double, and what `render` returns."""
    folder.mkdir(exist_ok=True)
    got = program.render(folder, *options, sensor=sensor, **{"camera": FLAT, **changes})
    header, planes = envi.read(got.folder / "plane_sensor")
    got.sensor_header = header
    return got.planes["radiance_lwir"].astype(float), planes["sensor_lwir"].astype(float), got


def test_the_sensor_s_radiance_stands_beside_the_clean_one(program, tmp_path):
    _, _, plain = rendered(program, tmp_path / "plain", {})
    _, _, noisy = rendered(program, tmp_path / "noisy", {"netd_k": 1.0, "gaussian_fwhm_px": 3.0})

    for end in (".img", "_truth.img"):
        assert (plain.folder / f"plane{end}").read_bytes() == (
            noisy.folder / f"plane{end}").read_bytes()
    assert noisy.sensor_header["data units"] == "W m-2 sr-1"
    assert noisy.sensor_header["wavelength"] == noisy.header["wavelength"]
    assert (noisy.folder / "plane_sensor_lwir.png").exists()


def test_the_report_names_the_sensor_s_planes_and_seed(program, tmp_path):
    report = rendered(program, tmp_path, {"seed": 7, "netd_k": 1.0})[2].report

    assert [p for p in report["planes"] if p["name"] == "sensor_lwir"]
    assert report["settings"]["sensor.seed"] == 7 and report["settings"]["sensor.frame"] == 0


def test_an_empty_table_gives_the_radiance_itself(program, tmp_path):
    clean, sensor, _ = rendered(program, tmp_path, {})

    assert (clean == sensor).all()


@pytest.mark.parametrize("sensor", [{"netd_k": .2, "seed": 5, "fixed_gain": .01, "bits": 12}])
def test_the_same_seed_gives_the_same_bytes(program, tmp_path, sensor):
    images = [rendered(program, tmp_path / str(k), {**sensor, "seed": k // 2})[2].folder
              for k in range(3)]
    data = [(folder / "plane_sensor.img").read_bytes() for folder in images]

    assert data[0] == data[1] and data[0] != data[2]


def test_the_noise_of_a_band_does_not_depend_on_the_others(program, tmp_path):
    bands = [{"name": "mwir", "wavelength_um": [3.0, 5.0]}, BLACK]
    changes = {"band": bands, "camera": {"pixels": [64, 64]}}

    both = rendered(program, tmp_path / "both", {"netd_k": 1.0}, **changes)
    alone = rendered(program, tmp_path / "alone", {"netd_k": 1.0}, "--bands", "lwir", **changes)

    assert (both[1] == alone[1]).all() and (both[0] != both[1]).any()


@pytest.mark.parametrize("radiance_of, per", [("band", 1), ("mean", 6)])
def test_a_netd_is_the_noise_of_that_many_kelvin(program, radiance, tmp_path, radiance_of, per):
    clean, sensor, _ = rendered(program, tmp_path, {"netd_k": 0.5, "netd_at_k": 320.0},
                                render={"radiance": radiance_of})

    slope = (radiance.band_planck(8, 14, 320.01) - radiance.band_planck(8, 14, 319.99)) / 0.02
    # five standard errors of a variance of 2^16 numbers
    assert (sensor - clean).std() == pytest.approx(0.5 * slope / per, rel=2.5 * (2 / 65536) ** .5)


def test_a_nesr_is_a_mean_over_the_band(program, tmp_path):
    clean, sensor, _ = rendered(program, tmp_path, {"nesr_w_m2_sr_um": 0.02})

    assert (sensor - clean).std() == pytest.approx(0.02 * 6, rel=2.5 * (2 / 65536) ** .5)


def test_shot_and_read_noise_add_their_variances(program, tmp_path):
    clean, sensor, _ = rendered(program, tmp_path, {"electrons_per_w_m2_sr": 200.0,
                                                    "read_electrons": 80.0})

    electrons = clean.mean() * 200
    expected = (electrons + 80**2) ** .5 / 200
    assert (sensor - clean).std() == pytest.approx(expected, rel=2.5 * (2 / 65536) ** .5)


def test_counts_have_so_many_bits(program, tmp_path):
    clean, sensor, _ = rendered(program, tmp_path, {"bits": 6, "nesr_w_m2_sr_um": 1.0},
                                band=[{**BLACK, "gain": 2.0, "offset": -80.0}])

    counts = 2 * sensor - 80
    assert (counts == np.rint(counts)).all()
    assert counts.min() >= 0 and counts.max() <= 63


# A black plane whose middle stripe is hot: an edge in the picture, 4 columns of one metre.
HOT = ("usemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
       "usemtl hot\nv -2 -2 1\nv 2 -2 1\nv 2 2 1\nv -2 2 1\nf -4 -3 -2 -1\n")
SPOT = {"meshes": {"plane.obj": HOT},
        "material": [{"name": "wall", "emissivity": 1.0, "temperature_k": 300.0},
                     {"name": "hot", "emissivity": 1.0, "temperature_k": 350.0}],
        "camera": {"position_m": [0.0, 0.0, 1e4], "focal_length_mm": 36 * 1e4 / 64,
                   "pixels": [64, 64]}}


@pytest.mark.parametrize("sensor", [{"gaussian_fwhm_px": 2.5}, {"box_px": 3.0},
                                    {"motion_px": 5.0, "motion_deg": 30.0},
                                    {"airy_f_number": 2.0, "pixel_pitch_um": 25.0}])
def test_a_spread_keeps_the_energy_of_a_spot(program, tmp_path, sensor):
    clean, spread, _ = rendered(program, tmp_path, sensor, **SPOT)

    assert abs(spread - clean).max() > 1
    cold = clean.min()
    assert (spread - cold).sum() == pytest.approx((clean - cold).sum(), rel=1e-4)  # float32 sums


def test_a_detector_takes_the_mean_of_its_pixels(program, tmp_path):
    clean, sensor, _ = rendered(program, tmp_path, {"detector_px": 5}, **SPOT)

    expected = clean[:60, :60].reshape(12, 5, 12, 5).mean(axis=(1, 3))
    assert sensor == pytest.approx(expected, rel=1e-6)


# The side of a picture's pixels, and where they begin: below the titles (quick_look.c).
SIDE, TOP, LEFT = 256, 54, 12


def test_a_picture_shows_the_detectors_not_the_camera_s_pixels(program, tmp_path):
    # detectors of 2 x 2 end where the hot square of 16 x 16 pixels does: both show one picture,
    # 64 pixels four times as large and 32 detectors eight times
    spot = {**SPOT, "meshes": {"plane.obj": re.sub(r"v (-?)2 (-?)2", r"v \g<1>8 \g<2>8", HOT)}}
    folder = rendered(program, tmp_path, {"detector_px": 2}, **spot)[2].folder

    clean, sensor = (read_png(folder / f"plane_{name}.png")[TOP:TOP + SIDE, LEFT:LEFT + SIDE]
                     for name in ("radiance_lwir", "sensor_lwir"))
    square = (clean == 255).all(axis=2)
    assert square[96:160, 96:160].all() and square.sum() == 64 * 64
    assert (sensor == clean).all()


@pytest.mark.parametrize("step, columns", [(8, 32), (64, 4)])
def test_a_picture_of_few_detectors_is_as_large_as_any(program, tmp_path, step, columns):
    _, sensor, got = rendered(program, tmp_path, {"detector_px": step})

    assert sensor.shape == (columns, columns)
    shown = read_png(got.folder / "plane_sensor_lwir.png")
    assert shown.shape[0] == TOP + SIDE + 12 and (shown[TOP + SIDE, LEFT:LEFT + SIDE] == 110).all()


def test_a_table_is_the_picture_of_a_point(program, tmp_path):
    (tmp_path / "psf.csv").write_text("0,0,1\n0,0,0\n0,0,0\n")  # all goes up and to the right
    clean, sensor, _ = rendered(program, tmp_path, {"psf": "psf.csv"}, **SPOT)

    assert (sensor[:-1, 1:] == clean[1:, :-1]).all()


@pytest.mark.parametrize("sensor, expected", [
    ({"netd": 1.0}, "the unit is missing, expected the key netd_k"),
    ({"netd_k": -1.0}, "expected a number from 0"),
    ({"airy_f_number": 2.0}, "pixel_pitch_um: missing"),
    ({"periodic_px": 2.0}, "periodic_w_m2_sr_um: missing"),
    ({"read_electrons": 2.0}, "electrons_per_w_m2_sr: missing"),
    ({"seed": 1.5}, "expected a whole number"),
    ({"bits": 30}, "from 1 to 24"),
    ({"detector_px": 64}, "the picture has 8 x 6 pixels"),
    ({"psf": "absent.csv"}, "absent.csv: No such file"),
])
def test_a_wrong_sensor_is_refused(program, tmp_path, sensor, expected):
    done = program.run("check", program.write_scene(tmp_path, sensor=sensor))

    assert done.returncode == 1 and expected in done.stderr and "scene.toml:" in done.stderr
