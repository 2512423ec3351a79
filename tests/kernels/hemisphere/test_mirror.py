
import numpy as np
import pytest
import records
from radiometry_reference import unit
from ray_world import RayWorld
from records import NONE

import cases

MIRROR, DULL = 0, 1
EYE = np.array([3.0, -4.0, 20.0])


def reflect(opencl, world, points, normals, *, material=MIRROR, before=None):
    """Backgrounds of points on facet 0, which the eye sees; facet i has 280 + i kelvin."""
    facets = np.zeros(world.facet_count + 1, records.FACET)
    facets["material"] = DULL
    facets["material"][0] = material
    materials = np.zeros(2, records.MATERIAL)
    materials["specular_share"] = (1, 0)
    hit = np.zeros(len(points), records.HIT)
    hit["point"], hit["normal"] = points, normals
    background = np.zeros(len(points), records.BACKGROUND) if before is None else before.copy()
    camera = np.zeros(1, records.CAMERA)
    camera["position"] = EYE
    temperature = np.float32(280) + np.arange(len(facets), dtype=np.float32)
    opencl.run("mirror", (64,), (64,), count=len(points), camera=camera, tree=world.tree,
               surface={"facets": facets, "materials": materials, "facet_temperature_k": temperature},
               hit=hit, background=background)
    return background


def bounce(points, normal):
    """Direction by the law of reflection: in the plane of incidence, at the same angle."""
    to_eye = unit(EYE - points)
    return 2 * (to_eye @ normal)[:, None] * normal - to_eye


@pytest.fixture(scope="module")
def in_a_sphere(opencl):
    """A tilted mirror of 2 m at the centre of a sphere of radius 1000 m: facet 0 and the rest."""
    normal = unit((0.3, -0.2, 0.9))
    u = unit(np.cross(normal, (1, 0, 0)))
    v = np.cross(normal, u)
    corners = [a * u + b * v for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    mirror = cases.mesh(corners, [(0, 1, 2, 3)])
    at = np.random.default_rng(3).uniform(-1, 1, (50, 2))
    points = at[:, :1] * u + at[:, 1:] * v
    return RayWorld(opencl, cases.join(mirror, cases.icosphere(4, 1000.0))), points, normal


def test_what_a_tilted_mirror_shows_lies_where_the_law_of_reflection_says(opencl, in_a_sphere):
    world, points, normal = in_a_sphere

    behind = reflect(opencl, world, points, normal)

    met = behind["point"].astype(np.float64) - points
    assert np.all(behind["facet"] != NONE)
    # Points of 1000 m are rounded to 6e-5 m, and the start lies 1 mm above the mirror.
    assert unit(met) == pytest.approx(bounce(points, normal), abs=2e-6)


def test_a_mirror_s_background_is_the_facet_met(opencl, in_a_sphere):
    world, points, normal = in_a_sphere

    behind = reflect(opencl, world, points, normal)

    assert np.all(behind["shape_factor"] == 0) and np.all(behind["met_count"] == 1)
    assert np.all(behind["material"] == DULL)
    assert np.array_equal(behind["mean_temperature_k"], np.float32(280) + behind["facet"])
    towards = (behind["normal"] * (points - behind["point"])).sum(1)
    assert np.all(towards > 900)  # turned to the mirror, nearly along the radius


def test_a_mirror_under_nothing_shows_the_sky(opencl):
    world = RayWorld(opencl, cases.plane(5.0))

    behind = reflect(opencl, world, [(0.0, 0, 0), (4, 4, 0)], (0, 0, 1))

    assert np.all(behind["shape_factor"] == 1)
    assert np.all(behind["facet"] == NONE) and np.all(behind["material"] == NONE)
    assert np.all(behind["mean_temperature_k"] == 0) and np.all(behind["met_count"] == 0)


def test_an_upright_mirror_shows_the_ground_plane(opencl):
    wall = cases.mesh([(-5, 0, 0), (5, 0, 0), (5, 0, 10), (-5, 0, 10)], [(0, 1, 2, 3)])
    world = RayWorld(opencl, wall)
    world.world["ground_facet"], world.world["ground_z_m"] = 1, -2.0
    point = np.array([[1.0, 0.0, 5.0]])

    behind = reflect(opencl, world, point, (0, -1, 0))[0]

    direction = bounce(point, np.array([0.0, -1.0, 0.0]))[0]
    expected = point[0] + direction * (-7 / direction[2])
    assert behind["facet"] == 1 and behind["shape_factor"] == 0
    assert behind["mean_temperature_k"] == 281
    assert behind["point"] == pytest.approx(expected, abs=1e-5)  # roundings of 10 m
    assert behind["normal"] == pytest.approx((0, 0, 1))


def test_a_dull_target_keeps_its_hemisphere(opencl):
    before = np.zeros(2, records.BACKGROUND)
    before["shape_factor"], before["facet"], before["met_count"] = 0.4, 7, 31
    world = RayWorld(opencl, cases.plane(5.0))

    behind = reflect(opencl, world, [(0.0, 0, 0), (1, 1, 0)], (0, 0, 1), material=DULL,
                     before=before)

    assert behind.tobytes() == before.tobytes()
