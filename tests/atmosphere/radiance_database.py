"""Reads a .rad of any number of paths and directions, in its own units."""

import json

import numpy


def read(path):
    lines = [line for line in open(path) if not line.startswith("#")]
    rows = iter([[float(word) for word in line.split()] for line in lines])
    take = lambda count: numpy.array([next(rows) for _ in range(count)])
    names = ["altitude", "wavelength_min", "wavelength_max", "wavenumber_min", "wavenumber_max", "step", "n",
             "zenith_min", "zenith_max", "zenith_step", "zenith_meaningful", "m"]
    out = {name: next(rows)[0] for name in names}
    n, m = int(out["n"]), int(out["m"])
    out["wavelength"], out["wavenumber"], out["sun"], out["tau1"] = take(n).T
    out["zenith"], out["range"], out["path"] = [], [], []
    for _ in range(m):
        zenith, distance = next(rows)
        out["zenith"].append(zenith)
        out["range"].append(distance)
        out["path"].append(take(n))
    out["path"] = numpy.array(out["path"])
    out["sky"], out["integrated"] = {}, None
    head = next(rows)
    while len(head) == 2:
        if 0 < head[0] < 0.1 or (head[0] == 0 and 0 < head[1] < 0.1):
            out["integrated"] = numpy.array([head, *take(n - 1)])
        else:
            out["sky"][tuple(head)] = take(n)
        head = next(rows)
    out["profile"] = take(int(head[0]))
    assert next(rows, None) is None
    return out


def sky_array(database):
    """Shape (zenith, azimuth, n, 2)."""
    zeniths = sorted({key[0] for key in database["sky"]})
    azimuths = sorted({key[1] for key in database["sky"]})
    return numpy.array([[database["sky"][z, a] for a in azimuths] for z in zeniths])


def read_container(path):
    """The grid, integrated and directional sky of a .radc, W m-2 sr-1 um-1."""
    data = open(path, "rb").read()
    magic, rest = data.split(b"\n", 1)
    assert magic == b"RADSIG ATMOSPHERE 1"
    end = rest.index(b"\n}\n") + 3
    out = json.loads(rest[:end])
    numbers = numpy.frombuffer(rest[end:], "<f4").astype(float)
    n, m = out["point_count"], out["path_count"]
    first = 2 * n + m + 3 * m * n
    sky = out["zenith_count"] * out["azimuth_count"] * n
    out["wavenumber"] = out["wavenumber_max_cm1"] - out["wavenumber_step_cm1"] * numpy.arange(n)
    out["integrated"] = numbers[first : first + 2 * n].reshape(2, n).T
    shape = (out["zenith_count"], out["azimuth_count"], n)
    directions = numbers[first + 2 * n : first + 2 * n + 2 * sky].reshape(2, *shape)
    out["sky"] = numpy.moveaxis(directions, 0, -1)
    at = first + 2 * n + 2 * sky + 2 * out["level_count"]
    targets, ranges = out.get("target_count", 0), out.get("range_count", 0)
    for name, shape in [("target_altitude", (targets,)), ("target_range", (targets, m)), ("target_tau", (targets, m, n)),
                        ("target_emitted", (targets, m, n)), ("target_scattered", (targets, m, n)), ("range", (ranges,)),
                        ("range_tau", (ranges, n)), ("range_emitted", (ranges, n)), ("range_scattered", (ranges, n))]:
        size = int(numpy.prod(shape))
        out[name], at = numbers[at : at + size].reshape(shape), at + size
    assert len(numbers) == at
    out["sun"], out["tau1"] = numbers[:n], numbers[n : 2 * n]
    out["path_tau"], out["path_emitted"], out["path_scattered"] = numbers[2 * n + m : first].reshape(3, m, n)
    return out
