"""Rays beside facets much longer than the hit is far. Expected ranges come from numpy's long double
(64 bits), with which the sums that cancel keep 1e-7 of a metre."""

import numpy as np
import pytest
import ray_world
from ray_world import NONE, RayWorld

import cases

pytestmark = pytest.mark.usefixtures("ray_lanes")

LENGTHS_M = [2e3, 1e4, 2e4, 1e5, 5e5]


def unit(vector):
    return vector / np.linalg.norm(vector)


def turn(seed):
    """A rotation, or none for 0."""
    if seed == 0:
        return np.eye(3)
    return np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]


def wall(x, length, low=0.0, high=0.5):
    """An upright quad at x, along y."""
    half = 0.5 * length
    return cases.mesh([(x, -half, low), (x, -half, high), (x, half, high), (x, half, low)],
                      [(0, 1, 2, 3)])


def turned(mesh, rotation):
    return mesh[0], np.float32(mesh[1].astype(np.float64) @ rotation)


def planes(mesh):
    """Of every triangle: a corner and the normal, in long double."""
    vertices, facet = cases.triangles(*mesh)
    vertices = vertices.astype(np.longdouble)
    a = vertices[:, 0]
    return a, np.cross(vertices[:, 1] - a, vertices[:, 2] - a), facet


def ranges(mesh, rays):
    """To the planes of the triangles: shape (rays, triangles)."""
    corner, normal, _ = planes(mesh)
    rays = rays.astype(np.longdouble)
    away = corner[None] - rays[:, None, :3]
    return (away * normal[None]).sum(-1) / (rays[:, None, 3:] * normal[None]).sum(-1)


def ulp(mesh):
    """Of the largest coordinate."""
    return np.spacing(np.abs(mesh[1]).max())


def rays_to(target, origin, rotation):
    """Rays from points to others, all turned."""
    origin = np.broadcast_to(origin, target.shape)
    return np.float32(np.hstack([origin @ rotation, (target - origin) @ rotation]))


def targets(x, count=4000, reach=2.0, seed=1):
    """Points of a wall at x, a fifth of its height from its edges."""
    random = np.random.default_rng(seed)
    return np.column_stack([np.full(count, x), random.uniform(-reach, reach, count),
                            random.uniform(0.1, 0.4, count)])


def check(world, rays, facet, mesh, own):
    """Every ray meets the facet, of which the triangles `own` are, where its plane is."""
    range_m, found = world.trace(rays)

    assert np.count_nonzero(found != facet) == 0
    assert world.occluded(rays).all()
    # A ray near the diagonal may count for either half; their planes are within an ulp of each other.
    error = np.abs(range_m[:, None] - ranges(mesh, rays)[:, own]).min(1)
    along = np.linalg.norm(rays[:, 3:].astype(np.float64), axis=1)
    assert np.max(error * along) < 2 * ulp(mesh)


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize("length", LENGTHS_M)
def test_no_ray_passes_through_a_long_wall(opencl, length, seed):
    rotation = turn(seed)
    mesh = turned(wall(0.5, length), rotation)
    rays = rays_to(targets(0.5), (0, 0, 0.25), rotation)

    check(RayWorld(opencl, mesh), rays, 0, mesh, [0, 1])


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize("length", LENGTHS_M)
def test_a_poster_is_met_before_the_long_wall_behind_it(opencl, length, seed):
    """4 ulp before it: 1 cm before 40 km, 0.12 m before 500 km."""
    rotation = turn(seed)
    gap = max(0.01, 4 * np.spacing(np.float32(0.5 * length)))
    mesh = turned(cases.join(wall(0.5, length), wall(0.5 - gap, 4.0, -1, 2)), rotation)
    rays = rays_to(targets(0.5, reach=1.5), (0, 0, 0.25), rotation)

    world = RayWorld(opencl, mesh)

    assert np.all(world.trace(rays)[1] == 1)


@pytest.mark.parametrize("seed", [0, 1])
def test_a_line_painted_on_a_road_is_met_before_it(opencl, seed):
    """A kilometre of road, with a line 1 mm above it: seen from 2 m."""
    rotation = turn(seed)
    road = cases.mesh([(-5, -500, 0), (5, -500, 0), (5, 500, 0), (-5, 500, 0)], [(0, 1, 2, 3)])
    line = cases.mesh([(-.1, -450, 1e-3), (.1, -450, 1e-3), (.1, 450, 1e-3), (-.1, 450, 1e-3)],
                      [(0, 1, 2, 3)])
    mesh = turned(cases.join(road, line), rotation)
    random = np.random.default_rng(3)
    target = np.column_stack([random.uniform(-.09, .09, 4000), random.uniform(1, 100, 4000),
                              np.full(4000, 1e-3)])
    rays = rays_to(target, (0, -2, 2), rotation)

    assert np.all(RayWorld(opencl, mesh).trace(rays)[1] == 1)


def test_rays_pass_a_long_wall_above_and_below(opencl):
    mesh = wall(0.5, 1e4)
    target = targets(0.5)
    target[:, 2] += np.where(np.arange(len(target)) % 2, 0.5, -0.5)
    rays = rays_to(target, (0, 0, 0.25), np.eye(3))
    world = RayWorld(opencl, mesh)

    assert np.all(world.trace(rays)[1] == NONE)
    assert not world.occluded(rays).any()


def test_a_wall_that_a_ray_leaves_is_not_met(opencl):
    """From 0.1 mm before a wall of 10 km, away from it."""
    random = np.random.default_rng(4)
    origin = targets(0.5, reach=1000)
    origin[:, 0] -= 1e-4
    direction = random.normal(size=origin.shape)
    direction[:, 0] = -np.abs(direction[:, 0])
    rays = np.float32(np.hstack([origin, direction]))
    world = RayWorld(opencl, wall(0.5, 1e4))

    assert np.all(world.trace(rays)[1] == NONE)
    assert not world.occluded(rays).any()


def test_packets_meet_long_facets_as_single_rays_do(opencl, monkeypatch):
    """Streets of walls up to 100 km long, rays from near them to all sides."""
    random = np.random.default_rng(5)
    walls = [turned(wall(random.uniform(.1, 20), 10 ** random.uniform(0, 5)), turn(seed))
             for seed in range(1, 300)]
    mesh = cases.join(*walls)
    origin = np.repeat(random.uniform(-3, 3, (2000, 3)), 32, 0)
    mean = np.repeat(random.normal(size=(2000, 3)), 32, 0)
    rays = np.hstack([origin, mean + random.normal(size=mean.shape) *
                      np.repeat(random.choice([0, .1, 1], 2000), 32)[:, None]])
    world = RayWorld(opencl, mesh)
    monkeypatch.setattr(RayWorld, "lanes", 16)
    range_m, facet = world.trace(rays)
    met = world.occluded(rays)
    assert np.array_equal(met != 0, facet != NONE)

    monkeypatch.setattr(RayWorld, "lanes", 1)
    single_m, single_facet = world.trace(rays)

    assert range_m.tobytes() == single_m.tobytes()
    assert np.array_equal(facet, single_facet)
    assert np.array_equal(met, world.occluded(rays))


def slope(half, rise):
    """A square plane that rises to the east."""
    return cases.mesh([(-half, -half, -rise * half), (half, -half, rise * half),
                       (half, half, rise * half), (-half, half, -rise * half)], [(0, 1, 2, 3)])


def hits_on_slope(at, rise):
    """Points (n, 2) on it, as float32 has them, and its normal."""
    normal = np.array([-rise, 0, 1]) / np.hypot(rise, 1)
    return ray_world.points(np.column_stack([at, rise * at[:, 0]]), normal)


@pytest.mark.parametrize("rise", [0.0, 0.001, 0.75])
@pytest.mark.parametrize("spread", [1.0, 1e3, 4e4])
def test_a_plane_of_100_km_does_not_shade_itself(opencl, rise, spread):
    at = np.random.default_rng(6).uniform(-spread, spread, (4000, 2))
    normal = np.array([-rise, 0, 1]) / np.hypot(rise, 1)
    world = RayWorld(opencl, slope(5e4, rise))

    for along in ((1, 0.3, 0), (0.3, -1, 0), (0.2, 1, 0)):  # 3 degrees above the plane
        level = np.array(along) - np.dot(along, normal) * normal
        sun = unit(unit(level) + 0.05 * normal)
        assert world.sunlight(sun, hits_on_slope(at, rise)).all()


@pytest.mark.parametrize("place", [(3.0, 4.0), (300.0, -700.0), (4e4, -3e4)])
@pytest.mark.parametrize("cells", [1, 200])
def test_what_lies_2_cm_above_100_km_of_ground_casts_its_shadow(opencl, place, cells):
    line = np.linspace(-5e4, 5e4, cells + 1)
    x, y = np.meshgrid(line, line)
    a = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    ground = cases.mesh(np.stack([x, y, 0 * x + 200], -1),
                        np.stack([a, a + 1, a + cells + 2, a + cells + 1], 1))
    plate = cases.plane(1.0, z=200.02)
    plate[1][:, :2] += place
    at = np.array(place) + np.random.default_rng(7).uniform(-0.8, 0.8, (1000, 2))
    below = ray_world.points(np.column_stack([at, np.full(1000, 200.0)]), (0, 0, 1))
    beside = ray_world.points(np.column_stack([at + 3, np.full(1000, 200.0)]), (0, 0, 1))
    world, sun = RayWorld(opencl, cases.join(ground, plate)), unit(np.array([1.0, 1.0, 1.0]))

    assert not world.sunlight(sun, below).any()
    assert world.sunlight(sun, beside).all()
