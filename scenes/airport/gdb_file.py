"""The 1994 geometry file: objects, parts and facets as thesis Appendix A, item 3, prints them.

The scene is built east, north, up. The file has +x north, +y west and lists the vertices clockwise
seen from outside, while the area vector printed with them looks out; both turns are made here and
nowhere else.
"""

import numpy as np

import shape

# Two roundings of .1 mm, the last printed digit of places between 100 and 1000 m.
WARP_LIMIT_M = 2e-4


class Surface:
    """What a facet is made of: the attributes that the file gives every facet."""

    def __init__(self, material, attribute, thickness_cm, power_ly_h=0.0):
        self.material, self.attribute = material, attribute
        self.thickness_cm, self.power_ly_h = thickness_cm, power_ly_h


class Thing:
    """An object: named parts, each a list of (surface, body)."""

    def __init__(self, name):
        self.name, self.parts = name, {}

    def add(self, part, surface, *bodies):
        self.parts.setdefault(part, []).extend((surface, body) for body in bodies)

    def place(self, east, north, height, heading_deg):
        """From x forward, y left, z up to east, north, up; the heading is clockwise from north."""
        for contents in self.parts.values():
            contents[:] = [
                (
                    surface,
                    shape.moved(shape.turned(body, 90 - heading_deg, 2), (east, north, height)),
                )
                for surface, body in contents
            ]
        return self


def read_codes(path):
    """Material codes by name from a materials database: a count, then records of eleven lines."""
    lines = path.read_text(encoding="ascii").split()
    if len(lines) != 1 + 11 * int(lines[0]):
        raise ValueError(
            f"{path}:1: count {lines[0]} and {len(lines)} lines, expected eleven lines a record"
        )
    return {name: int(code) for name, code in zip(lines[1::11], lines[2::11], strict=True)}


def file_axes(body):
    """North, west, up, clockwise seen from outside, rounded to the seven digits of the file."""
    clockwise = np.stack([body[..., 1], -body[..., 0], body[..., 2]], -1)[:, ::-1] + 0.0
    magnitude = np.floor(np.log10(np.maximum(np.abs(clockwise), 1e-3)))
    scale = 10.0 ** (6 - magnitude)
    return np.round(clockwise * scale) / scale


def orientation(vertices):
    """Area vector that looks out, slope from level and azimuth clockwise from north, in degrees."""
    area = -np.cross(vertices[2] - vertices[0], vertices[-1] - vertices[1]) / 2 + 0.0
    level = np.hypot(area[0], area[1])
    slope = np.degrees(np.arctan2(level, area[2]))
    azimuth = (
        np.degrees(np.arctan2(-area[1], area[0])) % 360 if level > 1e-9 * abs(area[2]) else 0.0
    )
    return area, slope, azimuth


def last_number(slope_deg):
    """The number that closes a facet. Only two values are printed: 0 facing down and .25 on a wall.

    assumed: the square of the share of the dome above the facet's plane, which is 1 facing up.
    """
    return ((1 + np.cos(np.radians(slope_deg))) / 2) ** 2


def facet_text(name, number, surface, code, vertices):
    area, slope, azimuth = orientation(vertices)
    lines = [
        "FACE",
        name,
        number,
        surface.material,
        str(code),
        surface.attribute,
        "-1",
        f"{surface.thickness_cm:g}",
        f"{surface.power_ly_h:g}",
        "1.0",
        "null",
        "null",
        "null",
        str(len(vertices)),
    ]
    lines += ["%.6e %.6e %.6e" % tuple(vertex) for vertex in vertices]
    lines += [
        "%.20e %.20e %.20e" % tuple(area),
        "%.6e" % slope,
        "%.6e" % azimuth,
        "%.6e" % last_number(slope),
    ]
    return "\n".join(lines)


def part_facets(contents):
    """All (surface, vertices) of a part in the axes of the file."""
    return [
        (surface, vertices)
        for surface, body in contents
        for vertices in shape.facet_list(file_axes(body), WARP_LIMIT_M)
    ]


def face_stem(thing, part, surface):
    """RUNWAY2_RUNWAY, GRASS: object, part where there are several, attribute where it says more."""
    attribute = surface.attribute.upper()
    names = (
        [thing.name] + ([part] if part else []) + ([attribute] if attribute != thing.name else [])
    )
    return "_".join(names)


def write(path, things, codes):
    """Writes all objects; returns the counts of objects, parts and facets."""
    parts = facets = 0
    with open(path, "w", encoding="ascii", newline="\n") as file:
        for i, thing in enumerate(things, 1):
            file.write(f"OBJECT\n{thing.name}_OBJ\n{i}-0-0\n")
            for j, (part, contents) in enumerate(thing.parts.items(), 1):
                stem = f"{thing.name}_{part}" if part else thing.name
                file.write(f"PART\n{stem}_ATTS\n{i}-{j}-0\n")
                for k, (surface, vertices) in enumerate(part_facets(contents), 1):
                    name = f"{face_stem(thing, part, surface)}_{k}"
                    file.write(
                        facet_text(name, f"{i}-{j}-{k}", surface, codes[surface.material], vertices)
                        + "\n"
                    )
                parts, facets = parts + 1, facets + k
    return len(things), parts, facets
