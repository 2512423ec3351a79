
import numpy as np
import pytest
from ray_world import CAMERA, NONE, RayWorld

import cases

pytestmark = pytest.mark.usefixtures("ray_lanes")


def look_down(height, width, pixels):
    """A camera above the origin that sees `width` metres of the level z = 0; the top is north."""
    camera = np.zeros(1, CAMERA)
    camera["position"] = (0, 0, height)
    camera["corner"] = (-width / 2, width / 2, -height)
    camera["across"] = (width / pixels, 0, 0)
    camera["down"] = (0, -width / pixels, 0)
    return camera


def centres(width, pixels):
    """East and north of what each pixel looks at, rows from the north."""
    at = (np.arange(pixels) + 0.5) * width / pixels - width / 2
    east, south = np.meshgrid(at, at)
    return east.ravel(), -south.ravel()


def test_rows_run_from_the_north_and_columns_from_the_west(opencl):
    hits = RayWorld(opencl, cases.plane(50.0)).primary(look_down(100, 16, 8), 8, 0, 64)

    east, north = centres(16, 8)
    assert np.all(hits["facet"] == 0)
    assert hits["point"][:, 0] == pytest.approx(east, abs=1e-5)
    assert hits["point"][:, 1] == pytest.approx(north, abs=1e-5)
    assert hits["range_m"] == pytest.approx(np.sqrt(100**2 + east**2 + north**2), rel=1e-6)
    assert np.allclose(hits["normal"], (0, 0, 1))


def test_normals_turn_towards_the_camera(opencl):
    corner, position = cases.plane(50.0)
    upside_down = corner[:, ::-1], position

    hits = RayWorld(opencl, upside_down).primary(look_down(100, 16, 8), 8, 0, 64)

    assert np.allclose(hits["normal"], (0, 0, 1))


def test_points_lie_on_the_facet_though_the_camera_is_far(opencl):
    mesh = cases.icosphere(3)

    hits = RayWorld(opencl, mesh).primary(look_down(14000, 3, 64), 64, 0, 4096)

    met = hits[hits["facet"] != NONE]
    assert len(met) > 1000
    corner, position = mesh
    first = position[corner[met["facet"], 0]].astype(np.float64)
    height = ((met["point"] - first) * met["normal"]).sum(1)
    assert np.abs(height).max() < 5e-7  # a few roundings of coordinates up to 1 m, not of 14 km


def test_a_ray_that_misses_has_no_facet_and_an_infinite_range(opencl):
    hits = RayWorld(opencl, cases.box((100, 0, 0), (101, 1, 1))).primary(
        look_down(100, 16, 8), 8, 0, 64)

    assert np.all(hits["facet"] == NONE) and np.all(np.isinf(hits["range_m"]))


def test_what_leaves_the_geometry_downwards_meets_the_ground(opencl):
    world = RayWorld(opencl, cases.plane(4.0, z=2.0))
    world.world["ground_facet"] = 1
    world.world["ground_z_m"] = -10.0
    east, north = centres(16, 8)
    on_plane = (np.abs(east * 98 / 100) < 4) & (np.abs(north * 98 / 100) < 4)

    hits = world.primary(look_down(100, 16, 8), 8, 0, 64)

    assert np.array_equal(hits["facet"], np.where(on_plane, 0, 1))
    ground = hits[~on_plane]
    assert np.all(ground["point"][:, 2] == -10) and np.allclose(ground["normal"], (0, 0, 1))
    assert ground["point"][:, 0] == pytest.approx(1.1 * east[~on_plane], abs=1e-5)
    assert ground["range_m"] == pytest.approx(
        1.1 * np.sqrt(100**2 + east**2 + north**2)[~on_plane], rel=1e-6)


@pytest.mark.parametrize("local", [1, 64])
@pytest.mark.parametrize("tile", [7, 100])
def test_hits_do_not_depend_on_tiles(opencl, tile, local):
    world = RayWorld(opencl, cases.triangle_soup(300, seed=3))
    camera = look_down(10, 3, 20)
    whole = world.primary(camera, 20, 0, 400)

    parts = [world.primary(camera, 20, first, min(tile, 400 - first), local=local)
             for first in range(0, 400, tile)]

    assert whole.tobytes() == np.concatenate(parts).tobytes()
