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


def orientations(facets):
    """Area vectors that look out; slopes from level, azimuths clockwise from north, in degrees."""
    area = 0.0 - shape.area_vectors(facets)
    north, west, up = area.T
    level = np.hypot(north, west)
    azimuth = np.where(level > 1e-9 * np.abs(up), np.degrees(np.arctan2(-west, north)) % 360, 0.0)
    return area, np.degrees(np.arctan2(level, up)), azimuth


def last_numbers(slope_deg):
    """The number that closes a facet. Only two values are printed: 0 facing down and .25 on a wall.

    assumed: the square of the share of the dome above the facet's plane, which is 1 facing up.
    """
    return ((1 + np.cos(np.radians(slope_deg))) / 2) ** 2


def part_facets(contents):
    """The facets of a part in the axes of the file, and the surface of each."""
    surfaces = [surface for surface, body in contents for _ in body]
    bodies = np.concatenate([body for _, body in contents])
    facets, rows = shape.tidy(file_axes(bodies), WARP_LIMIT_M)
    return facets, [surfaces[row] for row in rows]


def face_name(thing, part, surface):
    """RUNWAY2_RUNWAY, GRASS: object, part where there are several, attribute where it says more."""
    attribute = surface.attribute.upper()
    names = [thing.name, part, attribute if attribute != thing.name else ""]
    return "_".join(name for name in names if name)


def facet_text(names, surface, code, vertices, looks):
    """One facet: its name and number; its area vector, slope, azimuth and last number."""
    if (vertices[2] == vertices[3]).all():
        vertices = vertices[:3]
    lines = ["FACE", *names, surface.material, f"{code}", surface.attribute, "-1"]
    lines += [f"{surface.thickness_cm:g}", f"{surface.power_ly_h:g}", "1.0", "null", "null", "null"]
    lines += [
        f"{len(vertices)}",
        *["%.6e %.6e %.6e" % tuple(vertex) for vertex in vertices.tolist()],
    ]
    lines.append("%.20e %.20e %.20e\n%.6e\n%.6e\n%.6e\n" % tuple(looks))
    return "\n".join(lines)


def write(path, things, codes):
    """Writes all objects; returns the counts of objects, parts and facets."""
    parts = facets = 0
    with open(path, "w", encoding="ascii", newline="\n") as file:
        for i, thing in enumerate(things, 1):
            file.write(f"OBJECT\n{thing.name}_OBJ\n{i}-0-0\n")
            for j, (part, contents) in enumerate(thing.parts.items(), 1):
                stem = f"{thing.name}_{part}" if part else thing.name
                file.write(f"PART\n{stem}_ATTS\n{i}-{j}-0\n")
                polygons, surfaces = part_facets(contents)
                area, slope, azimuth = orientations(polygons)
                looks = np.column_stack([area, slope, azimuth, last_numbers(slope)]).tolist()
                for k, surface in enumerate(surfaces):
                    names = f"{face_name(thing, part, surface)}_{k + 1}", f"{i}-{j}-{k + 1}"
                    code = codes[surface.material]
                    file.write(facet_text(names, surface, code, polygons[k], looks[k]))
                parts, facets = parts + 1, facets + len(surfaces)
    return len(things), parts, facets
