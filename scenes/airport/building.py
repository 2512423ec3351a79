"""Structures: x forward out of the door, y left, z up; foundations reach below z = 0."""

import numpy as np

import shape
import surfaces as of
from gdb_file import Thing

BASE = -0.35  # parts of a house end at different depths, so that no two facets lie in one plane


def arch(half_width, spring, rise, points):
    """Roof outline from right to left, a flat curve of the given rise over its springing."""
    turn = np.linspace(0, np.pi, points)
    return np.stack([half_width * np.cos(turn), spring + rise * np.sin(turn)], 1)


def upright(outline, low, high, floor, narrow=1.0):
    """A wall from a floor up to an outline, drawn out in x."""
    outline = outline[np.abs(outline[:, 0]) <= narrow * outline[:, 0].max()]
    rings = [
        [
            (low, y, floor),
            (high, y, floor),
            (high, y, max(z, floor + 0.05)),
            (low, y, max(z, floor + 0.05)),
        ]
        for y, z in outline
    ]
    return shape.loft(rings)


def mound_rings(half, height, length, front, pieces, points):
    """A long bank of earth that falls off at its back end."""
    turn = np.linspace(0, np.pi, points)
    rings = []
    for x in np.linspace(front, front - length, pieces):
        back = np.clip((x - (front - length)) / (0.45 * length), 0, 1)
        swell = 0.12 + 0.88 * np.sin(back * np.pi / 2) ** 0.8
        y, z = half * (0.45 + 0.55 * swell) * np.cos(turn), height * swell * np.sin(turn) ** 1.15
        rings.append(np.stack([np.full(points, x), y, BASE + z], 1))
    return np.array(rings)


def bunker(name, scale=1.0, pieces=12, points=21):
    """A shelter: a concrete arch with steel doors under a bank of earth."""
    thing = Thing(name)
    thing.add(
        "MOUND",
        of.EARTH,
        shape.loft(mound_rings(14 * scale, 8.6 * scale, 30 * scale, -2.5, pieces, points)),
    )
    curve = arch(8.2 * scale, BASE - 0.15, 8.0 * scale, points)
    thing.add("PORTAL", of.WALL, shape.strip(curve, -1.1 * scale, -5, 0, 0))
    thing.add(
        "FRONT",
        of.WALL,
        upright(arch(8.4 * scale, BASE, 8.2 * scale, 21)[1:-1], -2.9, -2.4, BASE - 0.05),
    )
    for y0, y1 in ((-5.6 * scale, -0.03), (0.03, 5.6 * scale)):
        bars = [
            shape.box((-1.95, y0 + 0.1, z), (-1.75, y1 - 0.1, z + 0.3))
            for z in np.linspace(0.5, 4.4 * scale, 4)
        ]
        leaf = shape.box((-2.45, y0, BASE - 0.1), (-1.9, y1, 5.2 * scale))
        thing.add("DOORS", of.FRAME, leaf, *bars)
    wings = [
        shape.prism(
            [(0, BASE - 0.2), (0, 4.0 * scale), (6, 0.8), (6, BASE - 0.2)], y - 0.2, y + 0.2, 1
        )
        for y in (-10.2 * scale, 10.2 * scale)
    ]
    thing.add("WING_WALLS", of.WALL, *[shape.moved(wing, (-2.6, 0, 0)) for wing in wings])
    rows = [(7.0, 0), (7.0, 0.25), (9.6, 0.25), (9.65, 0.45), (9.9, 0)]
    pipe = [(z * scale, radius) for z, radius in rows]
    pipes = [shape.revolve(pipe, 12, (x * scale, 0, 0), axis=2) for x in (-7, -12)]
    thing.add("PIPES", of.FRAME, *pipes)
    return thing


def octagon(radius, z):
    turn = (np.arange(8) + 0.5) * np.pi / 4
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), np.full(8, z)], 1)


def tower(name):
    """The control tower: shaft, gallery, leaning glass, roof with aerials."""
    thing = Thing(name)
    thing.add(
        "SHAFT",
        of.WALL,
        shape.loft([octagon(r, z) for r, z in ((3.6, BASE), (3.2, 3), (3.0, 9), (3.0, 16.1))]),
    )
    thing.add(
        "COLLAR",
        of.WALL,
        shape.loft([octagon(r, z) for r, z in ((3.05, 15), (4.6, 16.5), (4.9, 16.55), (4.9, 17))]),
    )
    thing.add("GLASS", of.WARM_PANE, shape.loft([octagon(3.5, 16.9), octagon(4.1, 19.6)]))
    thing.add(
        "MULLIONS",
        of.FRAME,
        *[shape.tube(a, b, 0.07, 4) for a, b in zip(octagon(3.52, 16.95), octagon(4.12, 19.65))],
    )
    thing.add(
        "ROOF",
        of.ROOF,
        shape.loft(
            [octagon(r, z) for r, z in ((4.3, 19.5), (4.7, 19.7), (4.7, 20.0), (1.2, 20.6))]
        ),
    )
    add_tower_fittings(thing)
    return thing


def add_tower_fittings(thing):
    rail = octagon(4.8, 18.0)
    thing.add(
        "RAIL",
        of.FRAME,
        *[
            shape.tube(a + 0.01 * (b - a), b + 0.01 * (a - b), 0.03, 4)
            for a, b in zip(rail, np.roll(rail, -1, 0))
        ],
        *[shape.tube(a - (0, 0, 1.05), a + (0, 0, 0.02), 0.03, 4) for a in rail],
    )
    thing.add(
        "AERIALS",
        of.BARE_FRAME,
        *[
            shape.tube((x, y, 20.1), (x, y, h), 0.04, 5)
            for x, y, h in ((0.5, 0.3, 25), (-1.5, 1, 23), (1, -1.6, 22.5))
        ],
    )
    thing.add(
        "WINDOWS",
        of.PANE,
        *[
            shape.turned(shape.box((2.7, -0.5, z), (2.96, 0.5, z + 1.2)), t, 2)
            for z in (4, 8, 12)
            for t in (0, 90, 180)
        ],
    )
    thing.add("DOOR", of.FRAME, shape.box((2.9, -0.6, BASE - 0.05), (3.5, 0.6, 2.1)))


def windows(x, ys, zs, size, facing):
    """Panes in a wall whose face is at x; facing is +1 or -1."""
    return [
        shape.box(
            (min(x - 0.05, x + facing * 0.04), y - size[0] / 2, z),
            (max(x + 0.05, x + facing * 0.04), y + size[0] / 2, z + size[1]),
        )
        for y in ys
        for z in zs
    ]


def operations(name):
    """A flat-roofed house of two storeys, rooms lit, with machines on its roof."""
    thing = Thing(name)
    thing.add("WALLS", of.BRICK_WALL, shape.box((-6, -14, BASE), (6, 14, 7.2)))
    thing.add("ROOF", of.ROOF, shape.box((-5.7, -13.7, 7.1), (5.7, 13.7, 7.3)))
    thing.add(
        "PARAPET",
        of.WALL,
        *[
            shape.box(a, b)
            for a, b in (
                ((-6.15, -14.15, 7.05), (-5.75, 14.15, 7.8)),
                ((5.75, -14.15, 7.05), (6.15, 14.15, 7.8)),
                ((-5.8, -14.1, 7.06), (5.8, -13.75, 7.79)),
                ((-5.8, 13.75, 7.06), (5.8, 14.1, 7.79)),
            )
        ],
    )
    thing.add(
        "FRONT_WINDOWS",
        of.WARM_PANE,
        *windows(6, np.arange(-12, 13, 3.0), (1.0, 4.4), (1.6, 1.5), 1),
    )
    thing.add(
        "BACK_WINDOWS",
        of.WARM_PANE,
        *windows(-6, np.arange(-12, 13, 3.0), (1.0, 4.4), (1.6, 1.5), -1),
    )
    thing.add(
        "DOOR",
        of.PLANK,
        *[shape.box((5.9, y, BASE - 0.05), (6.06, y + 1.2, 2.2)) for y in (-11.1, 0.9)],
    )
    thing.add(
        "CANOPY",
        of.WALL,
        shape.box((5.8, -1.5, 3.2), (8.5, 4.5, 3.45)),
        shape.tube((8.2, -1.2, BASE), (8.2, -1.2, 3.3), 0.1, 8),
        shape.tube((8.2, 4.2, BASE), (8.2, 4.2, 3.3), 0.1, 8),
    )
    add_machines(thing, ((-3, -9), (-3, -5), (1.5, 6)))
    return thing


def add_machines(thing, places):
    """Running air conditioners on the roof."""
    thing.add(
        "MACHINES",
        of.BONNET_WARM,
        *[shape.rounded((x, y, 7.25), (x + 2, y + 1.6, 8.5), 0.1, 0) for x, y in places],
    )
    thing.add(
        "FANS",
        of.FRAME,
        *[
            shape.revolve(
                [(8.4, 0), (8.4, 0.6), (8.75, 0.6), (8.75, 0)], 14, (x + 1, y + 0.8, 0), axis=2
            )
            for x, y in places
        ],
    )


def shed(name, depth=9.0, half=3.2, height=2.8):
    """A wooden shed with a shingle roof."""
    thing = Thing(name)
    ridge = height + half * 0.62
    thing.add(
        "WALLS",
        of.PLANK,
        shape.prism(
            [(-half, BASE), (half, BASE), (half, height), (0, ridge), (-half, height)], -depth, 0, 0
        ),
    )
    slopes = [(half + 0.4, height - 0.22), (0, ridge + 0.03), (-half - 0.4, height - 0.22)]
    thing.add("ROOF", of.SHINGLES, shape.strip(slopes, -0.1, -depth - 0.4, 0.4, 0, 6))
    thing.add("DOOR", of.PLANK, shape.box((-0.1, -1.2, BASE - 0.05), (0.06, 1.2, 2.3)))
    thing.add(
        "WINDOWS",
        of.PANE,
        *[
            shape.box((x, s * half - 0.05, 1.1), (x + 1.2, s * half + 0.05, 2.0))
            for x in (-6.5, -4, -2)
            for s in (-1, 1)
        ],
    )
    return thing


def fuel_tank(name, radius=5.0, height=6.5, sides=32):
    """A standing tank with a dished roof, stair and pipe inside a low wall."""
    thing = Thing(name)
    profile = [
        (BASE, 0),
        (BASE, radius),
        (height * 0.33, radius),
        (height * 0.66, radius),
        (height, radius),
        (height + 0.5, radius * 0.6),
        (height + 0.65, 0),
    ]
    thing.add("SHELL", of.TANK, shape.revolve(profile, sides, (0, 0, 0), axis=2))
    turn = np.radians(np.arange(0, 181, 9.0))
    steps = [
        shape.moved(
            shape.turned(shape.box((0, -0.25, 0), (0.9, 0.25, 0.06)), np.degrees(t), 2),
            (
                (radius - 0.05) * np.cos(t),
                (radius - 0.05) * np.sin(t),
                0.2 + t / np.pi * (height - 0.3),
            ),
        )
        for t in turn
    ]
    thing.add("STAIR", of.FRAME, *steps)
    thing.add(
        "PIPE",
        of.FRAME,
        shape.tube((radius - 0.1, -1, 0.6), (radius + 3.2, -1, 0.6), 0.15, 10),
        shape.tube((radius + 3.1, -1, BASE), (radius + 3.1, -1, 0.8), 0.15, 9),
    )
    r = radius + 2.5
    for i, (a, b) in enumerate(
        (
            ((-r, -r), (r, -r + 0.3)),
            ((-r, r - 0.3), (r, r)),
            ((-r, -r + 0.31), (-r + 0.3, r - 0.31)),
            ((r - 0.3, -r + 0.31), (r, r - 0.31)),
        ),
        1,
    ):
        thing.add(f"BUND_{i}", of.WALL, shape.box((*a, BASE), (*b, 1.1)))
    return thing


def floodlights(name, places):
    """Masts with four lamps each; the places are in the frame of the object."""
    thing = Thing(name)
    for i, (x, y) in enumerate(places, 1):
        thing.add(
            f"MAST_{i}",
            of.FRAME,
            shape.revolve(
                [(BASE, 0), (BASE, 0.22), (9, 0.14), (16, 0.09), (16, 0)], 10, (x, y, 0), axis=2
            ),
            shape.box((x - 0.06, y - 1.4, 15.6), (x + 0.06, y + 1.4, 15.8)),
        )
        lamps = [
            shape.turned(
                shape.box((x + 0.05, y + k - 0.25, 15.8), (x + 0.35, y + k + 0.25, 16.2)),
                35,
                1,
                (x, y, 15.8),
            )
            for k in (-1.05, -0.35, 0.35, 1.05)
        ]
        thing.add(f"LAMPS_{i}", of.LAMP, *lamps)
    return thing


def windsock(name):
    thing = Thing(name)
    thing.add("MAST", of.FRAME, shape.tube((0, 0, BASE), (0, 0, 7), 0.07, 8))
    profile = [(0, 0.02), (0, 0.45), (1.2, 0.38), (2.4, 0.3), (3.4, 0.22), (3.4, 0.02), (0, 0.02)]
    thing.add(
        "SOCK",
        of.CANVAS,
        shape.moved(shape.turned(shape.revolve(profile, 14, (0, 0, 0)), 18, 1), (0.1, 0, 6.6)),
    )
    return thing


def crates(name):
    """Stacked boxes under the hangar's wall."""
    thing = Thing(name)
    sizes = [
        (0, 0, 1.2, 1.0, 0.9),
        (1.5, 0.1, 1.0, 1.0, 1.1),
        (2.8, 0, 1.6, 1.1, 0.8),
        (0.1, 1.4, 1.1, 1.1, 1.2),
        (1.6, 1.5, 1.4, 1.0, 0.7),
        (3.4, 1.4, 1.0, 1.0, 1.4),
    ]
    for i, (x, y, dx, dy, dz) in enumerate(sizes, 1):
        thing.add(
            f"BOX_{i}",
            of.PLANK,
            shape.rounded((x, y, -0.05), (x + dx, y + dy, dz), 0.03, 2),
            shape.rounded(
                (x + 0.1, y + 0.1, dz - 0.02), (x + dx * 0.7, y + dy * 0.8, dz + 0.5), 0.03, 2
            ),
        )
    return thing
