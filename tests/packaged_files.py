#!/usr/bin/env python3
"""Reads every mesh and sounding that installed packages bring along, and prints a table of what came of it.

    tests/packaged_files.py [FOLDER ...]

Searches the packages below, where they are installed, and the folders named. `read` means that radsig took a
file, and that its area is trimesh's where that is installed; `refused` that it said why; all else is a failure,
and the exit code is 1."""

import logging
import pathlib
import re
import subprocess
import tempfile

import packaged
from packaged import RADSIG, refusal

ATMOSPHERE = packaged.ROOT / "build" / "radsig-atmosphere"
MESHES = {".obj", ".ply", ".stl", ".off"}

FOLDERS = ["/usr/share/assimp/models", "/usr/share/libopenmesh-dev", "/usr/share/doc/libigl-dev"]  # Debian
MODULES = ["trimesh", "pyvista", "open3d", "pymeshlab", "meshio", "vedo", "metpy", "siphon", "sharppy"]  # PyPI
CACHES = ["~/.cache/metpy", "~/.cache/pyvista_3"]  # what they fetch on first use

SITE = (40.0, -105.0, "2023-06-21T12:00:00Z")
GENERATE = """[atmosphere.generate]
model = "us-standard-1976"
radiosonde = '''%s'''
ground_altitude_m = %s
sensor_altitude_m = 9000
wavenumber_cm1 = [800, 900]
wavenumber_step_cm1 = 100
sample_step_cm1 = 100
sky_step_deg = { zenith = 45, azimuth = 180 }
path_zenith_deg = [0, 0, 1]
"""


def folders():
    return packaged.folders(MODULES, FOLDERS + CACHES)


def mesh_scene(mesh):
    return packaged.mesh_scene(SITE, mesh, "temperature_k = 300.0", "fixed", '[materials.alias]\n"*" = "any"\n')


def sounding_scene(sounding, ground_m):
    latitude, longitude, time = SITE
    return (packaged.SITE.format(latitude=latitude, longitude=longitude, time=time) + packaged.CAMERA.format(height_m=9000)
            + GENERATE % (sounding, ground_m))


def is_sounding(path):
    if path.suffix.lower() not in {".txt", ".csv"} or "sounding" not in path.name.lower():
        return False
    head = path.read_bytes()[:4000]
    return b"PRES" in head or b"pressure" in head.lower() or head[:1] == b"#"


def files(where):
    return packaged.files(where, lambda path: path.suffix.lower() in MESHES or is_sounding(path))


def run(program, *arguments):
    try:
        return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, errors="replace", timeout=120)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(arguments, 124, "", "more than 120 s")


def has_polygons(path):
    """Whether an OBJ has faces of more than three corners."""
    return path.suffix.lower() == ".obj" and any(len(line.split()) > 4 for line in path.read_bytes().split(b"\n") if line[:2] == b"f ")


def area_of(path, facets):
    """By trimesh, for triangles alone, as it cuts polygons without looking whether they are concave; else None."""
    if has_polygons(path):
        return None
    try:
        import trimesh
        mesh = trimesh.load(path, force="mesh", process=False)
        return float(mesh.area) if len(mesh.faces) == facets else None
    except Exception:
        return None


def verdict(done, path, right):
    if done.returncode == 0:
        warning = [line for line in re.findall(r"warning: (.*)", done.stderr) if 'alias "*"' not in line]
        return ("read" if right else "WRONG"), warning[0] if warning else ""
    return refusal(done, path)


def check_mesh(path, folder):
    scene = folder / "scene.toml"
    scene.write_text(mesh_scene(path))
    done = run(RADSIG, "check", scene)
    told = re.search(r"^geometry .* (\d+) facets, (\S+) m2", done.stdout, re.M)
    expected = area_of(path, int(told[1])) if told else None
    right = expected is None or abs(float(told[2]) - expected) <= 1e-3 * expected
    what, why = verdict(done, path, right)
    return what, why or (f"{told[1]} facets, {told[2]} m2" + ("" if right else f", trimesh: {expected:g}")) if told else why


def check_sounding(path, folder):
    scene = folder / "scene.toml"
    done = None
    for ground in (0, 500, 1500, 3000):
        scene.write_text(sounding_scene(path, ground))
        done = run(ATMOSPHERE, "make", scene, "-o", folder / "out.rad")
        if "raise ground_altitude_m" not in done.stderr:
            break
    return verdict(done, path, True)


def table(where):
    """Rows of path, what it is, verdict and reason."""
    logging.disable()  # trimesh misses textures
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for path in files(where):
            if path.suffix.lower() in MESHES:
                rows.append((path, path.suffix.lower(), *check_mesh(path, pathlib.Path(folder))))
            elif ATMOSPHERE.exists():
                rows.append((path, "sounding", *check_sounding(path, pathlib.Path(folder))))
    return rows


if __name__ == "__main__":
    packaged.main(__doc__, table, folders())
