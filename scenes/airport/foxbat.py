"""The twin-tail fighter: x forward, y left, z up from the ground, 22 m long and 14 m across the wings.

Measures follow published three-view drawings of the MiG-25, rounded. A station is a distance behind the nose.
"""
import numpy as np

import shape
import surfaces as of
from gdb_file import Thing

NOSE_X = 11.0
WHEEL_REACH = -0.02  # tyres end a little below the ground, so that no facet lies in the plane of the slabs

# station, half width, bottom, top, power of the superellipse
FORWARD_BODY = [(0.0, .04, 2.18, 2.26, 2), (.5, .15, 2.06, 2.38, 2), (1.4, .34, 1.87, 2.58, 2), (2.7, .56, 1.66, 2.82, 2),
                (4.5, .72, 1.50, 3.00, 2.2), (6.5, .84, 1.40, 3.15, 2.4), (9.0, .92, 1.34, 3.22, 2.6),
                (12.0, .95, 1.32, 3.16, 2.8), (15.0, .90, 1.40, 3.00, 2.8), (18.0, .62, 1.70, 2.80, 2.5), (20.4, .25, 2.0, 2.6, 2)]
RADOME_PIECES = 3
# station, half width, bottom, top, power, offset to the side
TRUNK = [(7.2, .62, 1.20, 2.98, 12, 1.50), (8.6, .64, 1.16, 3.00, 9, 1.50), (10.5, .68, 1.12, 3.00, 7, 1.46),
         (13.0, .76, 1.14, 2.96, 5, 1.36), (15.5, .86, 1.22, 2.92, 4, 1.18), (17.5, .88, 1.32, 2.92, 3, 1.02),
         (19.4, .80, 1.34, 2.92, 2.1, .94)]
DETAIL = (12, 1, 8), (16, 2, 8), (26, 3, 14)  # points of a section, sections a station, sides of a wheel
LIP_SLANT = 0.75      # the upper lip of an intake runs ahead of the lower one
CANOPY = [(3.7, .10, 2.80, 2.96, 2), (4.3, .34, 2.70, 3.32, 2), (5.1, .46, 2.70, 3.62, 2.2), (5.9, .46, 2.75, 3.66, 2.2),
          (6.6, .40, 2.80, 3.58, 2)]
SPINE = [(6.45, .40, 2.8, 3.57, 2), (8.0, .42, 2.8, 3.55, 2.2), (11.0, .38, 2.8, 3.45, 2.4), (14.5, .30, 2.7, 3.22, 2.4),
         (17.0, .16, 2.5, 2.92, 2)]


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
    thing.add("RADOME", of.RADOME, np.concatenate([hull[:nose], hull[-ends:-ends // 2]]),
              shape.tube((NOSE_X - .2, 0, 2.22), (NOSE_X + .9, 0, 2.22), .03))
    thing.add("FUSELAGE", of.SKIN, np.concatenate([hull[nose:-ends], hull[-ends // 2:]]))
    thing.add("CANOPY", of.CANOPY, shape.loft(body(CANOPY, points, pieces)))
    thing.add("SPINE", of.SKIN, shape.loft(body(SPINE, points // 2, pieces)))
    for i, station in enumerate((4.25, 5.15, 6.40)):
        frame = [shape.superellipse(points, w + .03, 2.7, top + .025, 2.1) for w, top in [CANOPY_FRAME[i]] * 2]
        frame[0][:, 0], frame[1][:, 0] = NOSE_X - station, NOSE_X - station - .12
        thing.add("CANOPY_FRAME", of.SKIN, shape.loft(frame))


CANOPY_FRAME = [(.33, 3.31), (.46, 3.63), (.42, 3.60)]


def intake(points, pieces):
    """The left trunk from its slanted lip to the engine, open in front: outside, rim, duct and its dark end."""
    outside = body(TRUNK, points, pieces)
    lean = LIP_SLANT * (outside[:, :, 2] - 2.0)
    fade = np.clip((NOSE_X - 7.2 - outside[:, :, 0]) / 2.5, 0, 1)
    outside[:, :, 0] += lean * (1 - fade)
    inside = outside[0] + 0.0
    middle = inside.mean(0)
    inside[:, 1:] = middle[1:] + (inside[:, 1:] - middle[1:]) * [.90, .94]
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
    ramp = shape.turned(shape.box((-.05, -.52, -.03), (1.9, .52, .03)), -10, 1)
    ramp = shape.moved(ramp, (NOSE_X - 9.1, 1.5, 2.42))
    for side, turn in (("LEFT", lambda b: b), ("RIGHT", shape.mirrored)):
        thing.add(f"TRUNK_{side}", of.SKIN, turn(hull))
        thing.add(f"INTAKE_{side}", of.DUCT_RUNNING if running else of.DUCT, turn(hole), turn(ramp))


def add_engines(thing, sides, running):
    metal, hot = (of.TAIL_METAL_RUNNING, of.EXHAUST_RUNNING) if running else (of.TAIL_METAL, of.EXHAUST)
    for side, y in (("LEFT", .94), ("RIGHT", -.94)):
        outside = np.array([(-8.0, .78), (-8.6, .80), (-9.4, .77), (-10.1, .73), (-10.6, .69), (-10.6, .60)])
        inside = np.array([(-10.6, .60), (-9.8, .56), (-9.0, .50), (-9.0, .0)])
        whole = np.concatenate([[(-8.0, 0)], outside, inside[1:]])
        skin = shape.revolve(whole, sides, (0, y, 2.1))
        parts = skin.reshape(len(whole) - 1, sides, 4, 3)
        thing.add(f"NOZZLE_{side}", metal, parts[:len(outside)].reshape(-1, 4, 3))
        thing.add(f"EXHAUST_{side}", hot, parts[len(outside):].reshape(-1, 4, 3))


def add_wings(thing, chord_points, pieces):
    at = lambda station, y, z: (NOSE_X - station, y, z)
    wing = shape.panel((at(9.0, 1.4, 2.80), at(15.1, 1.4, 2.80)), (at(13.8, 7.0, 2.30), at(16.1, 7.0, 2.30)), .04, chord_points, pieces)
    flap = shape.panel((at(14.2, 2.3, 2.66), at(15.65, 2.3, 2.60)), (at(14.9, 5.0, 2.44), at(16.05, 5.0, 2.40)), .06, 5)
    fin = shape.panel((at(14.8, 1.25, 2.7), at(20.3, 1.25, 2.7)), (at(19.2, 1.72, 6.1), at(21.2, 1.72, 6.1)), .04, chord_points, pieces)
    tail = shape.panel((at(17.6, 1.6, 2.0), at(21.0, 1.6, 2.0)), (at(20.7, 4.4, 1.9), at(22.0, 4.4, 1.9)), .04, chord_points, pieces)
    keel = shape.panel((at(15.6, 1.3, 1.4), at(18.6, 1.3, 1.4)), (at(17.0, 1.7, .75), at(18.6, 1.7, .75)), .04, 5)
    fence = shape.box(at(14.0, 3.9, 2.5), at(11.6, 3.97, 2.95))
    pod = shape.revolve([(NOSE_X - 15.9, 0), (NOSE_X - 15.7, .1), (NOSE_X - 14, .13), (NOSE_X - 13.2, .09), (NOSE_X - 12.8, 0)],
                        8, (0, 7.0, 2.30))
    for side, turn in (("LEFT", lambda b: b), ("RIGHT", shape.mirrored)):
        thing.add(f"WING_{side}", of.SKIN, turn(wing), turn(fence), turn(pod))
        thing.add(f"FLAP_{side}", of.SKIN, turn(flap))
        thing.add(f"FIN_{side}", of.SKIN, turn(fin))
        thing.add(f"TAILPLANE_{side}", of.SKIN, turn(tail))
        thing.add(f"KEEL_{side}", of.SKIN, turn(keel))


def wheel(x, y, radius, width, sides):
    half = width / 2
    profile = [(-half * .6, 0), (-half, radius * .62), (-half, radius * .9), (-half * .7, radius),
               (half * .7, radius), (half, radius * .9), (half, radius * .62), (half * .6, 0)]
    return shape.revolve(profile, sides, (x, y, radius + WHEEL_REACH), axis=1)


def add_gear(thing, sides):
    nose, main = NOSE_X - 6.9, NOSE_X - 13.3
    thing.add("GEAR_NOSE", of.STRUT, shape.tube((nose, 0, .36), (nose + .2, 0, 1.6), .09, sides // 2),
              shape.tube((nose, -.3, .36), (nose, .3, .36), .05))
    thing.add("GEAR_NOSE_WHEELS", of.TYRE, wheel(nose, .26, .37, .2, sides), wheel(nose, -.26, .37, .2, sides))
    thing.add("GEAR_NOSE_DOORS", of.SKIN, shape.box((nose - .9, .36, .85), (nose + .5, .40, 1.5)),
              shape.box((nose - .9, -.40, .85), (nose + .5, -.36, 1.5)))
    leg = shape.tube((main, 1.6, 1.6), (main, 1.75, .64), .11, sides // 2)
    brace = shape.tube((main + 1.0, 1.5, 1.4), (main, 1.75, .7), .06)
    door = shape.box((main - .8, 2.12, .8), (main + .7, 2.16, 1.5))
    tyre = wheel(main, 1.93, .65, .36, sides)
    for side, turn in (("LEFT", lambda b: b), ("RIGHT", shape.mirrored)):
        thing.add(f"GEAR_{side}", of.STRUT, turn(leg), turn(brace))
        thing.add(f"GEAR_{side}_WHEEL", of.TYRE, turn(tyre))
        thing.add(f"GEAR_{side}_DOOR", of.SKIN, turn(door))


def missile(y, z, station, sides):
    x = NOSE_X - station
    tube = shape.revolve([(x - 5.9, 0), (x - 5.9, .14), (x - .9, .15), (x - .5, .12), (x - .2, .06), (x, 0)], sides, (0, y, z))
    fins = [shape.turned(shape.panel(((x - a, y + .04, z), (x - b, y + .04, z)), ((x - c, y + s, z), (x - b, y + s, z)), .03, 4), turn, 0, (0, y, z))
            for a, b, c, s in ((3.6, 5.3, 5.0, .55), (1.3, 1.9, 1.8, .35)) for turn in (45, 135, 225, 315)]
    return [tube, *fins]


def add_missiles(thing, sides):
    for name, y, top, station in (("INNER", 3.35, 2.60, 10.4), ("OUTER", 5.15, 2.44, 11.6)):
        for side, hand in (("LEFT", 1), ("RIGHT", -1)):
            x = NOSE_X - station
            thing.add(f"MISSILE_{name}_{side}", of.MISSILE, *missile(hand * y, top - .52, station, sides))
            thing.add(f"PYLON_{name}_{side}", of.SKIN,
                      shape.box((x - 4.4, hand * y - .05, top - .42), (x - 1.8, hand * y + .05, top + .02)))


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
