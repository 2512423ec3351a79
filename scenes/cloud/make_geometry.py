#!/usr/bin/env python3
"""Builds the cloud scene: make_geometry.py [FOLDER], by default this file's.

field.obj: a checker of 7 x 7 fields of 400 m in three materials, and a road; cumulus.obj and
veil.obj: ellipsoids above it, of a material each. Metres, east, north, up."""

import math
import pathlib
import sys

FIELD_M, FIELDS = 400.0, 7
MATERIALS = ["summergrass", "soil", "summergrass", "corn_field"]
ROAD_HALF_M, ROAD_TOP_M = 15.0, 0.05
RINGS, SECTORS = 24, 48


def quad(first):
    return f"f {first} {first + 1} {first + 2} {first + 3}"


def corners(west, south, east, north, up):
    return [f"v {x} {y} {up}" for x, y in
            ((west, south), (east, south), (east, north), (west, north))]


def field():
    lines, count, edge = [], 0, 0.5 * FIELDS * FIELD_M
    for row in range(FIELDS):
        for column in range(FIELDS):
            west, south = column * FIELD_M - edge, row * FIELD_M - edge
            lines += [f"usemtl {MATERIALS[(2 * row + 3 * column) % len(MATERIALS)]}"]
            lines += corners(west, south, west + FIELD_M, south + FIELD_M, 0.0)
            lines += [quad(count + 1)]
            count += 4
    lines += ["usemtl asphalt"]
    lines += corners(-edge, -ROAD_HALF_M, edge, ROAD_HALF_M, ROAD_TOP_M) + [quad(count + 1)]
    return lines


def ellipsoid(material, centre, half):
    """Poles are the first and the last vertex; sectors run counter-clockwise seen from above."""
    lines = [f"usemtl {material}"]
    points = [(0.0, 0.0, -1.0)]
    for ring in range(1, RINGS):
        down = math.pi * (1 - ring / RINGS)
        for sector in range(SECTORS):
            angle = 2 * math.pi * sector / SECTORS
            points.append((math.sin(down) * math.cos(angle), math.sin(down) * math.sin(angle),
                           math.cos(down)))
    points.append((0.0, 0.0, 1.0))
    lines += ["v " + " ".join(f"{c + h * p:.4f}" for c, h, p in zip(centre, half, point))
              for point in points]
    at = lambda ring, sector: 2 + (ring - 1) * SECTORS + sector % SECTORS
    for sector in range(SECTORS):
        lines.append(f"f 1 {at(1, sector + 1)} {at(1, sector)}")
        lines.append(f"f {len(points)} {at(RINGS - 1, sector)} {at(RINGS - 1, sector + 1)}")
        for ring in range(1, RINGS - 1):
            lines.append(f"f {at(ring, sector)} {at(ring, sector + 1)} "
                         f"{at(ring + 1, sector + 1)} {at(ring + 1, sector)}")
    return lines


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent
    made = {"field": field(),
            "cumulus": ellipsoid("cumulus", (500.0, 200.0, 1000.0), (280.0, 200.0, 90.0)),
            "veil": ellipsoid("veil", (-350.0, -650.0, 400.0), (220.0, 160.0, 40.0))}
    for name, lines in made.items():
        (folder / f"{name}.obj").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
