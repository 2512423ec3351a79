"""Inputs that tests and benches share: meshes as (corner, position).

corner: uint32, shape (facets, 4), counter-clockwise from outside, the fourth NO_CORNER for a
triangle;
position: float32, shape (vertices, 3), metres.
"""
import numpy as np

NO_CORNER = 0xFFFFFFFF


def mesh(position, faces):
    """Joins lists of positions and of faces of three or four corners."""
    corner = np.full((len(faces), 4), NO_CORNER, np.uint32)
    for row, face in zip(corner, faces):
        row[: len(face)] = face
    return corner, np.asarray(position, np.float32).reshape(-1, 3)


def join(*meshes):
    """Puts meshes into one; facets keep their order."""
    corners, positions, first = [], [], 0
    for corner, position in meshes:
        moved = corner + np.uint32(first)
        moved[corner == NO_CORNER] = NO_CORNER
        corners.append(moved)
        positions.append(position)
        first += len(position)
    return np.concatenate(corners).astype(np.uint32), np.concatenate(positions)


def icosphere(levels, radius=1.0, centre=(0.0, 0.0, 0.0)):
    """A closed sphere of 20 * 4**levels triangles; five levels make 20,480."""
    g = (1 + 5**0.5) / 2
    position = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g)]
    position += [(0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    position = [np.array(p) / np.linalg.norm(p) for p in position]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4)]
    faces += [(11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8)]
    faces += [(3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(levels):
        middle, finer = {}, []
        for a, b, c in faces:
            corners = []
            for i, j in ((a, b), (b, c), (c, a)):
                key = (min(i, j), max(i, j))
                if key not in middle:
                    between = position[i] + position[j]
                    position.append(between / np.linalg.norm(between))
                    middle[key] = len(position) - 1
                corners.append(middle[key])
            ab, bc, ca = corners
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    return mesh(np.array(position) * radius + np.array(centre), faces)


def triangle_soup(count, seed, size=0.3):
    """Triangles anywhere in the box of +-1, each within `size`."""
    random = np.random.default_rng(seed)
    centre = random.uniform(-1, 1, (count, 1, 3))
    position = centre + random.uniform(-size, size, (count, 3, 3))
    return mesh(position, [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(count)])


def box(low=(0.0, 0.0, 0.0), high=(1.0, 1.0, 1.0)):
    """Six quads: bottom, top, south, north, west, east."""
    position = [[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return mesh(position, faces)


def plane(half_width, z=0.0):
    """One level quad that faces up."""
    w = half_width
    return mesh([(-w, -w, z), (w, -w, z), (w, w, z), (-w, w, z)], [(0, 1, 2, 3)])


def ring(radius, elevation_deg, count=360):
    """A level ring of upright quads around the origin that fills elevations 0 to `elevation_deg` as
    seen from there; the wall's foot is sunk a little so that it starts below the horizon."""
    angle = np.arange(count) * 2 * np.pi / count
    apothem = radius * np.cos(np.pi / count)
    top = 0.5 * (radius + apothem) * np.tan(np.radians(elevation_deg))
    flat = np.stack([radius * np.cos(angle), radius * np.sin(angle)], 1)
    low = np.column_stack([flat, np.full(count, -0.1 * radius)])
    high = np.column_stack([flat, np.full(count, top)])
    after = lambda i: (i + 1) % count
    faces = [(i, after(i), count + after(i), count + i) for i in range(count)]
    return mesh(np.concatenate([low, high]), faces)


def triangles(corner, position):
    """Cuts quads along 0-2: (vertices float64 (n, 3, 3), facet (n))."""
    quad = np.flatnonzero(corner[:, 3] != NO_CORNER)
    index = np.concatenate([corner[:, [0, 1, 2]], corner[quad][:, [0, 2, 3]]])
    facet = np.concatenate([np.arange(len(corner)), quad])
    return position.astype(np.float64)[index], facet
