"""The twin-tail fighter: x forward, y left, z up from the ground; 22 m long, 14 m across the wings.

Measures are those of a MiG-25, rounded. A station is a distance behind the nose.
"""

import numpy as np

import shape
import surfaces as of
from gdb_file import Thing

NOSE_X = 11.0

# station, half width, bottom, top, power of the superellipse
FORWARD_BODY = [
    (0.0, 0.04, 2.18, 2.26, 2),
    (0.5, 0.15, 2.06, 2.38, 2),
    (1.4, 0.34, 1.87, 2.58, 2),
    (2.7, 0.56, 1.66, 2.82, 2),
    (4.5, 0.72, 1.50, 3.00, 2.2),
    (6.5, 0.84, 1.40, 3.15, 2.4),
    (9.0, 0.92, 1.34, 3.22, 2.6),
    (12.0, 0.95, 1.32, 3.16, 2.8),
    (15.0, 0.90, 1.40, 3.00, 2.8),
    (18.0, 0.62, 1.70, 2.80, 2.5),
    (20.4, 0.25, 2.0, 2.6, 2),
]
RADOME_PIECES = 3
# station, half width, bottom, top, power, offset to the side
TRUNK = [
    (7.2, 0.62, 1.20, 2.98, 12, 1.50),
    (8.6, 0.64, 1.16, 3.00, 9, 1.50),
    (10.5, 0.68, 1.12, 3.00, 7, 1.46),
    (13.0, 0.76, 1.14, 2.96, 5, 1.36),
    (15.5, 0.86, 1.22, 2.92, 4, 1.18),
    (17.5, 0.88, 1.32, 2.92, 3, 1.02),
    (19.4, 0.80, 1.34, 2.92, 2.1, 0.94),
]
# points of a section, sections a station, sides of a wheel
DETAIL = ((12, 1, 8), (16, 2, 8), (26, 3, 14))
LIP_SLANT = 0.75  # the upper lip of an intake runs ahead of the lower one
CANOPY = [
    (3.7, 0.10, 2.80, 2.96, 2),
    (4.3, 0.34, 2.70, 3.32, 2),
    (5.1, 0.46, 2.70, 3.62, 2.2),
    (5.9, 0.46, 2.75, 3.66, 2.2),
    (6.6, 0.40, 2.80, 3.58, 2),
]
SPINE = [
    (6.45, 0.40, 2.8, 3.57, 2),
    (8.0, 0.42, 2.8, 3.55, 2.2),
    (11.0, 0.38, 2.8, 3.45, 2.4),
    (14.5, 0.30, 2.7, 3.22, 2.4),
    (17.0, 0.16, 2.5, 2.92, 2),
]


def body(stations, points, pieces):
    rings = []
    for row in shape.smooth(stations, pieces):
        ring = shape.superellipse(points, *row[1:])
        ring[:, 0] = NOSE_X - row[0]
        rings.append(ring)
    return np.array(rings)


def add_body(thing, points, pieces):
    rings = body(FORWARD_BODY, points, pieces)
    hull, nose, ends = shape.loft(rings), RADOME_PIECES * pieces * points, points - 2
    thing.add(
        "RADOME",
        of.RADOME,
        np.concatenate([hull[:nose], hull[-ends : -ends // 2]]),
        shape.tube((NOSE_X - 0.2, 0, 2.22), (NOSE_X + 0.9, 0, 2.22), 0.03),
    )
    thing.add("FUSELAGE", of.SKIN, np.concatenate([hull[nose:-ends], hull[-ends // 2 :]]))
    thing.add("CANOPY", of.CANOPY, shape.loft(body(CANOPY, points, pieces)))
    thing.add("SPINE", of.SKIN, shape.loft(body(SPINE, points // 2, pieces)))
    for i, station in enumerate((4.25, 5.15, 6.40)):
        frame = [
            shape.superellipse(points, w + 0.03, 2.7, top + 0.025, 2.1)
            for w, top in [CANOPY_FRAME[i]] * 2
        ]
        frame[0][:, 0], frame[1][:, 0] = NOSE_X - station, NOSE_X - station - 0.12
        thing.add("CANOPY_FRAME", of.SKIN, shape.loft(frame))


CANOPY_FRAME = [(0.33, 3.31), (0.46, 3.63), (0.42, 3.60)]


def intake(points, pieces):
    """The rings of the left trunk, open in front: outside from the slanted lip back, duct."""
    outside = body(TRUNK, points, pieces)
    lean = LIP_SLANT * (outside[:, :, 2] - 2.0)
    fade = np.clip((NOSE_X - 7.2 - outside[:, :, 0]) / 2.5, 0, 1)
    outside[:, :, 0] += lean * (1 - fade)
    inside = outside[0] + 0.0
    middle = inside.mean(0)
    inside[:, 1:] = middle[1:] + (inside[:, 1:] - middle[1:]) * [0.90, 0.94]
    depth = np.linspace(0, 2.6, 4)[:, None, None] * [-1, 0, 0]
    duct = inside + depth
    duct[-1, :, 0] = duct[-1, :, 0].min()
    outer = np.concatenate([duct[:1], outside])
    return outer, duct


def add_trunks(thing, points, pieces, running):
    outer, duct = intake(points, pieces)
    hull = np.concatenate([shape.skin(outer), shape.cap(outer[-1])])
    hole = np.concatenate([shape.skin(duct[::-1]), shape.cap(duct[-1][::-1])])
    if shape.volume(np.concatenate([hull, hole])) < 0:
        hull, hole = hull[:, ::-1], hole[:, ::-1]
    ramp = shape.turned(shape.box((-0.05, -0.52, -0.03), (1.9, 0.52, 0.03)), -10, 1)
    ramp = shape.moved(ramp, (NOSE_X - 9.1, 1.5, 2.42))
    for side, turn in (("LEFT", lambda b: b), ("RIGHT", shape.mirrored)):
        thing.add(f"TRUNK_{side}", of.SKIN, turn(hull))
        thing.add(f"INTAKE_{side}", of.DUCT_RUNNING if running else of.DUCT, turn(hole), turn(ramp))


def add_engines(thing, sides, running):
    metal, hot = (
        (of.TAIL_METAL_RUNNING, of.EXHAUST_RUNNING) if running else (of.TAIL_METAL, of.EXHAUST)
    )
    for side, y in (("LEFT", 0.94), ("RIGHT", -0.94)):
        outside = np.array(
            [(-8.0, 0.78), (-8.6, 0.80), (-9.4, 0.77), (-10.1, 0.73), (-10.6, 0.69), (-10.6, 0.60)]
        )
        inside = np.array([(-10.6, 0.60), (-9.8, 0.56), (-9.0, 0.50), (-9.0, 0.0)])
        whole = np.concatenate([[(-8.0, 0)], outside, inside[1:]])
        skin = shape.revolve(whole, sides, (0, y, 2.1))
        parts = skin.reshape(len(whole) - 1, sides, 4, 3)
        thing.add(f"NOZZLE_{side}", metal, parts[: len(outside)].reshape(-1, 4, 3))
        thing.add(f"EXHAUST_{side}", hot, parts[len(outside) :].reshape(-1, 4, 3))


def at(station, y, z):
    return (NOSE_X - station, y, z)


def wing_fittings():
    """Fence and tip pod of the left wing."""
    fence = shape.box(at(14.0, 3.9, 2.5), at(11.6, 3.97, 2.95))
    stations = [(15.9, 0), (15.7, 0.1), (14, 0.13), (13.2, 0.09), (12.8, 0)]
    pod = shape.revolve([(NOSE_X - station, r) for station, r in stations], 8, (0, 7.0, 2.30))
    return fence, pod


def add_wings(thing, chord_points, pieces):
    wing = shape.panel(
        (at(9.0, 1.4, 2.80), at(15.1, 1.4, 2.80)),
        (at(13.8, 7.0, 2.30), at(16.1, 7.0, 2.30)),
        0.04,
        chord_points,
        pieces,
    )
    flap = shape.panel(
        (at(14.2, 2.3, 2.66), at(15.65, 2.3, 2.60)),
        (at(14.9, 5.0, 2.44), at(16.05, 5.0, 2.40)),
        0.06,
        5,
    )
    fin = shape.panel(
        (at(14.8, 1.25, 2.7), at(20.3, 1.25, 2.7)),
        (at(19.2, 1.72, 6.1), at(21.2, 1.72, 6.1)),
        0.04,
        chord_points,
        pieces,
    )
    tail = shape.panel(
        (at(17.6, 1.6, 2.0), at(21.0, 1.6, 2.0)),
        (at(20.7, 4.4, 1.9), at(22.0, 4.4, 1.9)),
        0.04,
        chord_points,
        pieces,
    )
    keel = shape.panel(
        (at(15.6, 1.3, 1.4), at(18.6, 1.3, 1.4)),
        (at(17.0, 1.7, 0.75), at(18.6, 1.7, 0.75)),
        0.04,
        5,
    )
    for side, turn in (("LEFT", lambda b: b), ("RIGHT", shape.mirrored)):
        thing.add(f"WING_{side}", of.SKIN, turn(wing), *[turn(b) for b in wing_fittings()])
        thing.add(f"FLAP_{side}", of.SKIN, turn(flap))
        thing.add(f"FIN_{side}", of.SKIN, turn(fin))
        thing.add(f"TAILPLANE_{side}", of.SKIN, turn(tail))
        thing.add(f"KEEL_{side}", of.SKIN, turn(keel))


def add_gear(thing, sides):
    nose, main = NOSE_X - 6.9, NOSE_X - 13.3
    thing.add(
        "GEAR_NOSE",
        of.STRUT,
        shape.tube((nose, 0, 0.36), (nose + 0.2, 0, 1.6), 0.09, sides // 2),
        shape.tube((nose, -0.3, 0.36), (nose, 0.3, 0.36), 0.05),
    )
    thing.add(
        "GEAR_NOSE_WHEELS",
        of.TYRE,
        shape.wheel(nose, 0.26, 0.37, 0.2, sides),
        shape.wheel(nose, -0.26, 0.37, 0.2, sides),
    )
    thing.add(
        "GEAR_NOSE_DOORS",
        of.SKIN,
        shape.box((nose - 0.9, 0.36, 0.85), (nose + 0.5, 0.40, 1.5)),
        shape.box((nose - 0.9, -0.40, 0.85), (nose + 0.5, -0.36, 1.5)),
    )
    leg = shape.tube((main, 1.6, 1.6), (main, 1.75, 0.64), 0.11, sides // 2)
    brace = shape.tube((main + 1.0, 1.5, 1.4), (main, 1.75, 0.7), 0.06)
    door = shape.box((main - 0.8, 2.12, 0.8), (main + 0.7, 2.16, 1.5))
    tyre = shape.wheel(main, 1.93, 0.65, 0.36, sides)
    for side, turn in (("LEFT", lambda b: b), ("RIGHT", shape.mirrored)):
        thing.add(f"GEAR_{side}", of.STRUT, turn(leg), turn(brace))
        thing.add(f"GEAR_{side}_WHEEL", of.TYRE, turn(tyre))
        thing.add(f"GEAR_{side}_DOOR", of.SKIN, turn(door))


def missile(y, z, station, sides):
    x = NOSE_X - station
    tube = shape.revolve(
        [(x - 5.9, 0), (x - 5.9, 0.14), (x - 0.9, 0.15), (x - 0.5, 0.12), (x - 0.2, 0.06), (x, 0)],
        sides,
        (0, y, z),
    )
    fins = [
        shape.turned(
            shape.panel(
                ((x - a, y + 0.04, z), (x - b, y + 0.04, z)),
                ((x - c, y + s, z), (x - b, y + s, z)),
                0.03,
                4,
            ),
            turn,
            0,
            (0, y, z),
        )
        for a, b, c, s in ((3.6, 5.3, 5.0, 0.55), (1.3, 1.9, 1.8, 0.35))
        for turn in (45, 135, 225, 315)
    ]
    return [tube, *fins]


def add_missiles(thing, sides):
    for name, y, top, station in (("INNER", 3.35, 2.60, 10.4), ("OUTER", 5.15, 2.44, 11.6)):
        for side, hand in (("LEFT", 1), ("RIGHT", -1)):
            x = NOSE_X - station
            thing.add(
                f"MISSILE_{name}_{side}", of.MISSILE, *missile(hand * y, top - 0.52, station, sides)
            )
            thing.add(
                f"PYLON_{name}_{side}",
                of.SKIN,
                shape.box(
                    (x - 4.4, hand * y - 0.05, top - 0.42), (x - 1.8, hand * y + 0.05, top + 0.02)
                ),
            )


def build(name, detail, running=False, armed=True):
    """One fighter: detail 2 in the middle of the picture, 1 elsewhere in it, 0 far off."""
    thing = Thing(name)
    points, pieces, sides = DETAIL[detail]
    add_body(thing, points, pieces)
    add_trunks(thing, points, pieces, running)
    add_engines(thing, sides + 4, running)
    add_wings(thing, 7 + 3 * detail, 1 + detail)
    add_gear(thing, sides)
    if armed:
        add_missiles(thing, sides // 2)
    return thing
