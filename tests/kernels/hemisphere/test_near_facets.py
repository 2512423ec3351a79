"""near_facets.cl against Lambert's formula in double precision, polygons clipped at the horizon."""
import numpy as np
import pytest
from ray_world import NONE, RayWorld, points

import cases

pytestmark = pytest.mark.usefixtures("ray_lanes")

ROWS, LEAST = 12, 0.01
RINGS, AROUND = 6, 12


def sets_of_cells(random, sets):
    down, along = random.random((2, sets, RINGS, AROUND))
    level = np.sqrt((np.arange(RINGS)[::-1, None] + down) / RINGS)
    turn = (np.arange(AROUND) + along) * 2 * np.pi / AROUND
    cells = np.stack([level * np.cos(turn), level * np.sin(turn), np.sqrt(1 - level**2),
                      0 * level + 1 / (RINGS * AROUND)], -1)
    return cells.reshape(sets, RINGS * AROUND, 4).astype(np.float32)


def clipped(polygon, normal):
    """What is left of a polygon above the horizon of the origin."""
    out = []
    for a, b in zip(polygon, np.roll(polygon, -1, 0)):
        up, down = a @ normal, b @ normal
        if up > 0:
            out.append(a)
        if (up > 0) != (down > 0):
            out.append(a + (b - a) * up / (up - down))
    return np.array(out)


def form_factor(polygon, normal):
    corners = clipped(polygon, normal)
    if len(corners) < 3:
        return 0.0
    total = 0.0
    for a, b in zip(corners, np.roll(corners, -1, 0)):
        across = np.cross(a, b)
        size = np.linalg.norm(across)
        if size > 0:
            total += np.arctan2(size, a @ b) * (across @ normal) / size
    return abs(total) / (2 * np.pi)


def directions(cells, normal):
    """The world's, as hemisphere.h turns them."""
    level = np.hypot(*normal[:2])
    up = np.array([-normal[2] * normal[0] / level, -normal[2] * normal[1] / level, level]) if level >= 1e-4 else (
        np.array([0.0, 1.0, 0.0]))
    return cells[:, :3].astype(float) @ np.stack([up, np.cross(up, normal), normal])


def lacking(polygon, normal, cells):
    """Form factor less the weights of the directions that meet it; and how far a direction is from an edge."""
    inward = np.stack([np.cross(polygon[k], polygon[(k + 1) % 3]) for k in range(3)])
    inward *= np.sign(polygon[2] @ inward[0]) / np.linalg.norm(inward, axis=1)[:, None]
    side = directions(cells, normal) @ inward.T
    return form_factor(polygon, normal) - cells[(side >= 0).all(1), 3].sum(), np.abs(side).min()


def find(world, cells, hits, which):
    count, n = len(hits), cells.shape[1]
    met, near = np.empty((n + ROWS, count), np.uint32), np.empty((ROWS, 4, count), np.float32)
    world.run("near_facets", world.packets(count), count=count, cell_count=n, sun_x=0, sun_y=0, sun_z=0,
              hemisphere={"cell": cells, "hit": hits, "met": met[:1], "direction_set": which}, out_met=met,
              out_near=near)
    return met[n:], near


def scene(random, count):
    """Triangles around a level place, some of them partly below it."""
    corners = []
    for k in range(count):
        turn = 2 * np.pi * k / count
        middle = np.array([np.cos(turn), np.sin(turn), 0.4]) * random.uniform(1.0, 1.5)
        corners += list(middle + random.uniform(-0.6, 0.6, (3, 3)))
    return cases.mesh(corners, [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(count)])


@pytest.mark.parametrize("seed", range(4))
def test_what_rays_lack_of_near_facets(opencl, seed):
    random = np.random.default_rng(seed)
    world, cells = RayWorld(opencl, scene(random, 9)), sets_of_cells(random, 4)
    mesh = scene(np.random.default_rng(seed), 9)
    normal = random.normal(size=(40, 3)) * (0.3, 0.3, 0) + (0, 0, 1)
    normal[:25] = 0, 0, 1
    normal = (normal / np.linalg.norm(normal, axis=1)[:, None]).astype(np.float32)
    place = (random.uniform(-0.1, 0.1, (40, 3)) * (1, 1, 0)).astype(np.float32)
    hits = points(place, normal)
    hits["facet"], hits["range_m"] = 99, 100
    which = random.integers(0, 4, 40).astype(np.uint32)

    met, near = find(world, cells, hits, which)

    faces, vertices = mesh[0], mesh[1].astype(float)
    found = 0
    for i in range(40):
        origin = place[i] + float(world.world["offset_m"][0]) * normal[i].astype(float)
        got = {int(met[k, i]): near[k, 0, i] for k in range(ROWS) if near[k, 0, i] != 0}
        for facet, face in enumerate(faces):
            polygon = vertices[face[:3]] - origin
            fraction = form_factor(polygon, normal[i].astype(float))
            expected, clear = lacking(polygon, normal[i].astype(float), cells[which[i]])
            if clear < 1e-5 or abs(fraction - LEAST) < 1e-5 or abs(normal[i][2] - 1) > 1e-6:
                continue  # in single precision the direction may fall on the other side; weights of tilted ones below
            if fraction < LEAST:
                assert facet not in got
            elif facet in got:
                found += 1
                assert got[facet] == pytest.approx(expected, abs=2e-6)  # float32 sums of 72 weights
    assert found > 10


def test_a_facet_behind_another_lacks_nothing(opencl):
    wall = [(1, -1, 0), (1, 1, 0), (1, 0, 1.5)]
    behind = [(2, -2, 0), (2, 2, 0), (2, 0, 2.2)]
    world = RayWorld(opencl, cases.mesh(wall + behind, [(0, 1, 2), (3, 4, 5)]))
    cells = sets_of_cells(np.random.default_rng(0), 1)
    hits = points((0, 0, 0), (0, 0, 1))
    hits["facet"], hits["range_m"] = 99, 100

    met, near = find(world, cells, hits, np.zeros(1, np.uint32))

    assert set(met[near[:, 0, 0] != 0, 0]) == {0}


def test_what_is_far_or_below_the_horizon_is_not_near(opencl):
    far = [(20, -1, 0), (20, 1, 0), (20, 0, 1)]
    below = [(1, -1, -1), (1, 1, -1), (2, 0, -0.1)]
    world = RayWorld(opencl, cases.mesh(far + below, [(0, 1, 2), (3, 4, 5)]))
    hits = points((0, 0, 0), (0, 0, 1))
    hits["facet"], hits["range_m"] = 99, 100

    met, near = find(world, sets_of_cells(np.random.default_rng(0), 1), hits, np.zeros(1, np.uint32))

    assert (near[:, 0] == 0).all() and (met == NONE).all()


def test_the_mean_over_sets_is_nothing(opencl):
    """What is lacking is a control: its mean over all sets is 0, for tilted points and facets cut by the horizon too."""
    random = np.random.default_rng(5)
    sets = 4000
    mesh = cases.mesh([(1, -1, -0.3), (1, 1, -0.2), (1, 0, 1.5), (-1, -1.2, 0), (-1.5, 1, 0.2), (-1.2, 0, 1.1),
                       (-0.8, 1.4, -0.4), (0.7, 1.3, 0.1), (0, 1.2, 1.4)], [(0, 1, 2), (3, 4, 5), (6, 7, 8)])
    world, cells = RayWorld(opencl, mesh), sets_of_cells(random, sets)
    normal = np.array([0.35, -0.2, 0.9])
    hits = np.repeat(points((0.02, 0.03, 0), normal / np.linalg.norm(normal)), sets)
    hits["facet"], hits["range_m"] = 99, 100

    met, near = find(world, cells, hits, np.arange(sets, dtype=np.uint32))

    weights = near[:, 0]
    rows = (weights != 0).any(1)
    faces = [mesh[1][face[:3]].astype(float) - hits["point"][0] for face in mesh[0]]
    assert rows.sum() == sum(form_factor(face, hits["normal"][0]) > LEAST for face in faces) > 1
    error = weights[rows].std(axis=1) / np.sqrt(sets)
    # 4 standard errors, and what turning shares of the sky and the ground into their exact ones biases: 2e-4
    assert (np.abs(weights[rows].mean(axis=1)) < 4 * error + 2e-4).all()
