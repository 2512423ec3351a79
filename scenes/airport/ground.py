"""What lies on the ground, built in place in east, north, up."""

import numpy as np

import shape
import surfaces as of
from gdb_file import Thing

GRASS_TOP, PAVED_TOP = -1.0, -0.5  # as printed for the grass and the runway
SUNK = -1.3  # where the apron ends inside the earth; others end a little above or below


def slab(name, surface, east, north, top, bottom):
    thing = Thing(name)
    thing.add("", surface, shape.box((east[0], north[0], bottom), (east[1], north[1], top)))
    return thing


def runway2():
    """The object that thesis Appendix A prints: 300 by 30 m, north 60..360, west -60..-30."""
    return slab("RUNWAY2", of.RUNWAY, (30, 60), (60, 360), PAVED_TOP, GRASS_TOP)


def grass():
    """2500 by 3000 m, the object that thesis Appendix A prints."""
    return slab("GRASS", of.GRASS, (-2150, 850), (-1300, 1200), GRASS_TOP, -6)


def stripe(low, high, top):
    return shape.box((*low, top - 0.2), (*high, top + 0.01))


def runway1(east=(400, 445), north=(-1200, 1100)):
    """The main runway with centre line, threshold bars and edge lights."""
    thing = slab("RUNWAY1", of.RUNWAY, east, north, PAVED_TOP, -1.5)
    thing.parts["SURFACE"] = thing.parts.pop("")
    middle = sum(east) / 2
    dashes = [
        stripe((middle - 0.45, n), (middle + 0.45, n + 30), PAVED_TOP)
        for n in np.arange(north[0] + 80, north[1] - 80, 50)
    ]
    thing.add("CENTRE_LINE", of.MARKING, *dashes)
    for name, start in (("SOUTH", north[0] + 6), ("NORTH", north[1] - 36)):
        bars = [
            stripe((e, start), (e + 1.8, start + 30), PAVED_TOP)
            for e in np.arange(east[0] + 3, east[1] - 4, 3.6)
        ]
        thing.add(f"{name}_BARS", of.MARKING, *bars)
    lights = [
        shape.box((e, n, GRASS_TOP - 0.1), (e + 0.2, n + 0.2, PAVED_TOP + 0.2))
        for e in (east[0] - 2, east[1] + 2)
        for n in np.arange(north[0] + 7, north[1], 100)
    ]
    thing.add("LIGHTS", of.LAMP, *lights)
    return thing


def joints(start, count, width, gap):
    """Edges of slabs with a gap before, between and behind them."""
    steps = np.tile([gap, width], count).tolist() + [gap]
    return start + np.concatenate([[0], np.cumsum(steps)])


def apron(east, north, columns, rows, width=6.0, gap=0.06, rows_per_part=2):
    """Concrete slabs with tar-filled gaps, level: tops that share their edges, sides, underside."""
    thing = Thing("APRON")
    x, y = joints(east, columns, width, gap), joints(north, rows, width, gap)
    tops = {}
    for j in range(len(y) - 1):
        for i in range(len(x) - 1):
            kind = "SLABS" if i % 2 and j % 2 else "GAPS"
            row = min(j // (2 * rows_per_part), (rows - 1) // rows_per_part) + 1
            tops.setdefault((f"{kind}_{row}", kind), []).append(
                [
                    (x[i], y[j], PAVED_TOP),
                    (x[i + 1], y[j], PAVED_TOP),
                    (x[i + 1], y[j + 1], PAVED_TOP),
                    (x[i], y[j + 1], PAVED_TOP),
                ]
            )
    for (part, kind), quads in tops.items():
        thing.add(part, of.SLAB if kind == "SLABS" else of.TAR, np.array(quads))
    thing.add("BED", of.SLAB, shape.box((x[0], y[0], SUNK), (x[-1], y[-1], PAVED_TOP))[:5])
    return thing


def apron_lines(target):
    """Painted guide lines and stands on the apron."""
    thing, (e, n) = Thing("MARKINGS"), target
    top = PAVED_TOP
    thing.add(
        "LEAD_OUT",
        of.MARKING,
        stripe((e + 14, n - 0.1), (e + 83.7, n + 0.1), top),
        stripe((e + 85.1, n - 0.1), (e + 117, n + 0.1), top),
    )
    thing.add(
        "EDGE",
        of.MARKING,
        stripe((e + 84, n - 86), (e + 84.2, n + 86), top),
        stripe((e + 84.6, n - 86), (e + 84.8, n + 86), top),
    )
    ring = [shape.turned(stripe((-0.85, 7.0), (0.85, 7.25), top), a, 2) for a in range(0, 360, 15)]
    thing.add(
        "HELIPAD",
        of.MARKING,
        *[shape.moved(bar, (e + 52, n - 20, 0)) for bar in ring],
        *[stripe((e + 52 + x, n - 22.5), (e + 52 + x + 0.5, n - 17.5), top) for x in (-1.8, 1.3)],
        stripe((e + 52 - 1.29, n - 20.25), (e + 52 + 1.29, n - 19.75), top),
    )
    thing.add(
        "STANDS",
        of.MARKING,
        *[
            stripe((e + x, n + y - 0.1), (e + x + 9, n + y + 0.1), top)
            for x, y in ((26, 46), (26, 16), (16, -58), (16, -26))
        ],
    )
    return thing


def fence(facets, parts, way):
    """A fence of square posts along a line, with exactly so many facets in so many parts.

    Posts have six facets; as many as needed are three-cornered with five: any sum can be met.
    """
    if facets < 40 or parts < 1 or parts > facets // 6:
        raise ValueError(
            f"{facets} facets and {parts} parts left for the fence, expected 40 and a post a part"
        )
    slim = -facets % 6
    count = (facets - 5 * slim) // 6 + slim
    way = np.asarray(way, float)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))])
    at = np.linspace(0, length[-1], count)
    places = np.stack(
        [np.interp(at, length, way[:, 0]), np.interp(at, length, way[:, 1])], 1
    ).round(1)
    thing = Thing("FENCE")
    for i, (e, n) in enumerate(places):
        post = (
            shape.box((e - 0.06, n - 0.06, -1.8), (e + 0.06, n + 0.06, 1.2))
            if i >= slim
            else shape.prism(
                [(e - 0.06, n - 0.06), (e + 0.06, n - 0.06), (e, n + 0.06)], -1.8, 1.2, 2
            )
        )
        thing.add(f"SECTION_{i * parts // count + 1}", of.BARE_FRAME, post)
    return thing
