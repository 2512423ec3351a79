
import numpy as np
import pytest
from ray_world import NONE, RayWorld

import cases

pytestmark = pytest.mark.usefixtures("ray_lanes")

MESHES = {
    "sphere": cases.icosphere(3),
    "soup": cases.triangle_soup(1000, seed=2),
    "box": cases.box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)),
    "plane": cases.plane(1.0),
}


def meet(mesh, rays):
    """Moeller-Trumbore in float64: ranges of shape (rays, triangles), inf for a miss, and the facet
    of every triangle."""
    vertices, facet = cases.triangles(*mesh)
    a, u, v = vertices[:, 0], vertices[:, 1] - vertices[:, 0], vertices[:, 2] - vertices[:, 0]
    origin, direction = rays[:, None, :3], rays[:, None, 3:]
    p = np.cross(direction, v)
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = 1 / (u * p).sum(-1)
        s = origin - a
        q = np.cross(s, u)
        first, second = (s * p).sum(-1) * inverse, (direction * q).sum(-1) * inverse
        t = (v * q).sum(-1) * inverse
        met = (first >= 0) & (second >= 0) & (first + second <= 1) & (t > 0)
    return np.where(met, t, np.inf), facet


def random_rays(count, seed, reach=2.0):
    random = np.random.default_rng(seed)
    origin = random.uniform(-reach, reach, (count, 3))
    return np.hstack([origin, random.uniform(-1, 1, (count, 3)) - origin]).astype(np.float32)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def grazing_sine(mesh, rays, facet):
    """Sine of the angle between rays and the facets (plane ones) that they meet."""
    corner, position = mesh
    a, b, c = (position[corner[facet, k]].astype(np.float64) for k in range(3))
    return np.abs((unit(np.cross(b - a, c - a)) * unit(rays[:, 3:].astype(np.float64))).sum(1))


@pytest.mark.parametrize("name", MESHES)
def test_the_nearest_facet_is_that_of_a_search_in_float64(opencl, name):
    rays = random_rays(20000, seed=1)
    expected, facet_of, found = [], [], []

    range_m, facet = RayWorld(opencl, MESHES[name]).trace(rays)

    for part in np.array_split(np.arange(len(rays)), 40):
        ranges, owner = meet(MESHES[name], rays[part].astype(np.float64))
        expected.append(ranges.min(1))
        facet_of.append(np.where(np.isfinite(ranges.min(1)), owner[ranges.argmin(1)], NONE))
        of_found = np.where(owner == facet[part][:, None], ranges, np.inf)
        found.append(of_found.min(1))
    expected, facet_of, found = map(np.concatenate, (expected, facet_of, found))
    hit = np.isfinite(expected)
    assert hit.any() and np.array_equal(facet != NONE, hit)
    other = hit & (facet != facet_of)
    assert np.all(found[other] <= expected[other] * (1 + 1e-6))  # nearer than float32 can tell
    length = np.linalg.norm(rays[hit, 3:], axis=1)
    error_m = np.abs(range_m[hit] - expected[hit]) * length
    # 2e-5 of the distance; next to a facet the rounding of coordinates up to 2 m, magnified as the
    # ray grazes it
    rounding_m = 2.0**-22 / grazing_sine(MESHES[name], rays[hit], facet[hit])
    assert np.all(error_m < np.maximum(2e-5 * expected[hit] * length, rounding_m))


def edge_targets(mesh):
    corner, position = mesh
    pairs = np.concatenate([corner[:, [0, 1]], corner[:, [1, 2]], corner[:, [2, 0]]])
    pairs = np.unique(np.sort(pairs, 1), axis=0)
    position = position.astype(np.float64)
    return np.concatenate([position, position[pairs].mean(1)])


@pytest.mark.parametrize("origin", [(0, 0, 0), (0.3, 0.2, 0.1), (0.9, 0.1, -0.2), (0, 1e-3, 0.99)])
def test_no_ray_leaves_a_closed_sphere(opencl, origin):
    mesh = cases.icosphere(5)
    target = edge_targets(mesh)
    assert len(mesh[0]) == 20480 and len(target) == 40962
    rays = np.hstack([np.tile(origin, (len(target), 1)), target - origin])
    world = RayWorld(opencl, mesh)

    _, facet = world.trace(rays)

    assert np.count_nonzero(facet == NONE) == 0
    assert world.occluded(rays).all()


def test_no_ray_leaves_a_closed_box_of_quads_that_stands_askew(opencl):
    """At its corners, the middles of its edges and of the diagonals of its faces, where quads are
    cut."""
    corner, position = cases.box((-1, -2, -0.5), (1, 2, 0.5))
    turn = np.linalg.qr(np.random.default_rng(16).normal(size=(3, 3)))[0]
    mesh = corner, (position @ turn).astype(np.float32)
    ends = mesh[1].astype(np.float64)
    pairs = np.array([(a, b) for face in corner for a in face for b in face if a < b])
    target = np.concatenate([ends, ends[pairs].mean(1)])
    inside = np.random.default_rng(17).uniform(-0.49, 0.49, (500, 3)) @ turn
    rays = np.hstack([np.repeat(inside, len(target), 0), np.tile(target, (len(inside), 1))])
    rays[:, 3:] -= rays[:, :3]
    world = RayWorld(opencl, mesh)

    assert np.count_nonzero(world.trace(rays)[1] == NONE) == 0
    assert world.occluded(rays).all()


@pytest.mark.parametrize("shift", [1e3, 1e5])
def test_no_ray_leaves_a_closed_sphere_far_from_the_origin(opencl, shift):
    mesh = cases.icosphere(3, radius=0.01 * shift, centre=(shift, -shift, shift))
    target = edge_targets(mesh)
    origin = np.array([shift, -shift, shift])
    rays = np.hstack([np.tile(origin, (len(target), 1)), target - origin])

    _, facet = RayWorld(opencl, mesh).trace(rays)

    assert np.count_nonzero(facet == NONE) == 0


def hills(count, step):
    """A square of (count, count) hilly cells of two triangles each."""
    x, y = np.meshgrid(*2 * [(np.arange(count + 1) - count / 2) * step])
    position = np.stack([x, y, step * np.sin(x) * np.cos(y)], -1).reshape(-1, 3)
    a = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    faces = np.concatenate([np.stack([a, a + 1, a + count + 2], 1),
                            np.stack([a, a + count + 2, a + count + 1], 1)])
    return cases.mesh(position, faces)


def test_no_ray_from_14_km_falls_through_the_ground(opencl):
    mesh = hills(100, step=5.0)
    target = edge_targets(mesh)
    target = target[(np.abs(target[:, :2]) < 230).all(1)]  # beyond, a ray may pass over the border
    camera = (7162.4, -6951.7, 10000.0)
    rays = np.hstack([np.tile(camera, (len(target), 1)), target - camera])
    world = RayWorld(opencl, mesh)

    assert np.count_nonzero(world.trace(rays)[1] == NONE) == 0
    assert world.occluded(rays).all()


@pytest.mark.parametrize("zero", [0.0, -0.0, 1e-30, -1e-30, 1e-42, -1e-42])  # denormal
@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_rays_along_an_axis_meet_a_box_whatever_the_sign_of_zero(opencl, zero, axis, sign):
    direction = [zero, zero, zero]
    direction[axis] = sign
    random = np.random.default_rng(3)
    origin = random.uniform(0.01, 0.99, (1000, 3))
    origin[:, axis] = 0.5 - 2 * sign
    rays = np.hstack([origin, np.tile(direction, (1000, 1))])
    west_to_top = {(0, 1): 4, (0, -1): 5, (1, 1): 2, (1, -1): 3, (2, 1): 0, (2, -1): 1}

    range_m, facet = RayWorld(opencl, cases.box()).trace(rays)

    assert np.all(facet == west_to_top[axis, sign])
    assert np.allclose(range_m, 1.5, rtol=1e-6)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_rays_along_the_faces_and_edges_of_a_box_meet_it(opencl, axis):
    at = np.array([0.0, 0.25, 1.0])
    origin = np.array(np.meshgrid(at, at, at)).reshape(3, -1).T
    origin[:, axis] = -1.0
    rays = np.hstack([origin, np.tile(np.eye(3)[axis], (len(origin), 1))])

    range_m, _ = RayWorld(opencl, cases.box()).trace(rays)

    assert np.allclose(range_m, 1.0, rtol=1e-6)


def test_of_facets_in_one_place_the_lowest_is_met(opencl):
    corner, position = cases.triangle_soup(50, seed=4)
    random = np.random.default_rng(5)
    order = random.permutation(np.repeat(np.arange(50), 40))
    mesh = corner[order], position
    rays = random_rays(5000, seed=6)
    first = np.array([np.flatnonzero(order == i)[0] for i in range(50)])

    _, facet = RayWorld(opencl, mesh).trace(rays)

    met = facet[facet != NONE]
    assert len(met) > 100
    assert np.array_equal(met, first[order[met]])


def test_both_halves_of_a_quad_are_one_facet(opencl):
    random = np.random.default_rng(7)
    origin = np.hstack([random.uniform(-1, 1, (1000, 2)), np.ones((1000, 1))])
    rays = np.hstack([origin, np.tile((0, 0, -1), (1000, 1))])
    mesh = cases.join(cases.plane(1.0, z=-1), cases.plane(1.0, z=0))

    _, facet = RayWorld(opencl, mesh).trace(rays)

    assert np.all(facet == 1)


def test_a_concave_quad_is_met_where_it_is_and_not_where_it_is_not(opencl):
    arrow = cases.mesh([(0, 0, 0), (4, 2, 0), (0, 4, 0), (1, 2, 0)], [(0, 1, 2, 3)])
    turned = arrow[0][:, [1, 2, 3, 0]], arrow[1]
    rays = np.array([(0.5, 2, 1, 0, 0, -1), (1.5, 2, 1, 0, 0, -1), (0.5, 0.6, 1, 0, 0, -1)])

    for mesh in (arrow, turned):
        _, facet = RayWorld(opencl, mesh).trace(rays)
        assert list(facet) == [NONE, 0, 0]


def test_culled_facets_are_met_from_the_front_alone(opencl):
    world = RayWorld(opencl, cases.icosphere(2))
    world.world["cull_back"] = 1
    direction = unit(np.random.default_rng(8).normal(size=(2000, 3)))
    out = np.hstack([np.zeros_like(direction), direction])
    inwards = np.hstack([3 * direction, -direction])

    assert np.all(world.trace(out)[1] == NONE) and not world.occluded(out).any()
    assert np.all(world.trace(inwards)[1] != NONE) and world.occluded(inwards).all()


def test_two_sided_facets_are_met_from_behind_though_others_are_culled(opencl):
    mesh = MESHES["soup"]
    two_sided = np.arange(len(mesh[0])) % 3 == 0
    world, twice = RayWorld(opencl, mesh), RayWorld(opencl, mesh, two_sided)
    twice.world["cull_back"] = 1
    rays = random_rays(20000, seed=15)
    a, b, c = (mesh[1][mesh[0][:, k]].astype(np.float64) for k in range(3))
    normal = np.cross(b - a, c - a)

    # The nearest of all that may be met: rays that meet a facet from behind go on beyond it.
    facet = np.full(len(rays), NONE)
    left, at = np.arange(len(rays)), rays.astype(np.float64)
    while len(left):
        range_m, met = world.trace(at[left])
        left, range_m, met = (x[met != NONE] for x in (left, range_m, met))
        seen = two_sided[met] | ((normal[met] * at[left, 3:]).sum(1) < 0)
        facet[left[seen]] = met[seen]
        at[left, :3] += at[left, 3:] * (range_m * (1 + 1e-6) + 1e-6)[:, None]
        left = left[~seen]

    _, found = twice.trace(rays)

    assert np.count_nonzero(found != facet) <= 20  # 1e-3: steps over facets within 1e-6
    assert np.array_equal(twice.occluded(rays) == 1, found != NONE)


def test_any_hit_says_what_the_nearest_says(opencl):
    world = RayWorld(opencl, MESHES["soup"])
    rays = random_rays(20000, seed=9)

    assert np.array_equal(world.occluded(rays) == 1, world.trace(rays)[1] != NONE)


def test_a_ray_misses_where_there_is_no_geometry(opencl):
    world = RayWorld(opencl, cases.mesh(np.zeros((1, 3)), []))

    range_m, facet = world.trace(random_rays(100, seed=10))

    assert np.all(facet == NONE) and np.all(np.isinf(range_m))


def test_what_has_no_area_or_is_not_finite_is_not_met(opencl):
    position = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (np.nan, 0, 0), (np.inf, 0, 0)]
    mesh = cases.mesh(position, [(0, 1, 2), (0, 0, 3), (0, 1, 4), (0, 3, 5), (0, 1, 3)])
    rays = np.array([(0.2, 0.2, 1, 0, 0, -1), (1.5, 0, 1, 0, 0, -1), (0, 5, 1, 0, 0, -1)])

    _, facet = RayWorld(opencl, mesh).trace(rays)

    assert list(facet) == [4, NONE, NONE]


@pytest.mark.parametrize("direction", [(0, 0, 0), (np.nan, 0, 1), (np.inf, 0, 1)])
def test_a_ray_without_a_direction_misses(opencl, direction):
    _, facet = RayWorld(opencl, MESHES["sphere"]).trace([(0, 0, 0, *direction)])

    assert facet[0] == NONE


def test_ranges_count_in_lengths_of_the_direction(opencl):
    rays = [(0, 0, 2, 0, 0, -1), (0, 0, 2, 0, 0, -4), (0, 0, 2, 0, 0, -1e-3)]

    range_m, _ = RayWorld(opencl, MESHES["plane"]).trace(rays)

    assert list(range_m) == pytest.approx([2, 0.5, 2000], rel=1e-6)


def test_portable_masks_give_the_same_bits(opencl):
    world = RayWorld(opencl, MESHES["soup"])
    rays = random_rays(5000, seed=11)

    builtin, portable = world.trace(rays), world.trace(rays, options="-DRAY_PORTABLE")

    assert builtin[0].tobytes() == portable[0].tobytes()
    assert np.array_equal(builtin[1], portable[1])
    blocked = world.occluded(rays)
    assert np.array_equal(blocked, world.occluded(rays, options="-DRAY_PORTABLE"))
    assert np.array_equal(blocked != 0, builtin[1] != NONE)


def streets():
    """Long low walls and houses on a plane."""
    random = np.random.default_rng(13)
    at = random.uniform(-300, 300, (300, 2))
    size = random.uniform(1, 40, (300, 3))
    houses = [cases.box((x, y, 0), (x + a, y + b, c)) for (x, y), (a, b, c) in zip(at, size)]
    walls = [cases.box((x, -1200, -1.5), (x + 5, 1100, -0.5)) for x in range(-400, 401, 100)]
    return cases.join(cases.plane(500.0), *houses, *walls)


def rays_from_surfaces(mesh, count, seed):
    """Rays that leave facets a little above them; runs of rays from one facet are broken by others,
    so that packets are mixed."""
    vertices, _ = cases.triangles(*mesh)
    random = np.random.default_rng(seed)
    of = np.repeat(random.integers(len(vertices), size=count // 16), 16)
    stray = random.random(count) < 0.1
    of[stray] = random.integers(len(vertices), size=stray.sum())
    a, b, c = vertices[of].transpose(1, 0, 2)
    normal = unit(np.cross(b - a, c - a))
    u, v = np.sort(random.random((2, count)), 0)[:, :, None]
    origin = a * u + b * (v - u) + c * (1 - v) + 2.0**-20 * np.abs(mesh[1]).max() * normal
    fixed = np.repeat(random.normal(size=(count // 16, 3)), 16, 0)
    direction = fixed * np.sign((fixed * normal).sum(1))[:, None]
    return np.hstack([origin, direction]).astype(np.float32)


def test_packets_answer_as_single_rays(opencl, monkeypatch):
    mesh = streets()
    world = RayWorld(opencl, mesh)
    rays = rays_from_surfaces(mesh, 1 << 17, seed=14)
    monkeypatch.setattr(RayWorld, "lanes", 16)
    range_m, facet = world.trace(rays, local=1)
    met = world.occluded(rays, local=1)

    monkeypatch.setattr(RayWorld, "lanes", 1)
    single_m, single_facet = world.trace(rays)

    assert range_m.tobytes() == single_m.tobytes()
    assert np.array_equal(facet, single_facet)
    assert np.array_equal(met, world.occluded(rays))


@pytest.mark.parametrize("local", [1, 16, 64])
def test_answers_do_not_depend_on_how_rays_are_grouped(opencl, local):
    world = RayWorld(opencl, MESHES["soup"])
    rays = random_rays(5000, seed=12)
    whole = world.trace(rays)

    parts = [world.trace(part, local=local) for part in np.array_split(rays, 7)]

    assert whole[0].tobytes() == np.concatenate([p[0] for p in parts]).tobytes()
    assert np.array_equal(whole[1], np.concatenate([p[1] for p in parts]))
