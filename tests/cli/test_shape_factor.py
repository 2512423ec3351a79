import os
import pathlib
import subprocess

import numpy as np
import pytest
from test_trace import write
import cases

ROOT = pathlib.Path(__file__).resolve().parents[2]
RADSIG = ROOT / os.environ.get("RADSIG", "build/radsig")

LEVEL = ("--normal", "0,0,1")


def shape_factor(*arguments):
    command = [RADSIG, "shape-factor", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def factor(*arguments):
    done = shape_factor(*arguments)
    assert done.returncode == 0, done.stderr
    return float(done.stdout)


@pytest.fixture
def ring(tmp_path):
    return write(tmp_path / "ring.obj", cases.ring(10.0, 30.0))


def test_a_point_over_a_plane_sees_the_whole_sky(tmp_path):
    plane = write(tmp_path / "plane.obj", cases.plane(50.0))

    assert shape_factor(plane, "--point", "0,0,1", *LEVEL).stdout == "1.000000\n"
    assert factor(plane, "--point", "0,0,0", *LEVEL) == 1


@pytest.mark.parametrize("reading", ["cosine", "solid-angle", "thesis"])
def test_a_point_in_a_box_sees_nothing(tmp_path, reading):
    box = write(tmp_path / "box.obj", cases.box())

    assert factor(box, "--point", ".5,.5,.5", "--normal", "1,2,-3", "--reading", reading) == 0


# Shares of the weight above 30 degrees: 1 - sin^2, 1 - sin and cos of 30
@pytest.mark.parametrize("reading, share", [("cosine", 0.75), ("solid-angle", 0.5),
                                            ("thesis", 0.8660254)])
@pytest.mark.parametrize("steps", [(5, 10), (1, 1)])
def test_a_ring_up_to_30_degrees_leaves_the_closed_form(ring, reading, share, steps):
    zenith, azimuth = map(str, steps)

    value = factor(ring, "--point", "0,0,0", *LEVEL, "--reading", reading, "--zenith-step",
                   zenith, "--azimuth-step", azimuth)

    assert value == pytest.approx(share, abs=1e-6)  # 30 degrees lie on the border of two cells


def test_the_reading_is_cosine_unless_another_is_named(ring):
    at = ("--point", "0,0,0", *LEVEL)

    assert factor(ring, *at) == factor(ring, *at, "--reading", "cosine")


def test_culled_faces_let_the_sky_through_from_behind(ring):
    at = ("--point", "0,0,0", *LEVEL)  # the ring's faces look outwards

    assert factor(ring, *at, "--cull", "back") == 1


FINE = ("--zenith-step", "0.25", "--azimuth-step", "2")
CLOSED_FORM = 0.002  # the demand on fine steps
ENDLESS_M = 2e3  # against 20 m: hides and shows less than 1e-4


def upright(east, height, faces_east=True):
    """An endless wall from south to north that stands on the level of 0."""
    y = ENDLESS_M
    corners = [(east, -y, 0), (east, y, 0), (east, y, height), (east, -y, height)]
    return cases.mesh(corners, [(0, 1, 2, 3) if faces_east else (3, 2, 1, 0)])


@pytest.mark.parametrize("east_m, height_m", [(0.5, 3.0), (5.0, 10.0), (10.0, 40.0), (16.0, 3.0)])
def test_the_floor_of_an_endless_canyon_sees_the_closed_form(tmp_path, east_m, height_m):
    """Walls at 0 and 20 m hide all above them up to their edges: half the sum of the sines of the
    angles from the zenith to both edges."""
    canyon = cases.join(cases.plane(ENDLESS_M), upright(0.0, height_m),
                        upright(20.0, height_m, faces_east=False))
    mesh = write(tmp_path / "canyon.obj", canyon)

    value = factor(mesh, "--point", f"{east_m},3,0", *LEVEL, *FINE)

    sines = [x / np.hypot(x, height_m) for x in (east_m, 20 - east_m)]
    assert value == pytest.approx(sum(sines) / 2, abs=CLOSED_FORM)


@pytest.mark.parametrize("distance_m", [1.0, 30.0])
def test_the_ground_before_an_endless_wall_sees_the_closed_form(tmp_path, distance_m):
    mesh = write(tmp_path / "wall.obj", cases.join(cases.plane(ENDLESS_M), upright(0.0, 10.0)))

    value = factor(mesh, "--point", f"{distance_m},0,0", *LEVEL, *FINE)

    assert value == pytest.approx((1 + distance_m / np.hypot(distance_m, 10)) / 2, abs=CLOSED_FORM)


@pytest.mark.parametrize("depth_m", [2.0, 10.0, 25.0])
def test_the_middle_of_a_round_pit_sees_the_closed_form(tmp_path, depth_m):
    elevation_deg = np.degrees(np.arctan(depth_m / 10))
    pit = cases.join(cases.plane(9.0, z=0), cases.ring(10.0, elevation_deg))
    mesh = write(tmp_path / "pit.obj", pit)

    value = factor(mesh, "--point", "0,0,0", *LEVEL, *FINE)

    assert value == pytest.approx(100 / (100 + depth_m**2), abs=CLOSED_FORM)  # R2 / (R2 + h2)


@pytest.mark.parametrize("slope_deg", [25, 90, 130])
def test_a_slope_over_a_level_plane_sees_the_closed_form(tmp_path, slope_deg):
    """The plane's horizon hides (1 - cos slope) / 2."""
    mesh = write(tmp_path / "plane.obj", cases.plane(ENDLESS_M))
    slope = np.radians(slope_deg)
    normal = f"{np.sin(slope)},0,{np.cos(slope)}"

    value = factor(mesh, "--point", "0,0,1", f"--normal={normal}", *FINE)

    assert value == pytest.approx((1 + np.cos(slope)) / 2, abs=CLOSED_FORM)


@pytest.mark.parametrize("horizon_deg", [5.0, 47.3])
def test_a_level_plane_under_a_horizon_of_hills_sees_the_closed_form(tmp_path, horizon_deg):
    mesh = write(tmp_path / "hills.obj", cases.ring(5000.0, horizon_deg))

    value = factor(mesh, "--point", "0,0,0", *LEVEL, *FINE)

    assert value == pytest.approx(np.cos(np.radians(horizon_deg)) ** 2, abs=CLOSED_FORM)


def test_the_grid_of_the_thesis_gives_its_sum(tmp_path, ring):
    """Thesis, eq. 2.4.2-6 with steps of 15 and 30 degrees, over the sum for an open sky."""
    grid = ("--reading", "thesis", "--zenith-step", "15", "--azimuth-step", "30")
    plane = write(tmp_path / "plane.obj", cases.plane(50.0))
    box = write(tmp_path / "box.obj", cases.box())
    weight = np.sin(np.radians(np.arange(7.5, 90, 15)))

    assert factor(plane, "--point", "0,0,0", *LEVEL, *grid) == 1
    assert factor(box, "--point", ".5,.5,.5", *LEVEL, *grid) == 0
    assert factor(ring, "--point", "0,0,0", *LEVEL, *grid) == pytest.approx(
        weight[2:].sum() / weight.sum(), abs=1e-6)  # the ring hides 30 degrees, two rows of cells


def test_the_normal_need_not_be_unit(ring):
    assert factor(ring, "--point", "0,0,0", "--normal", "0,0,1e-9") == pytest.approx(0.75, abs=1e-6)


@pytest.mark.parametrize("arguments", [
    [], ["a.obj"], ["a.obj", "--point", "0,0,0"], ["--point", "0,0,0", *LEVEL],
    ["a.obj", "--point", "0,0", *LEVEL], ["a.obj", "--point", "0,0,nan", *LEVEL],
    ["a.obj", "--point", "0,0,0", "--normal", "0,0,0"],
    ["a.obj", "--point", "0,0,0", *LEVEL, "--reading", "lambert"],
    ["a.obj", "--point", "0,0,0", *LEVEL, "--zenith-step", "7"],
    ["a.obj", "--point", "0,0,0", *LEVEL, "--azimuth-step", "0"],
    ["a.obj", "--point", "0,0,0", *LEVEL, "--zenith-step", ".01", "--azimuth-step", ".01"],
    ["a.obj", "--point", "0,0,0", *LEVEL, "--cull", "front"],
])
def test_wrong_usage_ends_with_2(arguments):
    done = shape_factor(*arguments)

    assert done.returncode == 2 and done.stdout == "" and "--help" in done.stderr


def test_a_mesh_that_is_not_there_is_an_error(tmp_path):
    done = shape_factor(tmp_path / "absent.obj", "--point", "0,0,0", *LEVEL)

    assert done.returncode == 1 and "absent.obj" in done.stderr
