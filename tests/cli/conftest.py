"""What the tests of the built program share: running it, writing small scenes, and radiances in
double precision to compare with."""
import copy
import json
import os
import pathlib
import subprocess
import types

import numpy as np
import pytest
import envi

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RADSIG = ROOT / os.environ.get("RADSIG", "build/radsig")
AIRPORT = ROOT / "scenes" / "airport"

VACUUM = {"sky_temperature_k": 1.0, "sky_radiance_w_m2_sr_um": 0.0, "sun_irradiance_w_m2_um": 0.0,
          "transmission": 1.0, "path_temperature_k": 1.0}

# A level plane of 100 m seen straight down; the picture's top is north.
SCENE = {
    "name": "plane",
    "site": {"latitude_deg": 40.0, "longitude_deg": -80.0, "time": "1992-06-21T13:20:00-04:00"},
    "atmosphere": {"uniform": VACUUM},
    "geometry": [{"file": "plane.obj"}],
    "material": [{"name": "wall", "emissivity": 1.0, "temperature_k": 300.0}],
    "camera": {"position_m": [0.0, 0.0, 60.0], "target_m": [0.0, 0.0, 0.0],
               "focal_length_mm": 85.0, "pixels": [8, 6]},
    "band": [{"name": "lwir", "wavelength_um": [8.0, 14.0]}],
    "render": {"thermal": "fixed"},
}

PLANE = "usemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"


def radsig(*arguments, **options):
    """Runs the program; returns what subprocess.run does."""
    options = {"capture_output": True, "text": True, "timeout": 300, **options}
    return subprocess.run([RADSIG, *map(str, arguments)], **options)


def toml_value(value, key=""):
    if key == "time":
        return value
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml_value(v, k)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    if isinstance(value, float):
        return repr(float(value))
    return json.dumps(value)


def toml_text(scene):
    """The scene as a file: single values first, then tables, then arrays of tables."""
    lines = []
    for key, value in sorted(scene.items(), key=lambda item: isinstance(item[1], (dict, list))):
        if not isinstance(value, (dict, list)):
            lines.append(f"{key} = {toml_value(value, key)}")
            continue
        for table in value if isinstance(value, list) else [value]:
            lines.append(f"[[{key}]]" if isinstance(value, list) else f"[{key}]")
            lines += [f"{k} = {toml_value(v, k)}" for k, v in table.items()]
    return "\n".join(lines) + "\n"


def write_scene(folder, meshes=None, **changes):
    """Writes SCENE with changes and its meshes (text by file name); returns the path.
    A change of a table adds to it or, with None, takes a key away; of anything else it replaces."""
    scene = copy.deepcopy(SCENE)
    for key, value in changes.items():
        if isinstance(value, dict) and "uniform" not in value and key != "atmosphere":
            table = {**scene.get(key, {}), **value}
            scene[key] = {k: v for k, v in table.items() if v is not None}
        else:
            scene[key] = value
    for name, text in (meshes or {"plane.obj": PLANE}).items():
        (folder / name).write_text(text)
    path = folder / "scene.toml"
    path.write_text(toml_text(scene))
    return path


def load(folder, name="plane"):
    """What a render wrote: cube and truth planes by name, both headers, the report."""
    header, planes = envi.read(folder / name)
    truth = folder / f"{name}_truth.hdr"
    truth_header, truth_planes = envi.read(folder / f"{name}_truth") if truth.exists() else ({}, {})
    report = json.loads((folder / f"{name}.json").read_text())
    return types.SimpleNamespace(folder=folder, header=header, truth_header=truth_header,
                                 planes={**planes, **truth_planes}, report=report)


def render(folder, *options, meshes=None, **changes):
    """Writes a scene and renders it; returns what `load` does."""
    out = folder / "out"
    done = radsig("render", write_scene(folder, meshes, **changes), "-o", out, *options)
    assert done.returncode == 0, done.stderr
    return load(out)


def planck(wavelength_um, temperature_k, first=1.191042972397188e8, second=1.438776877e4):
    """Spectral radiance of a black body, W m-2 sr-1 um-1. The constants are 2 h c^2 and h c / k of
    CODATA 2018."""
    return first / (wavelength_um**5 * np.expm1(second / (wavelength_um * temperature_k)))


def integral(function, low_um, high_um):
    """Gauss-Legendre, 200 points: exact to double precision for Planck's law over a band."""
    x, weight = np.polynomial.legendre.leggauss(200)
    half = 0.5 * (high_um - low_um)
    return half * np.sum(weight * function(low_um + half * (x + 1)))


def band_planck(low_um, high_um, temperature_k, **constants):
    return integral(lambda um: planck(um, temperature_k, **constants), low_um, high_um)


class Database:
    """A .rad file read by itself, W m-2 sr-1 um-1, linear between its points; bands integrated on a
    wavenumber grid of .01 cm-1."""

    def __init__(self, path):
        words = [line.split() for line in path.read_text().splitlines()
                 if line.strip() and not line.startswith("#")]
        rows = iter(words)
        heading = [float(next(rows)[0]) for _ in range(12)]
        points, paths = int(heading[6]), int(heading[11])

        def block():
            return np.array([next(rows) for _ in range(points)], float)

        sun = block()
        self.wavenumber_cm1 = sun[:, 1]
        self.sun = 1e4 * sun[:, 2] * sun[:, 3]  # E_S tau1
        self.path_zenith_deg, self.tau2, self.path = [], [], []
        for _ in range(paths):
            self.path_zenith_deg.append(float(next(rows)[0]))
            values = block()
            self.tau2.append(values[:, 0])
            self.path.append(1e4 * (values[:, 1] + values[:, 2]))
        self.sky = 1e4 * block().sum(axis=1)
        self.direction = np.empty((7, 13, points))
        for i in range(7):
            for k in range(13):
                angles = [float(x) for x in next(rows)]
                assert angles == [15.0 * i, 30.0 * k]
                self.direction[i, k] = 1e4 * block().sum(axis=1)

    def grid(self, low_um, high_um):
        """Wavelengths of the band, ascending, and the database's points as a function on them."""
        high, low = 1e4 / low_um, 1e4 / high_um
        wavenumber = np.linspace(high, low, int((high - low) * 100))
        order = self.wavenumber_cm1[::-1]

        def look_up(values):
            return np.interp(wavenumber, order, values[::-1])

        return 1e4 / wavenumber, look_up

    def path_at(self, zenith_deg):
        """tau2 and path radiance at a zenith angle."""
        place = np.interp(zenith_deg, self.path_zenith_deg, range(len(self.path_zenith_deg)))
        low = min(int(place), len(self.path_zenith_deg) - 2)
        share = place - low
        return [(1 - share) * a[low] + share * a[low + 1] for a in (self.tau2, self.path)]

    def sky_at(self, direction):
        """Radiance of the sky in a direction (east, north, up), linear in zenith and azimuth."""
        x, y, z = np.asarray(direction, float) / np.linalg.norm(direction)
        zenith = np.degrees(np.arccos(z)) / 15
        azimuth = np.degrees(np.arctan2(x, y)) % 360 / 30
        i, k = min(int(zenith), 5), min(int(azimuth), 11)
        u, v = zenith - i, azimuth - k
        d = self.direction
        return ((1 - u) * (1 - v) * d[i, k] + u * (1 - v) * d[i + 1, k]
                + (1 - u) * v * d[i, k + 1] + u * v * d[i + 1, k + 1])


def pixel_directions(position_m, target_m, focal_length_mm, pixels):
    """Unit directions of the pixels, shape (rows, columns, 3): pinhole, 36 mm across the columns,
    up in the picture is up in the world, or north where the camera looks straight down."""
    sight = np.subtract(target_m, position_m).astype(float)
    sight /= np.linalg.norm(sight)
    level = np.hypot(*sight[:2]) > 0
    right = np.cross(sight, [0, 0, 1] if level else [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, sight)
    columns, rows = pixels
    pixel = 36 / focal_length_mm / columns
    across = (np.arange(columns) + 0.5 - columns / 2) * pixel
    upward = (rows / 2 - np.arange(rows) - 0.5) * pixel
    directions = sight + across[None, :, None] * right + upward[:, None, None] * up
    return directions / np.linalg.norm(directions, axis=2, keepdims=True)


@pytest.fixture(scope="session")
def program():
    """The helpers of this file, and the path of the program."""
    return types.SimpleNamespace(
        path=RADSIG, root=ROOT, airport=AIRPORT, scene=SCENE, plane=PLANE, vacuum=VACUUM,
        run=radsig, write_scene=write_scene, render=render, load=load)


@pytest.fixture(scope="session")
def radiance():
    """What is compared with, in double precision."""
    return types.SimpleNamespace(planck=planck, integral=integral, band_planck=band_planck,
                                 Database=Database, pixel_directions=pixel_directions)


@pytest.fixture(scope="session")
def database():
    """The airport's radiance database."""
    return Database(AIRPORT / "june24_1500z.rad")


@pytest.fixture(scope="session")
def airport():
    """The airport's scene file; its geometry and emissivities are generated, not in git."""
    if not (AIRPORT / "airport.gdb").exists() or not (AIRPORT / ".geometry").exists():
        pytest.skip("scenes/airport is not generated: make scenes")
    return AIRPORT / "scene.toml"
