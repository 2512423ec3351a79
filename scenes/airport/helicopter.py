"""The helicopter: x forward, y left, z up from the ground, a transport of the Mi-8's size."""

import numpy as np

import shape
import surfaces as of
from gdb_file import Thing

# forward place, half width, bottom, top, power of the superellipse
CABIN = [
    (9.2, 0.15, 1.5, 1.9, 2),
    (8.8, 0.75, 1.0, 2.5, 2.2),
    (8.0, 1.1, 0.8, 2.85, 2.6),
    (6.8, 1.25, 0.75, 3.1, 3),
    (3.0, 1.25, 0.75, 3.15, 3.4),
    (0.0, 1.25, 0.8, 3.15, 3.2),
    (-2.0, 1.0, 1.2, 3.1, 2.8),
    (-3.6, 0.6, 1.9, 3.0, 2.2),
]
BOOM = [(-3.4, 0.6, 1.9, 3.0, 2.2), (-6.0, 0.42, 2.25, 3.0, 2), (-9.2, 0.25, 2.6, 3.05, 2)]
ENGINES = [
    (5.6, 0.2, 3.2, 3.5, 2),
    (5.0, 0.75, 3.0, 3.95, 2.6),
    (3.0, 0.85, 3.0, 4.1, 3),
    (0.5, 0.8, 3.0, 4.0, 3),
    (-2.2, 0.25, 3.0, 3.3, 2),
]
HUB_Z = 4.75
BLADES = 5


def body(stations, points, pieces):
    rings = []
    for row in shape.smooth(-np.array(stations) * [1, -1, -1, -1, -1], pieces):
        ring = shape.superellipse(points, *row[1:])
        ring[:, 0] = -row[0]
        rings.append(ring)
    return shape.loft(rings)


def blade(length, chord, twist_deg):
    droop = (
        [(0.6, -0.5 * chord, 0), (0.6, 0.5 * chord, 0)],
        [(length, -0.5 * chord, -0.5), (length, 0.5 * chord, -0.5)],
    )
    return shape.turned(shape.panel(*droop, 0.06, 6, 8), twist_deg, 0)


def add_rotors(thing):
    mast = shape.revolve(
        [(3.9, 0), (3.9, 0.3), (4.5, 0.2), (4.6, 0.45), (4.85, 0.45), (4.95, 0.2), (5.05, 0)],
        16,
        (1.6, 0, 0),
        axis=2,
    )
    thing.add("MAST", of.STRUT, mast)
    for i in range(BLADES):
        turn = 20 + i * 360 / BLADES
        one = shape.moved(shape.turned(blade(10.2, 0.52, 4), turn, 2), (1.6, 0, HUB_Z))
        thing.add(f"BLADE_{i + 1}", of.BLADE, one)
        grip = shape.tube((0, 0, 0), (0.9, 0, -0.02), 0.11, 8)
        thing.add(
            f"GRIP_{i + 1}", of.STRUT, shape.moved(shape.turned(grip, turn, 2), (1.6, 0, HUB_Z))
        )
    thing.add("TAIL_HUB", of.STRUT, shape.tube((-10.2, -0.1, 4.4), (-10.2, 0.62, 4.4), 0.12, 10))
    for i in range(3):
        small = shape.turned(
            shape.turned(
                shape.panel(
                    [(0.1, -0.13, 0), (0.1, 0.13, 0)],
                    [(1.85, -0.13, 0), (1.85, 0.13, 0)],
                    0.06,
                    5,
                    3,
                ),
                90,
                0,
            ),
            120 * i + 15,
            1,
        )
        thing.add(f"TAIL_BLADE_{i + 1}", of.BLADE, shape.moved(small, (-10.2, 0.55, 4.4)))


def add_glass(thing):
    for side, s in (("LEFT", 1), ("RIGHT", -1)):
        for i, x in enumerate((5.4, 4.2, 3.0, 1.8, 0.6), 1):
            pane = shape.revolve(
                [(-0.03, 0), (-0.03, 0.27), (0.03, 0.27), (0.03, 0)],
                12,
                (x, s * 1.255, 2.15),
                axis=1,
            )
            thing.add(f"PORTHOLE_{side}_{i}", of.PANE, pane)
    nose = body(
        [
            (9.0, 0.42, 2.02, 2.42, 2.4),
            (8.5, 0.88, 1.85, 2.72, 2.4),
            (8.0, 1.0, 1.95, 2.9, 2.6),
            (7.3, 0.9, 2.2, 3.08, 2.6),
        ],
        18,
        2,
    )
    thing.add("WINDSCREEN", of.CANOPY, nose)


def add_sides(thing):
    """What the helicopter has on its left and on its right."""
    for side, s in (("LEFT", 1), ("RIGHT", -1)):
        thing.add(
            f"INLET_{side}",
            of.DUCT,
            shape.tube((5.0, s * 0.42, 3.55), (5.75, s * 0.42, 3.55), 0.3, 16),
        )
        thing.add(
            f"PIPE_{side}",
            of.EXHAUST,
            shape.tube((1.9, s * 0.5, 3.6), (1.7, s * 1.15, 3.6), 0.24, 16),
        )
        thing.add(
            f"TANK_{side}",
            of.OLIVE,
            shape.revolve(
                [(0.4, 0), (0.6, 0.3), (1.2, 0.42), (3.6, 0.42), (4.2, 0.3), (4.4, 0)],
                16,
                (0, s * 1.5, 1.2),
            ),
        )
        thing.add(
            f"STABILISER_{side}",
            of.OLIVE,
            shape.panel(
                [(-7.2, s * 0.2, 2.8), (-8.2, s * 0.2, 2.8)],
                [(-7.5, s * 1.9, 2.8), (-8.2, s * 1.9, 2.8)],
                0.06,
                6,
            ),
        )
        thing.add(
            f"LEG_{side}",
            of.STRUT,
            shape.tube((0.2, s * 2.0, 0.44), (0.2, s * 1.2, 1.0), 0.08),
            shape.tube((0.2, s * 2.0, 0.44), (0.3, s * 1.2, 2.4), 0.06),
        )
        thing.add(f"WHEEL_{side}", of.TYRE, shape.wheel(0.2, s * 2.15, 0.43, 0.26, 18))


def build(name):
    thing = Thing(name)
    thing.add("CABIN", of.OLIVE, body(CABIN, 24, 2))
    thing.add("BOOM", of.OLIVE, body(BOOM, 18, 3))
    thing.add("ENGINES", of.OLIVE, body(ENGINES, 18, 2))
    add_sides(thing)
    thing.add(
        "PYLON",
        of.OLIVE,
        shape.panel([(-8.3, 0, 2.9), (-9.6, 0, 2.7)], [(-9.9, 0, 4.9), (-10.7, 0, 4.9)], 0.1, 7, 3),
    )
    thing.add(
        "NOSE_LEG",
        of.STRUT,
        shape.tube((6.8, 0, 0.3), (6.9, 0, 1.0), 0.08, 8),
        shape.tube((6.8, -0.25, 0.3), (6.8, 0.25, 0.3), 0.05),
    )
    thing.add(
        "NOSE_WHEELS",
        of.TYRE,
        shape.wheel(6.8, 0.22, 0.3, 0.16, 16),
        shape.wheel(6.8, -0.22, 0.3, 0.16, 16),
    )
    add_glass(thing)
    add_rotors(thing)
    return thing
