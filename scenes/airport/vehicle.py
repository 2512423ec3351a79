"""Vehicles and other things on wheels: x forward, y left, z up from the ground."""
import numpy as np

import shape
import surfaces as of
from foxbat import wheel
from gdb_file import Thing


def add_wheels(thing, name, axles, half_track, radius, width, sides):
    for i, x in enumerate(axles, 1):
        thing.add(f"{name}_{i}", of.TYRE, *(wheel(x, y, radius, width, sides) for y in (half_track, -half_track)))


def rounded(low, high, cut, axis=0):
    """A box whose long edges along an axis are cut off."""
    (a0, b0), (a1, b1) = np.delete(low, axis), np.delete(high, axis)
    profile = [(a0 + cut, b0), (a1 - cut, b0), (a1, b0 + cut), (a1, b1 - cut), (a1 - cut, b1), (a0 + cut, b1),
               (a0, b1 - cut), (a0, b0 + cut)]
    return shape.prism(profile, low[axis], high[axis], axis)


def car(name, sides=16):
    """A saloon: warm panels, thin glass, four wheels."""
    thing = Thing(name)
    lower = [(-2.1, .32), (2.05, .32), (2.15, .6), (2.0, .82), (.9, .95), (-1.5, .98), (-2.15, .9), (-2.2, .55)]
    rings = np.array([np.insert(np.array(lower) * [1 - .05 * abs(t) ** 3, 1] + [0, 0], 1, .86 * t, axis=1)
                      for t in np.linspace(-1, 1, 9)])
    thing.add("BODY", of.CAR_SIDE, shape.loft(rings))
    glass = [[(-1.55, y, .9), (1.0, y, .9), (.35, y * .8, 1.40), (-1.05, y * .8, 1.40)] for y in (-.80, .80)]
    thing.add("GLASS", of.WINDSHIELD, shape.loft(glass))
    roof = rounded((-1.12, -.68, 1.385), (.42, .68, 1.45), .02, axis=0)
    thing.add("ROOF", of.CAR_ROOF, roof)
    pillars = [shape.tube((a, s * .79, .9), (b, s * .655, 1.41), .04, 4) for a, b in ((1.0, .36), (-.2, -.2), (-1.52, -1.05))
               for s in (-1, 1)]
    thing.add("PILLARS", of.CAR_ROOF, *pillars)
    thing.add("BUMPERS", of.BUMPER, rounded((2.08, -.82, .36), (2.24, .82, .56), .04, axis=1),
              rounded((-2.28, -.82, .36), (-2.12, .82, .56), .04, axis=1))
    lamps = [shape.box((a, y - .15, .62), (a + .06, y + .15, .74)) for a in (2.09, -2.2) for y in (-.6, .6)]
    thing.add("LAMPS", of.LAMP, *lamps)
    add_wheels(thing, "WHEELS", (1.3, -1.3), .78, .33, .2, sides)
    return thing


def add_cab(thing, front):
    """A truck's bonnet and cab with its windows, ahead of x = front - 3."""
    thing.add("BONNET", of.BONNET_WARM, rounded((front - 1.4, -.7, .95), (front, .7, 1.72), .12))
    side = [(front - 2.9, .9), (front - 1.3, .9), (front - 1.35, 1.8), (front - 1.6, 2.6), (front - 2.8, 2.65)]
    rings = np.array([np.insert(side, 1, y, axis=1) for y in np.linspace(-1.1, 1.1, 5)])
    thing.add("CAB", of.OLIVE, shape.loft(rings))
    pane = shape.turned(shape.box((-.02, -.95, -.28), (.03, .95, .28)), -17.35, 1)
    doors = [shape.box((front - 2.6, y - .02, 1.85), (front - 1.75, y + .02, 2.45)) for y in (-1.1, 1.1)]
    thing.add("WINDOWS", of.WINDSHIELD, shape.moved(pane, (front - 1.475, 0, 2.2)), *doors)
    fenders = [rounded((front - 1.3, s - .3, .78), (front - .1, s + .3, 1.06), .1) for s in (-.9, .9)]
    thing.add("FENDERS", of.OLIVE, *fenders)
    thing.add("BUMPER", of.BUMPER, rounded((front - .05, -1.15, .55), (front + .12, 1.15, .8), .04, axis=1))
    lamps = [shape.revolve([(front - .14, 0), (front - .14, .12), (front + .04, .12), (front + .06, 0)], 10, (0, y, 1.12)) for y in (-.85, .85)]
    thing.add("LAMPS", of.LAMP, *lamps)


def add_frame(thing, rear, front):
    rails = [shape.box((rear, y - .08, .62), (front - .3, y + .08, .86)) for y in (-.45, .45)]
    cross = [shape.box((x, -.5, .66), (x + .12, .5, .82)) for x in np.linspace(rear + .3, front - 1, 5)]
    thing.add("FRAME", of.FRAME, *rails, *cross)


def truck(name, sides=16, covered=True):
    """A three-axle truck; the bed carries bows and a canvas cover, or crates."""
    thing = Thing(name)
    add_frame(thing, -3.6, 3.6)
    add_cab(thing, 3.6)
    thing.add("BED", of.PLANK, shape.box((-3.7, -1.2, .9), (.5, 1.2, 1.02)))
    boards = [shape.box((-3.69, y - .03, 1.0), (.49, y + .03, 1.6)) for y in (-1.18, 1.18)]
    boards += [shape.box((x - .03, -1.13, 1.0), (x + .03, 1.13, 1.6)) for x in (-3.66, .46)]
    thing.add("BOARDS", of.PLANK, *boards)
    if covered:
        turn = np.linspace(0, np.pi, 17)
        arch = [(1.24 * np.cos(t), 1.5 + 1.35 * np.sin(t) ** .6) for t in turn]
        thing.add("COVER", of.CANVAS, shape.strip(arch, -.03, -3.74, .54, 0, pieces=8))
    else:
        crates = [rounded((x, y, 1.0), (x + .9, y + .8, h), .03, 2) for x, y, h in
                  ((-3.4, -.9, 1.8), (-2.3, .1, 1.6), (-2.3, -1.0, 2.1), (-1.1, -.4, 1.9), (-3.4, .2, 1.5))]
        thing.add("CRATES", of.PLANK, *crates)
    add_wheels(thing, "WHEELS", (2.7, -1.5, -2.7), .98, .52, .3, sides)
    return thing


def tanker(name, sides=20):
    """A fuel truck: a round tank with domes, a walkway and a hose reel."""
    thing = Thing(name)
    add_frame(thing, -4.2, 3.6)
    add_cab(thing, 3.6)
    profile = [(-4.2, 0), (-4.15, .5), (-4.0, .85), (-3.8, 1.0), (-2, 1.0), (-.9, 1.0), (.2, 1.0), (.4, .85), (.5, .5), (.53, 0)]
    thing.add("TANK", of.TANK, shape.revolve(profile, sides, (0, 0, 1.86)))
    domes = [shape.revolve([(2.5, 0), (2.5, .3), (2.98, .3), (3.03, .2), (3.03, 0)], 12, (x, 0, 0), axis=2) for x in (-3.2, -1.8, -.4)]
    thing.add("DOMES", of.TANK, *domes)
    thing.add("WALKWAY", of.FRAME, shape.box((-3.9, .55, 2.78), (.2, .95, 2.83)), shape.box((-3.9, -.95, 2.78), (.2, -.55, 2.83)))
    thing.add("LADDER", of.FRAME, *[shape.tube((-4.3, y, .8), (-4.3, y, 2.8), .02) for y in (-.2, .2)],
              *[shape.tube((-4.3, -.2, z), (-4.3, .2, z), .015) for z in (1.1, 1.5, 1.9, 2.3)])
    thing.add("REEL", of.OLIVE, shape.revolve([(-.5, 0), (-.5, .3), (.5, .3), (.5, 0)], 14, (-3.4, 0, .72), axis=1))
    add_wheels(thing, "WHEELS", (2.7, -1.9, -3.1), .98, .52, .3, sides - 4)
    return thing


def tug(name):
    """A low aircraft tug with its tow bar."""
    thing = Thing(name)
    thing.add("BODY", of.OLIVE, rounded((-1.9, -1.1, .3), (1.9, 1.1, .95), .12))
    thing.add("CAB", of.BONNET_WARM, rounded((.3, -.8, .93), (1.7, .8, 1.3), .08))
    thing.add("SEAT", of.CANVAS, rounded((-.6, -.7, .94), (-.1, .7, 1.3), .06, 1), rounded((-.75, -.66, 1.2), (-.55, .66, 1.7), .04, 1))
    thing.add("BUMPERS", of.BUMPER, shape.box((1.85, -1.05, .35), (2.0, 1.05, .65)), shape.box((-2.0, -1.05, .35), (-1.85, 1.05, .65)))
    thing.add("TOWBAR", of.BARE_FRAME, shape.tube((-1.9, 0, .45), (-5.4, 0, .4), .06, 8), shape.tube((-5.4, -.4, .4), (-5.4, .4, .4), .05, 8))
    add_wheels(thing, "WHEELS", (1.2, -1.2), 1.02, .42, .28, 20)
    return thing


def generator_cart(name):
    """A ground power unit, running: a warm housing with louvres and a cable drum."""
    thing = Thing(name)
    thing.add("HOUSING", of.BONNET_WARM, rounded((-1.3, -.7, .5), (1.1, .7, 1.6), .12))
    thing.add("LOUVRES", of.FRAME, *[shape.turned(shape.box((x, s * .71 - .02, .8), (x + .06, s * .71 + .03, 1.35)), s * 25, 2, (x, s * .71, 0))
                                     for s in (-1, 1) for x in np.arange(-.9, .8, .2)])
    thing.add("PIPE", of.EXHAUST_RUNNING, shape.tube((-.9, .3, 1.5), (-.9, .3, 2.0), .07, 12))
    thing.add("DRUM", of.DRUM, shape.revolve([(-.4, 0), (-.4, .42), (-.34, .42), (-.3, .25), (.3, .25), (.34, .42), (.4, .42), (.4, 0)], 18, (1.45, 0, .75), axis=1))
    thing.add("BAR", of.FRAME, shape.tube((-1.2, 0, .45), (-2.4, 0, .3), .05))
    add_wheels(thing, "WHEELS", (.7, -.8), .72, .34, .2, 16)
    return thing


def weapon_trailer(name):
    """A flat trailer with four missiles on cradles."""
    from foxbat import NOSE_X, missile
    thing = Thing(name)
    thing.add("BED", of.FRAME, shape.box((-3.2, -1.0, .62), (2.9, 1.0, .74)))
    thing.add("CRADLES", of.PLANK, *[rounded((x, -.96, .73), (x + .2, .96, .92), .02, 1) for x in (-2.3, -.8, .7)])
    for i, y in enumerate((-.72, -.24, .24, .72), 1):
        thing.add(f"MISSILE_{i}", of.MISSILE, missile(y, 1.05, NOSE_X - 2.95, 12)[0])
    thing.add("BAR", of.FRAME, shape.tube((2.8, 0, .66), (4.3, 0, .4), .05, 8))
    add_wheels(thing, "WHEELS", (1.8, -2.0), .82, .38, .22, 16)
    return thing


def radar_van(name):
    """A truck with a cabin and a dish on a mast."""
    thing = truck(name, 12)
    del thing.parts["COVER"]
    thing.add("CABIN", of.OLIVE, rounded((-3.58, -1.11, 1.01), (.38, 1.11, 2.9), .15))
    thing.add("MAST", of.FRAME, shape.tube((-1.6, 0, 2.8), (-1.6, 0, 4.6), .12, 10))
    r = np.linspace(0, 1.7, 7)
    front, back = np.stack([.18 * r**2, r], 1), np.stack([.18 * r**2 - .06, r], 1)
    dish = shape.revolve(np.concatenate([front, back[::-1]]), 28, (0, 0, 0))
    thing.add("DISH", of.SKIN, shape.moved(shape.turned(dish, -25, 1), (-1.5, 0, 5.2)))
    thing.add("FEED", of.BARE_FRAME, shape.tube((-1.6, 0, 4.6), (-.1, 0, 5.85), .04, 6))
    return thing


def drums(name):
    """A dozen fuel drums on end."""
    thing = Thing(name)
    profile = [(-.02, 0), (-.02, .29), (.3, .29), (.32, .31), (.34, .29), (.6, .29), (.62, .31), (.64, .29), (.9, .29), (.9, 0)]
    for row in range(3):
        thing.add(f"ROW_{row + 1}", of.DRUM, *[shape.revolve(profile, 10, (.7 * column, .7 * row, 0), axis=2) for column in range(4)])
    return thing
