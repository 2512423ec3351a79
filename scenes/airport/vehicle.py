"""Vehicles and other things on wheels: x forward, y left, z up from the ground."""

import numpy as np

import shape
import surfaces as of
from foxbat import NOSE_X, missile
from gdb_file import Thing


def add_wheels(thing, name, axles, half_track, radius, width, sides):
    for i, x in enumerate(axles, 1):
        thing.add(
            f"{name}_{i}",
            of.TYRE,
            *(shape.wheel(x, y, radius, width, sides) for y in (half_track, -half_track)),
        )


def car(name, sides=16):
    """A saloon: warm panels, thin glass, four wheels."""
    thing = Thing(name)
    lower = [
        (-2.1, 0.32),
        (2.05, 0.32),
        (2.15, 0.6),
        (2.0, 0.82),
        (0.9, 0.95),
        (-1.5, 0.98),
        (-2.15, 0.9),
        (-2.2, 0.55),
    ]
    rings = np.array(
        [
            np.insert(np.array(lower) * [1 - 0.05 * abs(t) ** 3, 1] + [0, 0], 1, 0.86 * t, axis=1)
            for t in np.linspace(-1, 1, 9)
        ]
    )
    thing.add("BODY", of.CAR_SIDE, shape.loft(rings))
    glass = [
        [(-1.55, y, 0.9), (1.0, y, 0.9), (0.35, y * 0.8, 1.40), (-1.05, y * 0.8, 1.40)]
        for y in (-0.80, 0.80)
    ]
    thing.add("GLASS", of.WINDSHIELD, shape.loft(glass))
    roof = shape.rounded((-1.12, -0.68, 1.385), (0.42, 0.68, 1.45), 0.02, axis=0)
    thing.add("ROOF", of.CAR_ROOF, roof)
    pillars = [
        shape.tube((a, s * 0.79, 0.9), (b, s * 0.655, 1.41), 0.04, 4)
        for a, b in ((1.0, 0.36), (-0.2, -0.2), (-1.52, -1.05))
        for s in (-1, 1)
    ]
    thing.add("PILLARS", of.CAR_ROOF, *pillars)
    thing.add(
        "BUMPERS",
        of.BUMPER,
        shape.rounded((2.08, -0.82, 0.36), (2.24, 0.82, 0.56), 0.04, axis=1),
        shape.rounded((-2.28, -0.82, 0.36), (-2.12, 0.82, 0.56), 0.04, axis=1),
    )
    lamps = [
        shape.box((a, y - 0.15, 0.62), (a + 0.06, y + 0.15, 0.74))
        for a in (2.09, -2.2)
        for y in (-0.6, 0.6)
    ]
    thing.add("LAMPS", of.LAMP, *lamps)
    add_wheels(thing, "WHEELS", (1.3, -1.3), 0.78, 0.33, 0.2, sides)
    return thing


def add_cab(thing, front):
    """A truck's bonnet and cab with its windows, ahead of x = front - 3."""
    thing.add(
        "BONNET", of.BONNET_WARM, shape.rounded((front - 1.4, -0.7, 0.95), (front, 0.7, 1.72), 0.12)
    )
    side = [
        (front - 2.9, 0.9),
        (front - 1.3, 0.9),
        (front - 1.35, 1.8),
        (front - 1.6, 2.6),
        (front - 2.8, 2.65),
    ]
    rings = np.array([np.insert(side, 1, y, axis=1) for y in np.linspace(-1.1, 1.1, 5)])
    thing.add("CAB", of.OLIVE, shape.loft(rings))
    pane = shape.turned(shape.box((-0.02, -0.95, -0.28), (0.03, 0.95, 0.28)), -17.35, 1)
    doors = [
        shape.box((front - 2.6, y - 0.02, 1.85), (front - 1.75, y + 0.02, 2.45))
        for y in (-1.1, 1.1)
    ]
    thing.add("WINDOWS", of.WINDSHIELD, shape.moved(pane, (front - 1.475, 0, 2.2)), *doors)
    fenders = [
        shape.rounded((front - 1.3, s - 0.3, 0.78), (front - 0.1, s + 0.3, 1.06), 0.1)
        for s in (-0.9, 0.9)
    ]
    thing.add("FENDERS", of.OLIVE, *fenders)
    thing.add(
        "BUMPER",
        of.BUMPER,
        shape.rounded((front - 0.05, -1.15, 0.55), (front + 0.12, 1.15, 0.8), 0.04, axis=1),
    )
    lamps = [
        shape.revolve(
            [(front - 0.14, 0), (front - 0.14, 0.12), (front + 0.04, 0.12), (front + 0.06, 0)],
            10,
            (0, y, 1.12),
        )
        for y in (-0.85, 0.85)
    ]
    thing.add("LAMPS", of.LAMP, *lamps)


def add_frame(thing, rear, front):
    rails = [
        shape.box((rear, y - 0.08, 0.62), (front - 0.3, y + 0.08, 0.86)) for y in (-0.45, 0.45)
    ]
    cross = [
        shape.box((x, -0.5, 0.66), (x + 0.12, 0.5, 0.82))
        for x in np.linspace(rear + 0.3, front - 1, 5)
    ]
    thing.add("FRAME", of.FRAME, *rails, *cross)


def truck(name, sides=16, covered=True):
    """A three-axle truck; the bed carries bows and a canvas cover, or crates."""
    thing = Thing(name)
    add_frame(thing, -3.6, 3.6)
    add_cab(thing, 3.6)
    thing.add("BED", of.PLANK, shape.box((-3.7, -1.2, 0.9), (0.5, 1.2, 1.02)))
    boards = [shape.box((-3.69, y - 0.03, 1.0), (0.49, y + 0.03, 1.6)) for y in (-1.18, 1.18)]
    boards += [shape.box((x - 0.03, -1.13, 1.0), (x + 0.03, 1.13, 1.6)) for x in (-3.66, 0.46)]
    thing.add("BOARDS", of.PLANK, *boards)
    if covered:
        turn = np.linspace(0, np.pi, 17)
        arch = [(1.24 * np.cos(t), 1.5 + 1.35 * np.sin(t) ** 0.6) for t in turn]
        thing.add("COVER", of.CANVAS, shape.strip(arch, -0.03, -3.74, 0.54, 0, pieces=8))
    else:
        crates = [
            shape.rounded((x, y, 1.0), (x + 0.9, y + 0.8, h), 0.03, 2)
            for x, y, h in (
                (-3.4, -0.9, 1.8),
                (-2.3, 0.1, 1.6),
                (-2.3, -1.0, 2.1),
                (-1.1, -0.4, 1.9),
                (-3.4, 0.2, 1.5),
            )
        ]
        thing.add("CRATES", of.PLANK, *crates)
    add_wheels(thing, "WHEELS", (2.7, -1.5, -2.7), 0.98, 0.52, 0.3, sides)
    return thing


def tanker(name, sides=20):
    """A fuel truck: a round tank with domes, a walkway and a hose reel."""
    thing = Thing(name)
    add_frame(thing, -4.2, 3.6)
    add_cab(thing, 3.6)
    profile = [
        (-4.2, 0),
        (-4.15, 0.5),
        (-4.0, 0.85),
        (-3.8, 1.0),
        (-2, 1.0),
        (-0.9, 1.0),
        (0.2, 1.0),
        (0.4, 0.85),
        (0.5, 0.5),
        (0.53, 0),
    ]
    thing.add("TANK", of.TANK, shape.revolve(profile, sides, (0, 0, 1.86)))
    domes = [
        shape.revolve(
            [(2.5, 0), (2.5, 0.3), (2.98, 0.3), (3.03, 0.2), (3.03, 0)], 12, (x, 0, 0), axis=2
        )
        for x in (-3.2, -1.8, -0.4)
    ]
    thing.add("DOMES", of.TANK, *domes)
    thing.add(
        "WALKWAY",
        of.FRAME,
        shape.box((-3.9, 0.55, 2.78), (0.2, 0.95, 2.83)),
        shape.box((-3.9, -0.95, 2.78), (0.2, -0.55, 2.83)),
    )
    thing.add(
        "LADDER",
        of.FRAME,
        *[shape.tube((-4.3, y, 0.8), (-4.3, y, 2.8), 0.02) for y in (-0.2, 0.2)],
        *[shape.tube((-4.3, -0.2, z), (-4.3, 0.2, z), 0.015) for z in (1.1, 1.5, 1.9, 2.3)],
    )
    thing.add(
        "REEL",
        of.OLIVE,
        shape.revolve([(-0.5, 0), (-0.5, 0.3), (0.5, 0.3), (0.5, 0)], 14, (-3.4, 0, 0.72), axis=1),
    )
    add_wheels(thing, "WHEELS", (2.7, -1.9, -3.1), 0.98, 0.52, 0.3, sides - 4)
    return thing


def tug(name):
    """A low aircraft tug with its tow bar."""
    thing = Thing(name)
    thing.add("BODY", of.OLIVE, shape.rounded((-1.9, -1.1, 0.3), (1.9, 1.1, 0.95), 0.12))
    thing.add("CAB", of.BONNET_WARM, shape.rounded((0.3, -0.8, 0.93), (1.7, 0.8, 1.3), 0.08))
    thing.add(
        "SEAT",
        of.CANVAS,
        shape.rounded((-0.6, -0.7, 0.94), (-0.1, 0.7, 1.3), 0.06, 1),
        shape.rounded((-0.75, -0.66, 1.2), (-0.55, 0.66, 1.7), 0.04, 1),
    )
    thing.add(
        "BUMPERS",
        of.BUMPER,
        shape.box((1.85, -1.05, 0.35), (2.0, 1.05, 0.65)),
        shape.box((-2.0, -1.05, 0.35), (-1.85, 1.05, 0.65)),
    )
    thing.add(
        "TOWBAR",
        of.BARE_FRAME,
        shape.tube((-1.9, 0, 0.45), (-5.4, 0, 0.4), 0.06, 8),
        shape.tube((-5.4, -0.4, 0.4), (-5.4, 0.4, 0.4), 0.05, 8),
    )
    add_wheels(thing, "WHEELS", (1.2, -1.2), 1.02, 0.42, 0.28, 20)
    return thing


def generator_cart(name):
    """A ground power unit, running: a warm housing with louvres and a cable drum."""
    thing = Thing(name)
    thing.add("HOUSING", of.BONNET_WARM, shape.rounded((-1.3, -0.7, 0.5), (1.1, 0.7, 1.6), 0.12))
    thing.add(
        "LOUVRES",
        of.FRAME,
        *[
            shape.turned(
                shape.box((x, s * 0.71 - 0.02, 0.8), (x + 0.06, s * 0.71 + 0.03, 1.35)),
                s * 25,
                2,
                (x, s * 0.71, 0),
            )
            for s in (-1, 1)
            for x in np.arange(-0.9, 0.8, 0.2)
        ],
    )
    thing.add("PIPE", of.EXHAUST_RUNNING, shape.tube((-0.9, 0.3, 1.5), (-0.9, 0.3, 2.0), 0.07, 12))
    thing.add(
        "DRUM",
        of.DRUM,
        shape.revolve(
            [
                (-0.4, 0),
                (-0.4, 0.42),
                (-0.34, 0.42),
                (-0.3, 0.25),
                (0.3, 0.25),
                (0.34, 0.42),
                (0.4, 0.42),
                (0.4, 0),
            ],
            18,
            (1.45, 0, 0.75),
            axis=1,
        ),
    )
    thing.add("BAR", of.FRAME, shape.tube((-1.2, 0, 0.45), (-2.4, 0, 0.3), 0.05))
    add_wheels(thing, "WHEELS", (0.7, -0.8), 0.72, 0.34, 0.2, 16)
    return thing


def weapon_trailer(name):
    """A flat trailer with four missiles on cradles."""
    thing = Thing(name)
    thing.add("BED", of.FRAME, shape.box((-3.2, -1.0, 0.62), (2.9, 1.0, 0.74)))
    thing.add(
        "CRADLES",
        of.PLANK,
        *[
            shape.rounded((x, -0.96, 0.73), (x + 0.2, 0.96, 0.92), 0.02, 1)
            for x in (-2.3, -0.8, 0.7)
        ],
    )
    for i, y in enumerate((-0.72, -0.24, 0.24, 0.72), 1):
        thing.add(f"MISSILE_{i}", of.MISSILE, missile(y, 1.05, NOSE_X - 2.95, 12)[0])
    thing.add("BAR", of.FRAME, shape.tube((2.8, 0, 0.66), (4.3, 0, 0.4), 0.05, 8))
    add_wheels(thing, "WHEELS", (1.8, -2.0), 0.82, 0.38, 0.22, 16)
    return thing


def radar_van(name):
    """A truck with a cabin and a dish on a mast."""
    thing = truck(name, 12)
    del thing.parts["COVER"]
    thing.add("CABIN", of.OLIVE, shape.rounded((-3.58, -1.11, 1.01), (0.38, 1.11, 2.9), 0.15))
    thing.add("MAST", of.FRAME, shape.tube((-1.6, 0, 2.8), (-1.6, 0, 4.6), 0.12, 10))
    r = np.linspace(0, 1.7, 7)
    front, back = np.stack([0.18 * r**2, r], 1), np.stack([0.18 * r**2 - 0.06, r], 1)
    dish = shape.revolve(np.concatenate([front, back[::-1]]), 28, (0, 0, 0))
    thing.add("DISH", of.SKIN, shape.moved(shape.turned(dish, -25, 1), (-1.5, 0, 5.2)))
    thing.add("FEED", of.BARE_FRAME, shape.tube((-1.6, 0, 4.6), (-0.1, 0, 5.85), 0.04, 6))
    return thing


def drums(name):
    """A dozen fuel drums on end."""
    thing = Thing(name)
    profile = [
        (-0.02, 0),
        (-0.02, 0.29),
        (0.3, 0.29),
        (0.32, 0.31),
        (0.34, 0.29),
        (0.6, 0.29),
        (0.62, 0.31),
        (0.64, 0.29),
        (0.9, 0.29),
        (0.9, 0),
    ]
    for row in range(3):
        thing.add(
            f"ROW_{row + 1}",
            of.DRUM,
            *[
                shape.revolve(profile, 10, (0.7 * column, 0.7 * row, 0), axis=2)
                for column in range(4)
            ],
        )
    return thing
