"""Structures: x forward out of the door, y left, z up from the ground; foundations reach below z = 0."""
import numpy as np

import shape
import surfaces as of
from gdb_file import Thing
from vehicle import rounded

BASE = -0.35  # parts of a house end at different depths, so that no two facets lie in one plane


def arch(half_width, spring, rise, points):
    """Roof outline from right to left, a flat curve of the given rise over its springing."""
    turn = np.linspace(0, np.pi, points)
    return np.stack([half_width * np.cos(turn), spring + rise * np.sin(turn)], 1)


def hangar(name, depth=32.0, half=15.0, pieces=10, points=29, leaves=3):
    """An arched hall, open in front, with ribs, skylights, sliding doors and something to work with inside."""
    thing, eaves, rise, head = Thing(name), 5.2, 4.2, 7.0
    sides = [shape.box((-depth + .3, y - .15, BASE), (-.3, y + .15, eaves + .15)) for y in (-half + .35, half - .35)]
    thing.add("WALLS", of.BRICK_WALL, *sides)
    thing.add("BACK", of.BRICK_WALL, upright(arch(half - .25, eaves - .05, rise, points), -depth + .05, -depth + .35, BASE - .1))
    outline = arch(half, eaves, rise, points)
    thing.add("ROOF", of.SHEET, shape.strip(outline, -.12, -depth, .6, 0, pieces))
    thing.add("RIBS", of.FRAME, *[shape.strip(arch(half - .25, eaves - .1, rise, 13), .35, x, x + .2, 0)
                                  for x in np.linspace(-depth + 2, -2, 8)])
    thing.add("GABLE", of.SHEET, upright(arch(half - .2, eaves - .05, rise, points), -.3, -.05, head, narrow=.86))
    piers = [shape.box((-.5, y - 1.1, BASE - .05), (0.0, y + 1.1, eaves + .8)) for y in (-half + 1.25, half - 1.25)]
    thing.add("PIERS", of.WALL, *piers)
    for i in range(leaves):
        out = .15 + .25 * i
        thing.add(f"DOOR_{i + 1}", of.SHEET, *[panelled(out, y * (half - 2.3 - .5 * i), 4.2, head + .2) for y in (-1, 1)])
    thing.add("RAIL", of.FRAME, shape.box((.05, -half - 1, head + .15), (1.0, half + 1, head + .45)))
    add_roof_fittings(thing, depth, eaves + rise)
    add_inside(thing, depth, half)
    return thing


def upright(outline, low, high, floor, narrow=1.0):
    """A wall from a floor up to an outline, drawn out in x."""
    outline = outline[np.abs(outline[:, 0]) <= narrow * outline[:, 0].max()]
    rings = [[(low, y, floor), (high, y, floor), (high, y, max(z, floor + .05)), (low, y, max(z, floor + .05))] for y, z in outline]
    return shape.loft(rings)


def panelled(x, y, width, height):
    """A sliding door leaf with its stiffening bars."""
    leaf = [shape.box((x, y - width / 2, .03), (x + .08, y + width / 2, height))]
    leaf += [shape.box((x + .07, y - width / 2 + .05, z), (x + .14, y + width / 2 - .05, z + .12)) for z in np.linspace(.5, height - .6, 4)]
    return np.concatenate(leaf)


def add_roof_fittings(thing, depth, top):
    vents = [shape.revolve([(top - .3, 0), (top - .3, .45), (top + .7, .45), (top + .75, .7), (top + 1.05, .5), (top + 1.15, 0)], 10, (x, 0, 0), axis=2)
             for x in np.linspace(-depth + 4, -4, 5)]
    thing.add("VENTS", of.SHEET, *vents)
    lights = [shape.moved(shape.turned(shape.box((x, -1.6, -.12), (x + 2.2, 1.6, .06)), s * 11.5, 0), (0, -s * 5.6, top - .21))
              for x in np.linspace(-depth + 3, -5, 5) for s in (-1, 1)]
    thing.add("SKYLIGHTS", of.PANE, *lights)


def add_inside(thing, depth, half):
    benches = [rounded((x, s * (half - 1.5) - .5, BASE), (x + 2.5, s * (half - 1.5) + .5, .95), .04, 0) for x in np.arange(-depth + 3, -6, 5.0) for s in (-1, 1)]
    thing.add("BENCHES", of.PLANK, *benches)
    thing.add("LOCKERS", of.SHEET, *[shape.box((-depth + .45, y, BASE), (-depth + 1.1, y + .9, 2.0)) for y in np.arange(-9.0, 8.5, 1.0)])
    lamps = [shape.revolve([(7.0, 0), (7.0, .45), (7.3, .2), (7.5, 0)], 10, (x, y, 0), axis=2) for x in np.linspace(-depth + 4, -4, 4) for y in (-6, 6)]
    thing.add("LAMPS", of.LAMP, *lamps)


def mound_rings(half, height, length, front, pieces, points):
    """A long bank of earth that falls off at its back end."""
    turn = np.linspace(0, np.pi, points)
    rings = []
    for x in np.linspace(front, front - length, pieces):
        back = np.clip((x - (front - length)) / (.45 * length), 0, 1)
        swell = .12 + .88 * np.sin(back * np.pi / 2) ** .8
        y, z = half * (.45 + .55 * swell) * np.cos(turn), height * swell * np.sin(turn) ** 1.15
        rings.append(np.stack([np.full(points, x), y, BASE + z], 1))
    return np.array(rings)


def bunker(name, scale=1.0, pieces=12, points=21):
    """A shelter: a concrete arch with steel doors under a bank of earth."""
    thing = Thing(name)
    thing.add("MOUND", of.EARTH, shape.loft(mound_rings(14 * scale, 8.6 * scale, 30 * scale, -2.5, pieces, points)))
    curve = arch(8.2 * scale, BASE - .15, 8.0 * scale, points)
    thing.add("PORTAL", of.WALL, shape.strip(curve, -1.1 * scale, -5, 0, 0))
    thing.add("FRONT", of.WALL, upright(arch(8.4 * scale, BASE, 8.2 * scale, 21)[1:-1], -2.9, -2.4, BASE - .05))
    leaves = [np.concatenate([shape.box((-2.45, y0, BASE - .1), (-1.9, y1, 5.2 * scale)),
                              *[shape.box((-1.95, y0 + .1, z), (-1.75, y1 - .1, z + .3)) for z in np.linspace(.5, 4.4 * scale, 4)]])
              for y0, y1 in ((-5.6 * scale, -.03), (.03, 5.6 * scale))]
    thing.add("DOORS", of.FRAME, *leaves)
    wings = [shape.prism([(0, BASE - .2), (0, 4.0 * scale), (6, .8), (6, BASE - .2)], y - .2, y + .2, 1) for y in (-10.2 * scale, 10.2 * scale)]
    thing.add("WING_WALLS", of.WALL, *[shape.moved(wing, (-2.6, 0, 0)) for wing in wings])
    pipes = [shape.revolve([(7.0 * scale, 0), (7.0 * scale, .25), (9.6 * scale, .25), (9.65 * scale, .45), (9.9 * scale, 0)], 12, (x * scale, 0, 0), axis=2)
             for x in (-7, -12)]
    thing.add("PIPES", of.FRAME, *pipes)
    return thing


def octagon(radius, z):
    turn = (np.arange(8) + .5) * np.pi / 4
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), np.full(8, z)], 1)


def tower(name):
    """The control tower: shaft, gallery, leaning glass, roof with aerials."""
    thing = Thing(name)
    thing.add("SHAFT", of.WALL, shape.loft([octagon(r, z) for r, z in ((3.6, BASE), (3.2, 3), (3.0, 9), (3.0, 16.1))]))
    thing.add("COLLAR", of.WALL, shape.loft([octagon(r, z) for r, z in ((3.05, 15), (4.6, 16.5), (4.9, 16.55), (4.9, 17))]))
    thing.add("GLASS", of.WARM_PANE, shape.loft([octagon(3.5, 16.9), octagon(4.1, 19.6)]))
    thing.add("MULLIONS", of.FRAME, *[shape.tube(a, b, .07, 4) for a, b in zip(octagon(3.52, 16.95), octagon(4.12, 19.65))])
    thing.add("ROOF", of.ROOF, shape.loft([octagon(r, z) for r, z in ((4.3, 19.5), (4.7, 19.7), (4.7, 20.0), (1.2, 20.6))]))
    rail = octagon(4.8, 18.0)
    thing.add("RAIL", of.FRAME, *[shape.tube(a + .01 * (b - a), b + .01 * (a - b), .03, 4) for a, b in zip(rail, np.roll(rail, -1, 0))],
              *[shape.tube(a - (0, 0, 1.05), a + (0, 0, .02), .03, 4) for a in rail])
    thing.add("AERIALS", of.BARE_FRAME, *[shape.tube((x, y, 20.1), (x, y, h), .04, 5) for x, y, h in ((.5, .3, 25), (-1.5, 1, 23), (1, -1.6, 22.5))])
    thing.add("WINDOWS", of.PANE, *[shape.turned(shape.box((2.7, -.5, z), (2.96, .5, z + 1.2)), t, 2) for z in (4, 8, 12) for t in (0, 90, 180)])
    thing.add("DOOR", of.FRAME, shape.box((2.9, -.6, BASE - .05), (3.5, .6, 2.1)))
    return thing


def windows(x, ys, zs, size, facing):
    """Panes in a wall whose face is at x; facing is +1 or -1."""
    return [shape.box((min(x - .05, x + facing * .04), y - size[0] / 2, z), (max(x + .05, x + facing * .04), y + size[0] / 2, z + size[1])) for y in ys for z in zs]


def operations(name):
    """A flat-roofed house of two storeys, rooms lit, with machines on its roof."""
    thing = Thing(name)
    thing.add("WALLS", of.BRICK_WALL, shape.box((-6, -14, BASE), (6, 14, 7.2)))
    thing.add("ROOF", of.ROOF, shape.box((-5.7, -13.7, 7.1), (5.7, 13.7, 7.3)))
    thing.add("PARAPET", of.WALL, *[shape.box(a, b) for a, b in (((-6.15, -14.15, 7.05), (-5.75, 14.15, 7.8)), ((5.75, -14.15, 7.05), (6.15, 14.15, 7.8)),
              ((-5.8, -14.1, 7.06), (5.8, -13.75, 7.79)), ((-5.8, 13.75, 7.06), (5.8, 14.1, 7.79)))])
    thing.add("FRONT_WINDOWS", of.WARM_PANE, *windows(6, np.arange(-12, 13, 3.0), (1.0, 4.4), (1.6, 1.5), 1))
    thing.add("BACK_WINDOWS", of.WARM_PANE, *windows(-6, np.arange(-12, 13, 3.0), (1.0, 4.4), (1.6, 1.5), -1))
    thing.add("DOOR", of.PLANK, *[shape.box((5.9, y, BASE - .05), (6.06, y + 1.2, 2.2)) for y in (-11.1, .9)])
    thing.add("MACHINES", of.BONNET_WARM, *[rounded((x, y, 7.25), (x + 2, y + 1.6, 8.5), .1, 0) for x, y in ((-3, -9), (-3, -5), (1.5, 6))])
    thing.add("FANS", of.FRAME, *[shape.revolve([(8.4, 0), (8.4, .6), (8.75, .6), (8.75, 0)], 14, (x + 1, y + .8, 0), axis=2) for x, y in ((-3, -9), (-3, -5), (1.5, 6))])
    thing.add("CANOPY", of.WALL, shape.box((5.8, -1.5, 3.2), (8.5, 4.5, 3.45)), shape.tube((8.2, -1.2, BASE), (8.2, -1.2, 3.3), .1, 8), shape.tube((8.2, 4.2, BASE), (8.2, 4.2, 3.3), .1, 8))
    return thing


def shed(name, depth=9.0, half=3.2, height=2.8):
    """A wooden shed with a shingle roof."""
    thing = Thing(name)
    ridge = height + half * .62
    thing.add("WALLS", of.PLANK, shape.prism([(-half, BASE), (half, BASE), (half, height), (0, ridge), (-half, height)], -depth, 0, 0))
    slope = [(half + .4, height - .22), (0, ridge + .03), (-half - .4, height - .22)]
    thing.add("ROOF", of.SHINGLES, *[shape.strip(side, -.1, -depth - .4, .4, 0, 6) for side in (slope[:2], slope[1:])])
    thing.add("DOOR", of.PLANK, shape.box((-.1, -1.2, BASE - .05), (.06, 1.2, 2.3)))
    thing.add("WINDOWS", of.PANE, *[shape.box((x, s * half - .05, 1.1), (x + 1.2, s * half + .05, 2.0)) for x in (-6.5, -4, -2) for s in (-1, 1)])
    return thing


def fuel_tank(name, radius=5.0, height=6.5, sides=32):
    """A standing tank with a dished roof, stair and pipe inside a low wall."""
    thing = Thing(name)
    profile = [(BASE, 0), (BASE, radius), (height * .33, radius), (height * .66, radius), (height, radius), (height + .5, radius * .6), (height + .65, 0)]
    thing.add("SHELL", of.TANK, shape.revolve(profile, sides, (0, 0, 0), axis=2))
    turn = np.radians(np.arange(0, 181, 9.0))
    steps = [shape.moved(shape.turned(shape.box((0, -.25, 0), (.9, .25, .06)), np.degrees(t), 2), ((radius - .05) * np.cos(t), (radius - .05) * np.sin(t), .2 + t / np.pi * (height - .3))) for t in turn]
    thing.add("STAIR", of.FRAME, *steps)
    thing.add("PIPE", of.FRAME, shape.tube((radius - .1, -1, .6), (radius + 3.2, -1, .6), .15, 10), shape.tube((radius + 3.1, -1, BASE), (radius + 3.1, -1, .8), .15, 9))
    r = radius + 2.5
    for i, (a, b) in enumerate((((-r, -r), (r, -r + .3)), ((-r, r - .3), (r, r)), ((-r, -r + .31), (-r + .3, r - .31)), ((r - .3, -r + .31), (r, r - .31))), 1):
        thing.add(f"BUND_{i}", of.WALL, shape.box((*a, BASE), (*b, 1.1)))
    return thing


def floodlights(name, places):
    """Masts with four lamps each; the places are in the frame of the object."""
    thing = Thing(name)
    for i, (x, y) in enumerate(places, 1):
        thing.add(f"MAST_{i}", of.FRAME, shape.revolve([(BASE, 0), (BASE, .22), (9, .14), (16, .09), (16, 0)], 10, (x, y, 0), axis=2),
                  shape.box((x - .06, y - 1.4, 15.6), (x + .06, y + 1.4, 15.8)))
        lamps = [shape.turned(shape.box((x + .05, y + k - .25, 15.8), (x + .35, y + k + .25, 16.2)), 35, 1, (x, y, 15.8)) for k in (-1.05, -.35, .35, 1.05)]
        thing.add(f"LAMPS_{i}", of.LAMP, *lamps)
    return thing


def windsock(name):
    thing = Thing(name)
    thing.add("MAST", of.FRAME, shape.tube((0, 0, BASE), (0, 0, 7), .07, 8))
    profile = [(0, .02), (0, .45), (1.2, .38), (2.4, .3), (3.4, .22), (3.4, .02), (0, .02)]
    thing.add("SOCK", of.CANVAS, shape.moved(shape.turned(shape.revolve(profile, 14, (0, 0, 0)), 18, 1), (.1, 0, 6.6)))
    return thing


def crates(name):
    """Stacked boxes under the hangar's wall."""
    thing = Thing(name)
    sizes = [(0, 0, 1.2, 1.0, .9), (1.5, .1, 1.0, 1.0, 1.1), (2.8, 0, 1.6, 1.1, .8), (.1, 1.4, 1.1, 1.1, 1.2), (1.6, 1.5, 1.4, 1.0, .7), (3.4, 1.4, 1.0, 1.0, 1.4)]
    for i, (x, y, dx, dy, dz) in enumerate(sizes, 1):
        thing.add(f"BOX_{i}", of.PLANK, rounded((x, y, -.05), (x + dx, y + dy, dz), .03, 2), rounded((x + .1, y + .1, dz - .02), (x + dx * .7, y + dy * .8, dz + .5), .03, 2))
    return thing
