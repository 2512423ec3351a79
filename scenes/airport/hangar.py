"""Hangars: x forward out of the door, y left, z up; foundations reach below z = 0."""

import numpy as np
import shape
import surfaces as of
from building import BASE, arch, upright
from gdb_file import Thing


def build(name, depth=32.0, half=15.0, pieces=10, points=29, leaves=3):
    """An arched hall, open in front: ribs, skylights, sliding doors, benches and lockers inside."""
    thing, eaves, rise, head = Thing(name), 5.2, 4.2, 7.0
    sides = [
        shape.box((-depth + 0.3, y - 0.15, BASE), (-0.3, y + 0.15, eaves + 0.15))
        for y in (-half + 0.35, half - 0.35)
    ]
    thing.add("WALLS", of.BRICK_WALL, *sides)
    thing.add(
        "BACK",
        of.BRICK_WALL,
        upright(
            arch(half - 0.25, eaves - 0.05, rise, points), -depth + 0.05, -depth + 0.35, BASE - 0.1
        ),
    )
    outline = arch(half, eaves, rise, points)
    thing.add("ROOF", of.SHEET, shape.strip(outline, -0.12, -depth, 0.6, 0, pieces))
    thing.add(
        "RIBS",
        of.FRAME,
        *[
            shape.strip(arch(half - 0.25, eaves - 0.1, rise, 13), 0.35, x, x + 0.2, 0)
            for x in np.linspace(-depth + 2, -2, 8)
        ],
    )
    thing.add(
        "GABLE",
        of.SHEET,
        upright(arch(half - 0.2, eaves - 0.05, rise, points), -0.3, -0.05, head, narrow=0.86),
    )
    piers = [
        shape.box((-0.5, y - 1.1, BASE - 0.05), (0.0, y + 1.1, eaves + 0.8))
        for y in (-half + 1.25, half - 1.25)
    ]
    thing.add("PIERS", of.WALL, *piers)
    for i in range(leaves):
        out = 0.15 + 0.25 * i
        thing.add(
            f"DOOR_{i + 1}",
            of.SHEET,
            *[panelled(out, y * (half - 2.3 - 0.5 * i), 4.2, head + 0.2) for y in (-1, 1)],
        )
    thing.add(
        "RAIL", of.FRAME, shape.box((0.05, -half - 1, head + 0.15), (1.0, half + 1, head + 0.45))
    )
    add_roof_fittings(thing, depth, eaves + rise)
    add_inside(thing, depth, half)
    return thing


def panelled(x, y, width, height):
    """A sliding door leaf with its stiffening bars."""
    leaf = [shape.box((x, y - width / 2, 0.03), (x + 0.08, y + width / 2, height))]
    leaf += [
        shape.box((x + 0.07, y - width / 2 + 0.05, z), (x + 0.14, y + width / 2 - 0.05, z + 0.12))
        for z in np.linspace(0.5, height - 0.6, 4)
    ]
    return np.concatenate(leaf)


def add_roof_fittings(thing, depth, top):
    vents = [
        shape.revolve(
            [
                (top - 0.3, 0),
                (top - 0.3, 0.45),
                (top + 0.7, 0.45),
                (top + 0.75, 0.7),
                (top + 1.05, 0.5),
                (top + 1.15, 0),
            ],
            10,
            (x, 0, 0),
            axis=2,
        )
        for x in np.linspace(-depth + 4, -4, 5)
    ]
    thing.add("VENTS", of.SHEET, *vents)
    lights = [
        shape.moved(
            shape.turned(shape.box((x, -1.6, -0.12), (x + 2.2, 1.6, 0.06)), s * 11.5, 0),
            (0, -s * 5.6, top - 0.21),
        )
        for x in np.linspace(-depth + 3, -5, 5)
        for s in (-1, 1)
    ]
    thing.add("SKYLIGHTS", of.PANE, *lights)


def add_inside(thing, depth, half):
    benches = [
        shape.rounded(
            (x, s * (half - 1.5) - 0.5, BASE), (x + 2.5, s * (half - 1.5) + 0.5, 0.95), 0.04, 0
        )
        for x in np.arange(-depth + 3, -6, 5.0)
        for s in (-1, 1)
    ]
    thing.add("BENCHES", of.PLANK, *benches)
    thing.add(
        "LOCKERS",
        of.SHEET,
        *[
            shape.box((-depth + 0.45, y, BASE), (-depth + 1.1, y + 0.9, 2.0))
            for y in np.arange(-9.0, 8.5, 1.0)
        ],
    )
    lamps = [
        shape.revolve([(7.0, 0), (7.0, 0.45), (7.3, 0.2), (7.5, 0)], 10, (x, y, 0), axis=2)
        for x in np.linspace(-depth + 4, -4, 4)
        for y in (-6, 6)
    ]
    thing.add("LAMPS", of.LAMP, *lamps)
