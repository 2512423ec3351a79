
import numpy as np
import pytest
from ray_world import NONE, RayWorld, grid, points

import cases

pytestmark = pytest.mark.usefixtures("ray_lanes")

# What a direction at elevation e counts, by reading; eq. 2.4.2-6 with 2.4.2-7 is the last.
READINGS = {
    "cosine": lambda e: np.sin(e) * np.cos(e),
    "solid-angle": np.cos,
    "thesis": np.sin,
}
UP = (0, 0, 1)


def factors(opencl, mesh, hits, reading="cosine", steps=(15, 30)):
    return RayWorld(opencl, mesh).hemisphere(grid(*steps, READINGS[reading]), hits)


def tilted(mesh, normal, shift):
    """Turns a level mesh to a normal and moves it."""
    east = np.cross((0.3, 0.8, 0.1), normal)
    east /= np.linalg.norm(east)
    turn = np.stack([east, np.cross(normal, east), normal])
    return mesh[0], (mesh[1] @ turn + shift).astype(np.float32)


@pytest.mark.parametrize("reading", READINGS)
def test_a_facet_under_open_sky_has_shape_factor_one(opencl, reading):
    out = factors(opencl, cases.plane(50.0), points((3, 4, 0), UP), reading)

    assert out["shape_factor"][0] == 1
    assert out["met_count"][0] == 0
    assert out["material"][0] == NONE and out["facet"][0] == NONE


@pytest.mark.parametrize("reading", READINGS)
def test_an_enclosed_point_has_shape_factor_zero(opencl, reading):
    out = factors(opencl, cases.box(), points([(0.5, 0.5, 0), (0.01, 0.5, 0)], UP), reading)

    assert np.all(out["shape_factor"] == 0)
    assert np.all(out["met_count"] == 72)


@pytest.mark.parametrize("size", [1.0, 300.0])
@pytest.mark.parametrize("seed", range(8))
def test_a_plane_never_shadows_itself(opencl, size, seed):
    random = np.random.default_rng(seed)
    normal = random.normal(size=3)
    normal /= np.linalg.norm(normal)
    shift = random.uniform(-1000, 1000, 3)
    flat = [(x, y, 0) for y in np.linspace(-size, size, 5) for x in np.linspace(-size, size, 5)]
    faces = [(i, i + 1, i + 6, i + 5) for i in range(19) if i % 5 < 4]
    mesh = tilted(cases.mesh(flat, faces), normal, shift)
    across = random.uniform(-size, size, (200, 3)) * (1, 1, 0)
    position = tilted((None, across), normal, shift)[1]

    out = factors(opencl, mesh, points(position, normal), steps=(2.5, 10))

    assert np.all(out["shape_factor"] == 1)


def test_an_endless_wall_at_the_point_hides_half_the_sky(opencl):
    wall = cases.mesh([(0, -1e4, -1), (0, 1e4, -1), (0, 1e4, 1e4), (0, -1e4, 1e4)], [(0, 3, 2, 1)])

    out = factors(opencl, wall, points((-1.0, 0, 0), UP))

    # 6 of 12 azimuths at all elevations
    assert out["shape_factor"][0] == pytest.approx(0.5, abs=1e-6)


# Shares of the weight above 30 degrees: 1 - sin^2, 1 - sin and cos of 30; notes of the field agree.
@pytest.mark.parametrize("reading, fraction", [("cosine", 0.75), ("solid-angle", 0.5),
                                            ("thesis", 0.8660254)])
def test_a_ring_up_to_30_degrees_leaves_the_closed_form(opencl, reading, fraction):
    out = factors(opencl, cases.ring(10.0, 30.0), points((0, 0, 0), UP), reading, (1, 4))

    # 30 degrees lie on the border of two cells, so that midpoint sums have the integrals' ratio
    assert out["shape_factor"][0] == pytest.approx(fraction, abs=1e-6)


def ring_of_materials(opencl, material, temperature_k, number=None):
    """A low wall of 15 quads around the origin, each met by one ray of the lowest ring; cell j of
    it (azimuth 12 + 24 j degrees) meets quad (3 - j) mod 15. NONE leaves a gap."""
    corner, position = cases.ring(10.0, 12.0, count=15)
    keep = [i for i in range(15) if material[i] != NONE]
    world = RayWorld(opencl, (corner[keep], position))
    cells = grid(15, 24, READINGS["cosine"])
    facets = [material[i] for i in keep] + [0]
    temperatures = [temperature_k[i] for i in keep] + [0]
    out = world.hemisphere(cells, points((0, 0, 0), UP), facets, temperatures, number)
    return out[0], keep


def test_with_5_rays_on_trees_and_8_on_concrete_the_background_is_concrete(opencl):
    tree, concrete = 0, 1  # the example of thesis 2.4.2
    material = [tree] * 5 + [concrete] * 8 + [NONE] * 2

    out, _ = ring_of_materials(opencl, material, [300] * 15)

    assert out["met_count"] == 13
    assert out["material"] == concrete


def test_the_background_temperature_is_the_mean_over_rays(opencl):
    temperature = np.linspace(250, 390, 15)

    out, _ = ring_of_materials(opencl, [0] * 15, temperature)

    assert out["mean_temperature_k"] == pytest.approx(320.0, rel=1e-6)


def test_equally_common_materials_give_the_lowest_number(opencl):
    material = [2] * 5 + [0] * 5 + [1] * 5

    out, _ = ring_of_materials(opencl, material, [300] * 15, number=[30, 7, 12])

    assert out["material"] == 1


def test_the_facet_is_the_first_of_the_commonest_material_clockwise_from_north(opencl):
    material = [0] * 15
    material[3] = material[2] = 1  # met by cells 0 and 1

    out, _ = ring_of_materials(opencl, material, [300] * 15)

    assert out["facet"] == 1  # cell 2, azimuth 60 degrees
    azimuth = np.degrees(np.arctan2(out["point"][0], out["point"][1]))
    assert azimuth == pytest.approx(60, abs=1e-3)
    towards = -out["point"][:2] / np.linalg.norm(out["point"][:2])
    assert np.dot(out["normal"][:2], towards) == pytest.approx(np.cos(np.radians(6)), abs=1e-5)


def test_more_than_256_materials_are_no_harm(opencl):
    corner, position = cases.ring(10.0, 12.0, count=360)
    material = list(np.arange(360)) + [0]
    material[355] = 300  # twice: the commonest, met within the first 256 directions

    out = RayWorld(opencl, (corner, position)).hemisphere(
        grid(15, 1, READINGS["cosine"]), points((0, 0, 0), UP), material)

    assert out["material"][0] < 360 and out["met_count"][0] == 360


def over_ground(opencl, hits, **how):
    world = RayWorld(opencl, cases.box((100, 100, 100), (101, 101, 101)))
    world.world["ground_facet"] = world.facet_count
    world.world["ground_z_m"] = 1.0
    temperature = [400] * world.facet_count + [295]
    material = [0] * world.facet_count + [1]
    return world.hemisphere(grid(15, 30, READINGS["cosine"]), hits, material, temperature, **how)[0]


def test_half_of_what_a_wall_sees_is_the_ground(opencl):
    out = over_ground(opencl, points((5, 6, 3), (1, 0, 0)))

    assert out["shape_factor"] == pytest.approx(0.5, abs=1e-6)
    assert out["met_count"] == 36
    assert out["mean_temperature_k"] == 295 and out["material"] == 1 and out["facet"] == 6
    # cell 3 of the lowest ring: 7.5 degrees from the wall, 105 from upslope, clockwise from outside
    e, a = np.radians([7.5, 105])
    down = -np.cos(e) * np.cos(a)
    expected = [5 + 2 * np.sin(e) / down, 6 + 2 * np.cos(e) * np.sin(a) / down, 1]
    assert out["point"] == pytest.approx(expected, rel=1e-4)  # the offset of 1e-4 m from the wall
    assert list(out["normal"]) == [0, 0, 1]


def test_a_level_facet_over_the_ground_sees_the_sky_alone(opencl):
    assert over_ground(opencl, points((5, 6, 1), UP))["shape_factor"] == 1


def test_a_facet_that_looks_down_sees_the_ground_alone(opencl):
    out = over_ground(opencl, points((5, 6, 4), (0, 0, -1)))

    assert out["shape_factor"] == 0 and out["met_count"] == 72


def test_a_pixel_without_a_facet_has_factor_one_and_no_background(opencl):
    hits = points((5, 6, 3), (1, 0, 0))
    hits["facet"] = NONE

    out = over_ground(opencl, hits)

    assert out["shape_factor"] == 1 and out["met_count"] == 0
    assert out["material"] == NONE and out["facet"] == NONE


@pytest.mark.parametrize("local", [1, 16, 64])
def test_factors_do_not_depend_on_how_points_are_grouped(opencl, local):
    random = np.random.default_rng(1)
    normal = random.normal(size=(500, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    hits = points(random.uniform(-1, 1, (500, 3)), normal)
    world = RayWorld(opencl, cases.triangle_soup(300, seed=2))
    world.world["ground_facet"] = world.facet_count
    cells = grid(15, 30, READINGS["cosine"])
    material = np.arange(301) % 7
    whole = world.hemisphere(cells, hits, material)

    parts = [world.hemisphere(cells, p, material, local=local) for p in np.array_split(hits, 7)]

    assert whole.tobytes() == np.concatenate(parts).tobytes()


@pytest.mark.parametrize("ways", [1, 8, 200])
@pytest.mark.parametrize("spread_m, triangles", [(1.0, 300), (0.05, 300), (1.0, 5000)])
def test_words_of_packets_and_beams_are_those_of_single_rays(opencl, ways, spread_m, triangles):
    """A beam of points far apart meets more leaves among 5000 triangles than it lists."""
    random = np.random.default_rng(4)
    normal = random.normal(size=(ways, 3))
    normal = np.repeat(normal / np.linalg.norm(normal, axis=1, keepdims=True), 200 // ways, axis=0)
    hits = points(random.uniform(-spread_m, spread_m, (200, 3)), normal)
    hits["facet"][::7] = NONE
    world = RayWorld(opencl, cases.triangle_soup(triangles, seed=2))
    world.world["ground_facet"] = world.facet_count
    cells = grid(10, 20, READINGS["cosine"])  # 162 cells: three work-items of a packet
    words = []
    for world.lanes, options in ((16, ""), (16, "-DRAY_PORTABLE"), (1, "")):
        words.append(world.cast(cells, hits, (0.6, 0, 0.8), options=options))

    lit = ((words[2] != NONE) & (words[2] >> 31 == 1)).mean()
    assert 0.05 < lit < 0.5 if (spread_m, triangles) == (1.0, 300) else lit > 0
    assert np.array_equal(words[0], words[2])
    assert np.array_equal(words[1], words[2])
