"""Bodies as arrays of facets, shape (facet, 4, 3) in metres, counter-clockwise seen from outside.

A triangle repeats one vertex, so that every body is one array; facet_list() makes it a triangle.
"""

import numpy as np


def box(low, high):
    """Six quads in the order that the 1994 file prints: bottom, west, north, east, south, top."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    clockwise = [
        [(x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)],
        [(x0, y0, z1), (x0, y0, z0), (x0, y1, z0), (x0, y1, z1)],
        [(x0, y1, z1), (x0, y1, z0), (x1, y1, z0), (x1, y1, z1)],
        [(x1, y1, z1), (x1, y1, z0), (x1, y0, z0), (x1, y0, z1)],
        [(x1, y0, z1), (x1, y0, z0), (x0, y0, z0), (x0, y0, z1)],
        [(x0, y0, z1), (x0, y1, z1), (x1, y1, z1), (x1, y0, z1)],
    ]
    return np.array(clockwise, float)[:, ::-1]


def volume(body):
    """Signed: positive when the facets of a closed body look outwards."""
    origin = body[0, 0]
    p = body - origin
    return (
        np.einsum("ij,ij->i", p[:, 0], np.cross(p[:, 1], p[:, 2]))
        + np.einsum("ij,ij->i", p[:, 0], np.cross(p[:, 2], p[:, 3]))
    ).sum() / 6


def outward(body):
    return body[:, ::-1] if volume(body) < 0 else body


def cap(ring):
    """Fills a flat convex ring with quads that run across it."""
    low, high, faces = 0, len(ring) - 1, []
    while high - low >= 2:
        faces.append(ring[[low, low + 1, high - 1, high]])
        low, high = low + 1, high - 1
    return np.array(faces)


def skin(rings):
    """The quads between neighbouring closed rings, rings of shape (ring, point, 3)."""
    a, b = rings[:-1], rings[1:]
    quads = np.stack([a, np.roll(a, -1, 1), np.roll(b, -1, 1), b], 2)
    return quads.reshape(-1, 4, 3)


def loft(rings):
    """A closed body through flat rings of equal length, capped at both ends."""
    rings = np.asarray(rings, float)
    return outward(np.concatenate([skin(rings), cap(rings[0][::-1]), cap(rings[-1])]))


def prism(profile, low, high, axis):
    """A convex profile drawn out along axis 0, 1 or 2; it holds the two other axes in order."""
    rings = np.insert(np.asarray(profile, float), axis, 0, axis=1)
    rings = np.stack([rings, rings])
    rings[0, :, axis], rings[1, :, axis] = low, high
    return loft(rings)


def strip(outline, thickness, low, high, axis, pieces=1):
    """A bent sheet: an open outline with a thickness to its left, drawn out along an axis."""
    outline = np.asarray(outline, float)
    along = np.gradient(outline, axis=0)
    normal = np.stack([-along[:, 1], along[:, 0]], 1) / np.linalg.norm(along, axis=1)[:, None]
    ring = np.concatenate([outline, (outline + thickness * normal)[::-1]])
    rings = np.repeat(np.insert(ring, axis, 0, axis=1)[None], pieces + 1, 0)
    rings[:, :, axis] = np.linspace(low, high, pieces + 1)[:, None]
    return outward(np.concatenate([skin(rings), cap(rings[0][::-1]), cap(rings[-1])]))


def revolve(profile, sides, centre, axis=0):
    """Turns a profile of (position along the axis, radius) rows; radius 0 closes it."""
    turn = (np.arange(sides) + 0.5) * 2 * np.pi / sides
    profile = np.asarray(profile, float)
    rings = np.zeros((len(profile), sides, 3))
    rings[:, :, axis] = profile[:, :1]
    rings[:, :, axis - 2] = profile[:, 1:] * np.cos(turn)
    rings[:, :, axis - 1] = profile[:, 1:] * np.sin(turn)
    return outward(skin(rings + centre))


def tube(start, end, radius, sides=6):
    """A closed round bar between two points."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    along = (end - start) / np.linalg.norm(end - start)
    across = np.cross(along, [0, 0, 1] if abs(along[2]) < 0.9 else [1, 0, 0])
    across /= np.linalg.norm(across)
    up = np.cross(along, across)
    turn = ((np.arange(sides) + 0.5) * 2 * np.pi / sides)[:, None]
    ring = radius * (np.cos(turn) * across + np.sin(turn) * up)
    return loft([start + ring, end + ring])


def rounded(low, high, cut, axis=0):
    """A box whose long edges along an axis are cut off."""
    (a0, b0), (a1, b1) = np.delete(low, axis), np.delete(high, axis)
    profile = [
        (a0 + cut, b0),
        (a1 - cut, b0),
        (a1, b0 + cut),
        (a1, b1 - cut),
        (a1 - cut, b1),
        (a0 + cut, b1),
        (a0, b1 - cut),
        (a0, b0 + cut),
    ]
    return prism(profile, low[axis], high[axis], axis)


def wheel(x, y, radius, width, sides):
    """A tyre that ends a little below the ground: no facet lies in the plane of the slabs."""
    half = width / 2
    profile = [
        (-half * 0.6, 0),
        (-half, radius * 0.62),
        (-half, radius * 0.9),
        (-half * 0.7, radius),
        (half * 0.7, radius),
        (half, radius * 0.9),
        (half, radius * 0.62),
        (half * 0.6, 0),
    ]
    return revolve(profile, sides, (x, y, radius - 0.02), axis=1)


def superellipse(points, half_width, low, high, power, centre=0.0):
    """A closed ring in y and z: an ellipse for power 2, towards a rectangle as it grows."""
    turn = (np.arange(points) + 0.5) * 2 * np.pi / points
    cosine, sine = np.cos(turn), np.sin(turn)
    y = centre + half_width * np.sign(cosine) * np.abs(cosine) ** (2 / power)
    z = (low + high) / 2 + (high - low) / 2 * np.sign(sine) * np.abs(sine) ** (2 / power)
    return np.stack([np.zeros(points), y, z], 1)


def smooth(stations, pieces):
    """Rows between the given ones by a Catmull-Rom curve over the first column."""
    stations = np.asarray(stations, float)
    x = stations[:, 0]
    slope = np.gradient(stations, x, axis=0)
    at = np.concatenate(
        [np.linspace(a, b, pieces, endpoint=False) for a, b in zip(x, x[1:])] + [x[-1:]]
    )
    i = np.clip(np.searchsorted(x, at, "right") - 1, 0, len(x) - 2)
    width = (x[i + 1] - x[i])[:, None]
    t = (at - x[i])[:, None] / width
    return (
        (2 * t**3 - 3 * t**2 + 1) * stations[i]
        + (t**3 - 2 * t**2 + t) * width * slope[i]
        + (3 * t**2 - 2 * t**3) * stations[i + 1]
        + (t**3 - t**2) * width * slope[i + 1]
    )


def panel(root, tip, thickness, chord_points, pieces=1):
    """A wing with a biconvex section; root and tip are (leading edge, trailing edge) points."""
    (root_front, root_back), (tip_front, tip_back) = np.asarray(root, float), np.asarray(tip, float)
    t = (1 - np.cos(np.linspace(0, np.pi, chord_points)))[:, None] / 2
    up = np.cross(root_back - root_front, tip_front - root_front)
    up /= np.linalg.norm(up)
    rings = []
    for share in np.linspace(0, 1, pieces + 1):
        front, back = (
            root_front + share * (tip_front - root_front),
            root_back + share * (tip_back - root_back),
        )
        half = 2 * thickness * np.linalg.norm(back - front) * t * (1 - t) * up
        middle = front + t * (back - front)
        rings.append(np.concatenate([middle + half, (middle - half)[-2:0:-1]]))
    return loft(rings)


def moved(body, by):
    return body + np.asarray(by, float)


def mirrored(body):
    """The same body on the other side of y = 0."""
    return (body * [1, -1, 1])[:, ::-1]


def turned(body, angle_deg, axis, about=(0, 0, 0)):
    """Turned right-handed about an axis 0, 1 or 2 through a point."""
    a, about = np.radians(angle_deg), np.asarray(about, float)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    turn = np.eye(3)
    turn[j, j] = turn[k, k] = np.cos(a)
    turn[k, j], turn[j, k] = np.sin(a), -np.sin(a)
    return (body - about) @ turn.T + about


def area_vectors(facets):
    """Right-handed, their length the area; shape (facet, 3)."""
    return np.cross(facets[:, 2] - facets[:, 0], facets[:, 3] - facets[:, 1]) / 2


def warps(facets):
    """How far the diagonals pass each other: 0 where a facet is flat."""
    area = area_vectors(facets)
    size = np.maximum(np.linalg.norm(area, axis=1), 1e-30)
    return np.abs(np.einsum("ij,ij->i", area, facets[:, 1] - facets[:, 0])) / size


def tidy(facets, warp_limit_m):
    """Facets as a file may hold them, and the row that each comes from.

    Triangles repeat their third vertex; quads that are warped by more than the limit become two
    triangles along the shorter diagonal; what is smaller than a square millimetre goes.
    """
    row = np.arange(len(facets))
    same = (facets == np.roll(facets, -1, 1)).all(2)
    turn = np.where(same.any(1), (same.argmax(1) + 2) % 4, 0)
    facets = np.take_along_axis(facets, ((turn[:, None] + np.arange(4)) % 4)[..., None], 1)
    split = ~same.any(1) & (warps(facets) > warp_limit_m)
    quads = facets[split]
    diagonals = np.linalg.norm(quads[:, :2] - quads[:, 2:], axis=2)
    along = (diagonals[:, 0] <= diagonals[:, 1])[:, None, None]
    first = np.where(along, quads[:, [0, 1, 2, 2]], quads[:, [0, 1, 3, 3]])
    second = np.where(along, quads[:, [0, 2, 3, 3]], quads[:, [1, 2, 3, 3]])
    facets = np.concatenate([facets[~split], first, second])
    row = np.concatenate([row[~split], row[split], row[split]])
    keep = np.linalg.norm(area_vectors(facets), axis=1) >= 1e-6
    order = np.argsort(row[keep], kind="stable")
    return facets[keep][order], row[keep][order]
