"""Shares of the sun that transmissive bodies let through, against exp(-extinction x length)."""

import numpy as np
import ray_world
import records
import test_sun_history as history
import tree

import cases

UP = (0, 0, 1)


def fractions(opencl, mesh, sun, hits, lit):
    """Shape (points, slots): 0 .. 255. lit: (slots), of all points."""
    nodes, blocks, low, high = tree.build(*mesh)
    bodies = np.zeros(1, records.MEDIUM_WORLD)
    bodies["low"], bodies["high"], bodies["stated_k"] = low, high, 280
    bodies["broad_band_per_m"] = (.03, 0, 0, 0)
    day = history.a_day()
    day["stride"] = 9 * history.WORDS
    words = np.zeros((len(hits), 9 * history.WORDS), np.uint32)
    words[:, :history.WORDS] = np.packbits(lit, bitorder="little").view(np.uint32)
    world = np.zeros(1, records.WORLD)
    world["ground_facet"], world["offset_m"] = ray_world.NONE, 1e-4
    medium = {"media": bodies, "medium_nodes": nodes.view(records.BVH_NODE),
              "medium_blocks": blocks.view(records.BVH_BLOCK),
              "medium_row": np.zeros(len(mesh[0]), np.uint32), "air_level": np.zeros(2, np.float32)}
    opencl.run("sun_fraction", (len(hits), 8 * history.WORDS), count=len(hits), day=day, world=world,
               medium=medium, sun=sun, hit=hits, lit=words)
    return np.ascontiguousarray(words[:, history.WORDS:]).view(np.uint8)


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
