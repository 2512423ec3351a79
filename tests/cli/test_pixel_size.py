"""[render] samples_per_pixel: pixels of finite size."""
import os

import numpy as np
import pytest

HOT, COLD = 320.0, 280.0
# Two level halves that meet at x = 0, seen straight down by an orthographic camera with pixels of 1 m.
HALVES = {"plane.obj": """usemtl cold
v -50 -50 0\nv 0 -50 0\nv 0 50 0\nv -50 50 0\nf 1 2 3 4
usemtl hot
v 50 -50 0\nv 50 50 0\nf 2 5 6 3
"""}
MATERIALS = [{"name": "cold", "emissivity": 1.0, "temperature_k": COLD},
             {"name": "hot", "emissivity": 1.0, "temperature_k": HOT}]


def camera(cold_share, pixels):
    """Of the middle column's pixels the cold half has that share."""
    east = 0.5 - cold_share
    return {"projection": "orthographic", "focal_length_mm": None, "width_m": float(pixels[0]),
            "position_m": [east, 0.0, 60.0], "target_m": [east, 0.0, 0.0], "pixels": pixels}


def render_halves(program, folder, samples, cold_share, pixels=(3, 5), *options):
    folder.mkdir(exist_ok=True)
    return program.render(folder, "--set", f"render.samples_per_pixel={samples}", *options,
                          meshes=HALVES, material=MATERIALS, camera=camera(cold_share, list(pixels)))


@pytest.fixture(scope="module")
def quarter(program, tmp_path_factory):
    """An edge that lies between two samples_per_side: 4 of 16 samples are cold for certain."""
    return render_halves(program, tmp_path_factory.mktemp("quarter"), 16, 0.25)


def test_a_pixel_over_an_edge_is_the_mean_by_its_shares(quarter, radiance):
    cold, hot = (radiance.band_planck(8, 14, t) for t in (COLD, HOT))

    # 2e-4: the band's integral
    assert quarter.planes["radiance_lwir"][:, 0] == pytest.approx(cold, rel=2e-4)
    assert quarter.planes["radiance_lwir"][:, 1] == pytest.approx(.25 * cold + .75 * hot, rel=2e-4)
    assert quarter.planes["radiance_lwir"][:, 2] == pytest.approx(hot, rel=2e-4)
    assert quarter.planes["temperature_c"][:, 1] == pytest.approx(.25 * COLD + .75 * HOT - 273.15)


def test_the_standard_error_of_two_values_is_the_closed_form(quarter, radiance):
    difference = radiance.band_planck(8, 14, HOT) - radiance.band_planck(8, 14, COLD)

    # Of n samples with a share p: sqrt(p (1 - p) / (n - 1)) of the difference.
    expected = difference * np.sqrt(.25 * .75 / 15)
    assert quarter.planes["stderr_lwir"][:, 1] == pytest.approx(expected, rel=4e-4)
    # Each half is one radiance but for the last bit.
    assert quarter.planes["stderr_lwir"][:, [0, 2]] == pytest.approx(0.0, abs=1e-5)


def test_categorical_planes_take_the_commonest(quarter):
    cold, hot = quarter.planes["material"][0, 0], quarter.planes["material"][0, 2]

    assert cold != hot
    assert (quarter.planes["material"] == [cold, hot, hot]).all()
    assert (quarter.planes["facet"] == [0, 1, 1]).all()


def test_the_apparent_temperature_is_that_of_the_mean_radiance(quarter, radiance):
    apparent_k = quarter.planes["apparent_temperature_lwir_c"][0, 1] + 273.15

    mean = quarter.planes["radiance_lwir"][0, 1]
    # 2e-4 of the radiance is .01 K
    assert radiance.band_planck(8, 14, apparent_k) == pytest.approx(mean, rel=2e-4)
    assert abs(apparent_k - (.25 * COLD + .75 * HOT)) > 0.3


def test_samples_lie_all_over_their_strata(program, radiance, tmp_path):
    got = render_halves(program, tmp_path, 16, 0.3, (3, 90))

    cold, hot = (radiance.band_planck(8, 14, t) for t in (COLD, HOT))
    share = (hot - got.planes["radiance_lwir"][:, 1]) / (hot - cold)
    # A stratum of a fourth is cut at a fifth of it: 4 of 16 samples are cold or not, with .2.
    assert share.min() >= .25 - 2e-3 and share.max() <= .5 + 2e-3
    assert share.mean() == pytest.approx(.3, abs=4 * np.sqrt(.2 * .8 * 4 / 90) / 16)


def test_a_part_of_the_frame_has_the_frame_s_samples(program, tmp_path):
    whole = render_halves(program, tmp_path / "whole", 9, 0.4, (6, 7))
    (tmp_path / "part").mkdir()
    part = program.render(tmp_path / "part", "--set", "render.samples_per_pixel=9", meshes=HALVES,
                          material=MATERIALS, camera={**camera(0.4, [6, 7]), "crop": [1, 2, 4, 3]})

    for name, values in part.planes.items():
        assert values.tobytes() == whole.planes[name][2:5, 1:5].tobytes(), name


def test_a_seed_moves_the_samples(program, tmp_path):
    first, again, other = (
        render_halves(program, tmp_path / name, 4, 0.4, (3, 40), "--set", f"render.seed={seed}")
        for name, seed in (("first", 1), ("again", 1), ("other", 2)))

    assert again.planes["radiance_lwir"].tobytes() == first.planes["radiance_lwir"].tobytes()
    assert (other.planes["radiance_lwir"][:, 1] != first.planes["radiance_lwir"][:, 1]).any()


def test_one_sample_is_the_middle_of_the_pixel(program, tmp_path):
    plain = render_halves(program, tmp_path / "plain", 1, 0.4)
    other = render_halves(program, tmp_path / "other", 1, 0.4, (3, 5), "--set", "render.seed=9")

    assert "stderr_lwir" not in plain.planes
    assert (plain.planes["facet"] == [0, 1, 1]).all()
    for name, values in plain.planes.items():
        assert values.tobytes() == other.planes[name].tobytes()


def test_a_probe_of_several_samples_integrates_to_the_pixel(program, tmp_path):
    got = render_halves(program, tmp_path, 4, 0.5, (3, 5), "--probe", "1,2")

    rows = [line.split(",") for line in
            (got.folder / "plane_probe_1_2.csv").read_text().splitlines()[1:]]
    integral = sum(float(row[2]) * float(row[-1]) for row in rows)
    assert integral == pytest.approx(got.planes["radiance_lwir"][2, 1], rel=1e-5)


def peak_mib(program, folder, samples):
    folder.mkdir()
    scene = program.write_scene(folder, camera={"pixels": [128, 128]},
                                render={"samples_per_pixel": samples})
    pid = os.spawnv(os.P_NOWAIT, program.path, ["radsig", "render", str(scene), "-o",
                                                str(folder / "out")])
    _, code, usage = os.wait4(pid, 0)
    assert code == 0
    return usage.ru_maxrss / 1024


def test_memory_does_not_grow_with_samples(program, tmp_path):
    # A run that has to compile a kernel takes more: the smaller of two.
    few, many = (min(peak_mib(program, tmp_path / f"{n}-{i}", n) for i in range(2)) for n in (4, 64))

    # 4 x 16384 samples fill a tile; 16 times as many would take some 500 MiB more.
    assert many < few + 40


@pytest.mark.parametrize("key, value, expected", [
    ("samples_per_pixel", 2, "expected a square number: 1, 4, 9 .. 1024"),
    ("samples_per_pixel", 0, "expected a number from 1 to 1024"),
    ("samples_per_pixel", 4.5, "expected a whole number"),
    ("seed", -1, "expected a number from 0"),
    ("seed", 0.5, "expected a whole number"),
])
def test_wrong_samples_are_refused(program, tmp_path, key, value, expected):
    done = program.run("check", program.write_scene(tmp_path, render={key: value}))

    assert done.returncode == 1 and f"render.{key}: " in done.stderr and expected in done.stderr


def test_more_samples_than_can_be_counted_are_refused(program, tmp_path):
    done = program.run("check", program.write_scene(
        tmp_path, camera={"pixels": [4096, 1025]}, render={"samples_per_pixel": 1024}))

    assert done.returncode == 1 and "4096 x 1025 pixels of 1024 samples" in done.stderr
