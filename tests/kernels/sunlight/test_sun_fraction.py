"""Shares of the sun that transmissive bodies let through, against exp(-extinction x length)."""
import pathlib

import numpy as np
import probe
import ray_world
import test_sun_history as history
import tree

import cases
import test_crossing

UP = (0, 0, 1)


def fractions(opencl, mesh, sun, hits, lit):
    """Shape (points, slots): 0 .. 255. lit: (slots), of all points."""
    nodes, blocks, low, high = tree.build(*mesh)
    bodies = np.zeros(1, test_crossing.BODIES)
    bodies["low"], bodies["high"], bodies["stated_k"] = low, high, 280
    bodies["broad_band_per_m"] = (.03, 0, 0, 0)
    day = history.a_day()
    day["stride"] = 9 * history.WORDS
    words = np.zeros((len(hits), 9 * history.WORDS), np.uint32)
    words[:, :history.WORDS] = np.packbits(lit, bitorder="little").view(np.uint32)
    world = np.zeros(1, ray_world.WORLD)
    world["ground_facet"], world["offset_m"] = ray_world.NONE, 1e-4
    arrays = (nodes, blocks, np.zeros(len(mesh[0]), np.uint32), np.zeros(2, np.float32), sun, hits)
    kernel = opencl.build("sun_fraction")
    memory = probe.copy(opencl, words)
    kernel(opencl.queue, (len(hits), 8 * history.WORDS), None, np.uint32(len(hits)), day[0],
           world[0], bodies[0], *(probe.copy(opencl, a) for a in arrays), memory)
    out = np.empty_like(words)
    probe.cl.enqueue_copy(opencl.queue, out, memory)
    return np.ascontiguousarray(out[:, history.WORDS:]).view(np.uint8)


def test_every_lit_step_has_the_transmission_of_its_slant_through_a_slab(opencl):
    slab = cases.box((-1e4, -1e4, 20), (1e4, 1e4, 50))
    elevation = np.linspace(10, 80, history.SLOTS)
    lit = np.arange(history.SLOTS) % 3 > 0

    got = fractions(opencl, slab, history.suns(elevation), ray_world.points((0, 0, 0), UP), lit)[0]

    expected = 255 * np.exp(-.03 * 30 / np.sin(np.radians(elevation)))
    assert np.abs(got - np.where(lit, expected, 0)).max() < .51  # rounded to a byte


def test_only_the_shadow_of_a_body_is_dimmed(opencl):
    box = cases.box((-10, -10, 20), (10, 10, 30))
    sun = history.suns(np.full(history.SLOTS, 89.9))
    hits = ray_world.points([(0, 0, 0), (30, 0, 0)], UP)

    got = fractions(opencl, box, sun, hits, np.ones(history.SLOTS, bool))

    assert (got[0] == round(255 * np.exp(-.3))).all() and (got[1] == 255).all()
