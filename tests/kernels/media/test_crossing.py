"""Lengths inside transmissive bodies, against closed forms of chords."""

import numpy as np
import probe
import pyopencl as cl
import pytest
import records
import tree

import cases

LEVELS = np.float32([[300, 290], [1300, 280], [2300, 285]])
BODY = """
#include "kernels/media/crossing.h"
kernel void probe(TABLES(MEDIUM_TABLES), global const float *rays, global transmission_path *out)
{
    const uint i = get_global_id(0);
    const medium_tables medium = TABLES_GIVEN(MEDIUM_TABLES);
    ray r = {.limit = rays[7 * i + 6]};
    for (int k = 0; k < 3; k++) r.origin[k] = rays[7 * i + k];
    for (int k = 0; k < 3; k++) r.direction[k] = rays[7 * i + 3 + k];
    out[i] = crossing_path(&medium, &r);
    transmission_path path = out[i];
    crossing_set_vertical(&medium, &r, &path);
    out[i] = path;
}
"""


@pytest.fixture
def paths(opencl):
    """paths(mesh, medium, origin, direction, limit): a record per ray. medium: per facet or one."""
    program = cl.Program(opencl.context, BODY).build(f"-cl-std=CL1.2 -I {probe.ROOT}")

    def run(mesh, medium, origin, direction, limit=np.inf, stated_k=(0, 0, 0, 0)):
        nodes, blocks, low, high = tree.build(*mesh)
        bodies = np.zeros(1, records.MEDIUM_WORLD)
        bodies["low"], bodies["high"], bodies["altitude_m"] = low, high, 300
        bodies["level_count"], bodies["stated_k"] = len(LEVELS), stated_k
        bodies["scatters"] = (0, 1, 1, 1)
        origin, direction = np.broadcast_arrays(np.atleast_2d(np.float64(origin)), direction)
        direction = direction / np.linalg.norm(direction, axis=1, keepdims=True)
        limits = np.broadcast_to(limit, len(origin))[:, None]
        rays = np.float32(np.hstack([origin, direction, limits]))
        of_facet = np.broadcast_to(np.uint32(medium), len(mesh[0]))
        buffers = [probe.copy(opencl, a) for a in (nodes, blocks, of_facet, LEVELS, rays)]
        return probe.launch(opencl, program.probe, len(rays), [bodies[0], *buffers],
                            (len(rays),), records.TRANSMISSION_PATH)

    return run


def box_chords(origin, direction, low, high):
    """Lengths of rays inside a box, float64."""
    a = (np.array(low) - origin) / direction
    b = (np.array(high) - origin) / direction
    near, far = np.minimum(a, b).max(1), np.maximum(a, b).min(1)
    return np.maximum(far - np.maximum(near, 0), 0)


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def aimed(seed, count, distance, size):
    """Rays from all sides at points within +-size, as float32 holds them."""
    random = np.random.default_rng(seed)
    origin = np.float32(distance * unit(random.normal(size=(count, 3))))
    direction = np.float32(unit(random.uniform(-size, size, (count, 3)) - origin))
    return origin.astype(float), direction.astype(float)


@pytest.mark.parametrize("distance, bound", [(2.0, 1e-6), (14000.0, 1e-4)])
def test_a_box_transmits_the_exponential_of_its_chord(paths, distance, bound):
    size = 1.0 if distance < 100 else 60.0  # m, as large as a cloud is for the far camera
    low, high = (-size, -.5 * size, -.25 * size), (size, .5 * size, .25 * size)
    origin, direction = aimed(1, 20000, distance, 1.2 * size)

    length = paths(cases.box(low, high), 0, origin, direction)["length_m"][:, 0]

    chord = box_chords(origin, direction, low, high)
    extinction = 1 / size
    error = np.abs(np.exp(-extinction * length) - np.exp(-extinction * chord))
    assert (chord > 0).mean() > .2
    assert error.max() < bound


def test_a_sphere_is_as_thick_as_its_chord(paths):
    origin, direction = aimed(2, 20000, 5.0, 1.0)

    length = paths(cases.icosphere(5), 0, origin, direction)["length_m"][:, 0]

    beside = np.linalg.norm(np.cross(origin, direction), axis=1)
    chord = 2 * np.sqrt(np.maximum(1 - beside**2, 0))
    # Facets of 20,480 lie up to .0006 inside the sphere; at grazing chords that is .05 of them.
    assert np.abs(length - chord)[beside < .9].max() < .005


def test_rays_through_edges_and_corners_cross_once(paths):
    at = np.linspace(-1, 1, 21)
    x, y = (v.ravel() for v in np.meshgrid(at, at))
    origin = np.column_stack([x, y, np.full(len(x), 10.0)])

    length = paths(cases.box((-1, -1, -1), (1, 1, 1)), 0, origin, (0, 0, -1))["length_m"][:, 0]

    inside = (np.abs(x) < 1) & (np.abs(y) < 1)  # diagonals of the quads among them
    assert length[inside] == pytest.approx(2, rel=1e-6)
    assert np.isin(np.round(length[~inside], 5), (0, 2)).all()


def test_the_way_begins_at_an_origin_inside(paths):
    box = cases.box((-1, -1, -1), (1, 1, 1))

    assert paths(box, 0, (0, 0, .5), (0, 0, 1))["length_m"][0, 0] == pytest.approx(.5, rel=1e-6)
    assert paths(box, 0, (0, 0, .5), (0, 0, -1))["length_m"][0, 0] == pytest.approx(1.5, rel=1e-6)


@pytest.mark.parametrize("z, limit, length", [(5, 4.5, .5), (5, 3, 0), (5, 9, 2), (0, .25, .25)])
def test_the_way_ends_at_what_the_ray_meets(paths, z, limit, length):
    box = cases.box((-1, -1, -1), (1, 1, 1))

    found = paths(box, 0, (.1, .2, z), (0, 0, -1), limit)["length_m"][0, 0]

    assert found == pytest.approx(length, rel=1e-6)


def test_bodies_within_and_across_each_other_add_up(paths):
    mesh = cases.join(cases.box((-3, -3, -3), (3, 3, 3)), cases.box((-1, -1, -1), (1, 1, 1)),
                      cases.box((-1, -1, 2), (1, 1, 5)))

    found = paths(mesh, np.repeat([0, 1, 1], 6), (.1, .2, 20), (0, 0, -1))[0]

    length = dict(zip(found["medium"][:2], found["length_m"][:2]))
    assert length == pytest.approx({0: 6.0, 1: 5.0}, rel=1e-6)


def test_materials_stand_in_the_order_of_their_middles(paths):
    mesh = cases.join(*(cases.box((-1, -1, z), (1, 1, z + 1)) for z in (0, 4, 8, 12)))
    medium = np.repeat([2, 0, 3, 1], 6)

    down = paths(mesh, medium, (.1, .2, 20), (0, 0, -1))[0]
    up = paths(mesh, medium, (.1, .2, -20), (0, 0, 1))[0]

    assert list(down["medium"]) == [1, 3, 0, 2] and list(up["medium"]) == [2, 0, 3, 1]
    assert down["length_m"] == pytest.approx(1, rel=1e-6)


def test_a_body_has_the_temperature_of_the_air_at_its_middle_along_the_ray(paths):
    box = cases.box((-100, -100, 400), (100, 100, 600))

    found = paths(box, 0, (1, 2, 5000), (0, 0, -1))[0]

    # z 500 is at 800 m: half way between levels of 290 and 280 K
    assert found["temperature_k"][0] == pytest.approx(285, abs=1e-3)


def test_a_stated_temperature_goes_before_that_of_the_air(paths):
    box = cases.box((-100, -100, 400), (100, 100, 600))

    found = paths(box, 1, (1, 2, 5000), (0, 0, -1), stated_k=(0, 270, 0, 0))[0]

    assert found["temperature_k"][0] == 270


def test_the_middle_of_a_body_is_told_by_its_range(paths):
    box = cases.box((-100, -100, 400), (100, 100, 600))

    found = paths(box, 0, (1, 2, 4000), (0, 0, -1), 4000)[0]

    assert found["middle_m"][0] == pytest.approx(3500, rel=1e-6)


def test_a_body_is_as_thick_upwards_as_it_is_at_the_middle_of_the_way(paths):
    slanted = paths(cases.box((-100, -100, 400), (100, 100, 600)), 1, (-700, 0, 900), (1, 0, -.5))[0]
    inside = paths(cases.box((-100, -100, 400), (100, 100, 600)), 1, (0, 0, 550), (1, .1, .1))[0]

    assert slanted["length_m"][0] > 100
    assert slanted["vertical_m"][0] == pytest.approx(200, rel=1e-5)
    assert inside["vertical_m"][0] == pytest.approx(200, rel=1e-5)


def test_where_nothing_is_above_the_middle_the_way_s_length_counts(paths):
    mesh = cases.join(cases.box((-30, -5, -5), (-10, 5, 5)), cases.box((10, -5, -5), (30, 5, 5)))

    found = paths(mesh, 1, (-100, .1, .2), (1, 0, 0))[0]

    assert found["vertical_m"][0] == pytest.approx(40, rel=1e-5)


def test_what_does_not_scatter_has_no_thickness_upwards(paths):
    found = paths(cases.box((-1, -1, 5), (1, 1, 6)), 0, (.1, .2, 20), (0, 0, -1))[0]

    assert found["length_m"][0] > 0 and found["vertical_m"][0] == 0


@pytest.mark.parametrize("z, direction", [(20, (0, 0, 1)), (20, (1, 0, 0)), (0, (0, 1, 0))])
def test_rays_beside_all_bodies_have_nothing_on_their_way(paths, z, direction):
    box = cases.box((-1, -1, 5), (1, 1, 6))

    assert not paths(box, 0, (.1, .2, z), direction)["length_m"].any()
