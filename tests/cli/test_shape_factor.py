import os
import pathlib
import subprocess
import sys

import pytest
from test_trace import write

ROOT = pathlib.Path(__file__).resolve().parents[2]
RADSIG = ROOT / os.environ.get("RADSIG", "build/radsig")

sys.path.append(str(ROOT / "tests"))
import cases  # noqa: E402

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
