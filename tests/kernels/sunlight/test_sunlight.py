
import numpy as np
import pytest
from ray_world import NONE, RayWorld, points

import cases

pytestmark = pytest.mark.usefixtures("ray_lanes")

UP = (0, 0, 1)
SUN_30 = (0, -np.cos(np.radians(30)), 0.5)  # in the south, 30 degrees high


def tower(opencl):
    """A level plane and a tower one metre wide and ten metres high at the origin."""
    mesh = cases.join(cases.plane(50.0), cases.box((-0.5, -0.5, 0), (0.5, 0.5, 10)))
    return RayWorld(opencl, mesh)


def test_a_level_plane_is_lit_where_nothing_stands_before_the_sun(opencl):
    assert tower(opencl).sunlight(SUN_30, points((5, 5, 0), UP))[0] == 1


@pytest.mark.parametrize("distance, lit", [(17.30, 0), (17.35, 1)])
def test_the_shadow_of_a_tower_ends_at_its_height_over_the_tangent(opencl, distance, lit):
    point = (0, 0.5 + distance, 0)  # the shadow of the far edge falls 10 m / tan 30 = 17.32 m away

    assert tower(opencl).sunlight(SUN_30, points(point, UP))[0] == lit


def test_a_wall_turned_away_is_not_lit(opencl):
    walls = points([(0, -0.5, 5), (0, 0.5, 5)], [(0, -1, 0), (0, 1, 0)])

    assert list(tower(opencl).sunlight(SUN_30, walls)) == [1, 0]


@pytest.mark.parametrize("sun", [(0, -1, 0), (0, -0.8, -0.6)])
def test_nothing_is_lit_when_the_sun_is_not_above_the_horizon(opencl, sun):
    wall = points((0, -0.5, 5), (0, -1, 0))

    assert tower(opencl).sunlight(sun, wall)[0] == 0


def test_the_ground_plane_is_always_lit_by_day(opencl):
    world = tower(opencl)
    world.world["ground_facet"] = world.facet_count
    hits = points((0, 5, 0), UP)
    assert world.sunlight(SUN_30, hits)[0] == 0

    hits["facet"] = world.facet_count

    assert world.sunlight(SUN_30, hits)[0] == 1
    assert world.sunlight((0, -0.8, -0.6), hits)[0] == 0


def test_a_pixel_without_a_facet_is_not_lit(opencl):
    hits = points((5, 5, 0), UP)
    hits["facet"] = NONE

    assert tower(opencl).sunlight(SUN_30, hits)[0] == 0


def test_a_sphere_is_lit_on_the_side_of_the_sun_alone(opencl):
    mesh = cases.icosphere(4)
    vertices, _ = cases.triangles(*mesh)
    normal = np.cross(vertices[:, 1] - vertices[:, 0], vertices[:, 2] - vertices[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    cosine = normal @ SUN_30

    lit = RayWorld(opencl, mesh).sunlight(SUN_30, points(vertices.mean(1), normal))

    clear = np.abs(cosine) > 1e-6
    assert np.array_equal(lit[clear], (cosine[clear] > 0).astype(np.float32))
