import os
import pathlib
import subprocess

import numpy as np
import pytest
import cases

ROOT = pathlib.Path(__file__).resolve().parents[2]
RADSIG = ROOT / os.environ.get("RADSIG", "build/radsig")

ANSWER = np.dtype([("t_m", "<f4"), ("facet", "<i4")])


def write(path, mesh):
    corner, position = mesh
    lines = ["v %.9g %.9g %.9g" % tuple(p) for p in position]
    lines += ["f " + " ".join(str(i + 1) for i in c if i != cases.NO_CORNER) for c in corner]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture
def plane(tmp_path):
    return write(tmp_path / "plane.obj", cases.plane(50.0))


def trace(*arguments, rays=""):
    command = [RADSIG, "trace", *arguments]
    return subprocess.run(command, input=rays, capture_output=True, timeout=60,
                          text=isinstance(rays, str))


def answers(*arguments, rays):
    done = trace(*arguments, rays=rays)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines() if isinstance(rays, str) else done.stdout


def test_a_ray_prints_its_distance_and_face(plane):
    lines = answers(plane, rays="0 0 10 0 0 -1\n100 0 10 0 0 -1\n1 1 -3 0 0 1\n")

    assert lines == ["10,0", "inf,-1", "3,0"]


def test_distances_are_metres_whatever_the_length_of_the_direction(plane):
    rays = "".join(f"0 0 10 0 0 {z}\n" for z in (-1e-30, -0.3, -7, -1e30))

    t_m = [float(line.removesuffix(",0")) for line in answers(plane, rays=rays)]

    assert t_m == pytest.approx([10] * 4, rel=2e-7)  # a few roundings of float32


def test_faces_count_on_over_all_meshes_in_the_order_given(tmp_path, plane):
    box = write(tmp_path / "box.obj", cases.box((0, 0, 1), (1, 1, 2)))
    rays = "0.5 0.5 10 0 0 -1\n9 9 10 0 0 -1\n"

    assert answers(plane, box, rays=rays) == ["8,2", "10,0"]
    assert answers(box, plane, rays=rays) == ["8,1", "10,6"]


def test_the_pieces_of_a_polygon_are_one_face(tmp_path):
    mesh = tmp_path / "arrow.obj"
    mesh.write_text("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 9 9 9\nv 8 9 9\nv 9 8 9\n"
                    "f 1 2 3 4 5\nf 6 7 8\n")
    rays = "".join(f"{x} {y} 1 0 0 -1\n" for x, y in ((2, 0.5), (0.2, 3), (3.8, 3), (2, 2)))

    assert answers(mesh, rays=rays) == ["1,0", "1,0", "1,0", "inf,-1"]


def test_any_hit_prints_a_bit_a_line(plane):
    assert answers("--any-hit", plane, rays="0 0 10 0 0 -1\n0 0 10 0 0 1\n") == ["1", "0"]


def test_culled_faces_are_met_from_the_front_alone(plane):
    rays = "0 0 10 0 0 -1\n0 0 -10 0 0 1\n"

    assert answers("--cull", "back", plane, rays=rays) == ["10,0", "inf,-1"]


def test_binary_answers_are_the_bits_of_the_text(tmp_path):
    mesh = write(tmp_path / "sphere.obj", cases.icosphere(2))
    random = np.random.default_rng(1)
    rays = random.normal(size=(200, 6)).astype("<f4")
    text = "".join(" ".join("%.17g" % x for x in ray) + "\n" for ray in rays)

    packed = np.frombuffer(answers("--binary", mesh, rays=rays.tobytes()), ANSWER)

    lines = [line.split(",") for line in answers(mesh, rays=text)]
    assert packed["facet"].tolist() == [int(facet) for _, facet in lines]
    assert packed["t_m"].tobytes() == np.float32([float(t) for t, _ in lines]).tobytes()
    assert answers("--binary", "--any-hit", mesh, rays=rays.tobytes()) == bytes(
        (packed["facet"] >= 0).tolist())


def test_more_rays_than_a_batch_pass(plane):
    rays = np.zeros((150000, 6), "<f4")
    rays[:, 2] = 1 + np.arange(len(rays)) % 1000
    rays[:, 5] = -1

    packed = np.frombuffer(answers("--binary", plane, rays=rays.tobytes()), ANSWER)

    assert np.array_equal(packed["t_m"], rays[:, 2])


def test_a_mesh_far_from_the_origin_is_met_as_exactly_as_one_at_it(tmp_path):
    east, north = 4_500_000.0, 5_400_000.0  # as in a national grid; a float steps by half a metre
    mesh = tmp_path / "far.obj"
    mesh.write_text(f"v {east} {north} 0\nv {east + 1} {north} 0\nv {east} {north + 1} 0\n"
                    "f 1 2 3\n")
    rays = (f"{east + 0.3} {north + 0.69} 2 0 0 -1\n{east + 0.3} {north + 0.71} 2 0 0 -1\n")

    assert answers(mesh, rays=rays) == ["2,0", "inf,-1"]


def test_the_distance_to_a_facet_much_larger_is_exact(tmp_path):
    """A slope of 3 in 4, 8 km wide: a level ray meets it 4/3 as far off as it starts above it."""
    mesh = tmp_path / "slope.obj"
    mesh.write_text("v -4000 -4000 -3000\nv 4000 -4000 3000\nv 4000 4000 3000\n"
                    "v -4000 4000 -3000\nf 1 2 3 4\n")
    above_m = np.geomspace(1e-3, 1e3, 25)
    east, north = (np.random.default_rng(2).uniform(-2000, 2000, (2, 25)))
    rays = "".join(f"{x!r} {y!r} {0.75 * x + h!r} 1 0 0\n"
                   for x, y, h in zip(east.tolist(), north.tolist(), above_m.tolist()))

    t_m = [float(line.removesuffix(",0")) for line in answers(mesh, rays=rays)]

    assert t_m == pytest.approx(above_m / 0.75, rel=2e-5)


@pytest.mark.parametrize("size", ["1e-310", "5e-324", "1e-40", "1e40", "1e308"])
def test_directions_may_be_denormal_or_huge(plane, size):
    rays = f"0 0 10 0 0 -{size}\n0 0 10 {size} 0 -{size}\n0 0 10 0 0 {size}\n"

    lines = answers(plane, rays=rays)

    assert [lines[0], lines[2]] == ["10,0", "inf,-1"]
    assert float(lines[1].removesuffix(",0")) == pytest.approx(10 * 2**0.5, rel=1e-6)


def test_a_warped_quad_is_its_two_triangles(tmp_path):
    mesh = tmp_path / "warped.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3 4\n")
    # Cut from its first to its third corner: z = y on one side, z = x on the other
    at = [(0.75, 0.25), (0.25, 0.75), (0.9, 0.4), (0.4, 0.9)]

    lines = answers(mesh, rays="".join(f"{x} {y} 2 0 0 -1\n" for x, y in at))

    assert [float(line.removesuffix(",0")) for line in lines] == pytest.approx(
        [2 - min(p) for p in at], rel=1e-6)


def test_no_ray_leaves_a_closed_sphere_on_a_national_grid(tmp_path):
    centre = np.array([4_500_000.25, 5_400_000.75, 310.5])
    corner, position = cases.icosphere(3, radius=10.0)
    vertices = position.astype(float) + centre
    mesh = tmp_path / "sphere.obj"
    mesh.write_text("".join("v %.4f %.4f %.4f\n" % tuple(v) for v in vertices) +
                    "".join("f %d %d %d\n" % tuple(c[:3] + 1) for c in corner))
    pairs = np.concatenate([corner[:, [0, 1]], corner[:, [1, 2]], corner[:, [2, 0]]])
    target = np.concatenate([vertices, vertices[pairs].mean(1)])
    rays = "".join("%.6f %.6f %.6f %.9g %.9g %.9g\n" % (*centre, *v) for v in target - centre)

    lines = answers(mesh, rays=rays)

    t_m = [float(line.split(",")[0]) for line in lines]
    assert np.isfinite(t_m).all()
    # Up to the sagitta of an edge of 1.8 m nearer than the radius
    assert min(t_m) > 9.9 and max(t_m) < 10.001


def test_no_rays_give_no_answers(plane):
    assert answers(plane, rays="") == []


@pytest.mark.parametrize("line", ["1 2 three", "0 0 0 0 0", "0 0 0 0 0 1 7", "0 0 0 0 0 0",
                                  "nan 0 0 0 0 1", "0 0 0 0 0 inf", "", "0,0,0,0,0,1"])
def test_a_line_that_is_no_ray_is_an_error_with_its_number(plane, line):
    done = trace(plane, rays=f"0 0 10 0 0 -1\n{line}\n0 0 10 0 0 -1\n")

    assert done.returncode == 1
    assert "line 2:" in done.stderr


@pytest.mark.parametrize("rays, number", [(b"abc", 1), (bytes(24), 1),
                                          (np.ones(6, "<f4").tobytes() + b"1234", 2)])
def test_binary_input_that_is_no_ray_is_an_error_with_its_number(plane, rays, number):
    done = trace("--binary", plane, rays=rays)

    assert done.returncode == 1
    assert b"ray %d:" % number in done.stderr


def test_a_mesh_that_is_not_there_is_an_error(tmp_path):
    done = trace(tmp_path / "absent.obj", rays="0 0 0 0 0 1\n")

    assert done.returncode == 1 and "absent.obj" in done.stderr and done.stdout == ""


@pytest.mark.parametrize("arguments", [[], ["--cull", "front", "a.obj"], ["--cull"],
                                       ["--device", "x", "a.obj"], ["--no-such", "a.obj"]])
def test_wrong_usage_ends_with_2(arguments):
    done = trace(*arguments)

    assert done.returncode == 2 and done.stdout == "" and "--help" in done.stderr


def test_a_byte_order_mark_before_the_rays_is_passed_over(plane):
    assert answers(plane, rays="\ufeff0 0 10 0 0 -1\n") == ["10,0"]


def test_a_long_wall_stops_a_ray_and_shows_the_poster_before_it(tmp_path):
    wall = tmp_path / "wall.obj"
    wall.write_text("v 0.5 -5000 0\nv 0.5 -5000 0.5\nv 0.5 5000 0.5\nv 0.5 5000 0\nf 1 2 3 4\n")
    poster = tmp_path / "poster.obj"
    poster.write_text("v 0.49 -1 0\nv 0.49 -1 0.5\nv 0.49 1 0.5\nv 0.49 1 0\nf 1 2 3 4\n")
    at = np.random.default_rng(2).uniform((-0.98, -0.24), (0.98, 0.24), (2000, 2))
    rays = "".join("0 0 0.25 0.49 %.9g %.9g\n" % tuple(yz) for yz in at)

    leaving = answers(wall, rays="0 0 0.0001 0.498630 0.829878 0.250380\n")
    before = [line.split(",")[1] for line in answers(wall, poster, rays=rays)]

    t_m, facet = leaving[0].split(",")
    length = np.linalg.norm((0.498630, 0.829878, 0.250380))
    assert facet == "0" and float(t_m) == pytest.approx(length * 0.5 / 0.498630, rel=1e-6)
    assert set(before) == {"1"}
