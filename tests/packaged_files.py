#!/usr/bin/env python3
"""Reads every mesh and sounding that installed packages bring along, and prints a table of what came of it.

    tests/packaged_files.py [FOLDER ...]

Searches the packages below, where they are installed, and the folders named. `read` means that radsig took a
file, and that its area is trimesh's where that is installed; `refused` that it said why; all else is a failure,
and the exit code is 1."""

import argparse
import importlib.util
import logging
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
RADSIG = ROOT / "build" / "radsig"
ATMOSPHERE = ROOT / "build" / "radsig-atmosphere"
MESHES = {".obj", ".ply", ".stl", ".off"}
LARGEST_BYTES = 20_000_000

FOLDERS = ["/usr/share/assimp/models", "/usr/share/libopenmesh-dev", "/usr/share/doc/libigl-dev"]  # Debian
MODULES = ["trimesh", "pyvista", "open3d", "pymeshlab", "meshio", "vedo", "metpy", "siphon", "sharppy"]  # PyPI
CACHES = ["~/.cache/metpy", "~/.cache/pyvista_3"]  # what they fetch on first use

MESH_SCENE = """name = "packaged"
[site]
latitude_deg = 40.0
longitude_deg = -105.0
time = 2023-06-21T12:00:00-07:00
[atmosphere]
uniform = { sky_temperature_k = 260.0, sky_radiance_w_m2_sr_um = 0.0, sun_irradiance_w_m2_um = 0.0, transmission = 1.0, path_temperature_k = 260.0 }
[[geometry]]
file = '''%s'''
material = "any"
[[material]]
name = "any"
emissivity = 0.9
temperature_k = 300.0
[materials.alias]
"*" = "any"
[camera]
position_m = [0, 0, 5]
target_m = [0, 0, 0]
focal_length_mm = 50
pixels = [8, 8]
[[band]]
name = "lwir"
wavelength_um = [8.0, 13.3]
[render]
thermal = "fixed"
"""
SOUNDING_SCENE = """name = "packaged"
[site]
latitude_deg = 40.0
longitude_deg = -105.0
time = 2023-06-21T12:00:00Z
[camera]
position_m = [0, 0, 9000]
target_m = [0, 0, 0]
focal_length_mm = 50
pixels = [8, 8]
[atmosphere.generate]
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
    """Where packages lie that may hold files."""
    found = [pathlib.Path(folder) for folder in FOLDERS]
    found += [pathlib.Path(folder).expanduser() for folder in CACHES]
    for module in MODULES:
        spec = importlib.util.find_spec(module)
        found += map(pathlib.Path, (spec.submodule_search_locations or []) if spec else [])
    return [folder for folder in found if folder.is_dir()]


def is_sounding(path):
    if path.suffix.lower() not in {".txt", ".csv"} or "sounding" not in path.name.lower():
        return False
    head = path.read_bytes()[:4000]
    return b"PRES" in head or b"pressure" in head.lower() or head[:1] == b"#"


def files(where):
    found = {path.resolve() for folder in where for path in folder.rglob("*")
             if path.is_file() and path.stat().st_size < LARGEST_BYTES and (path.suffix.lower() in MESHES or is_sounding(path))}
    return sorted(found)


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
    said = done.stderr.strip().split("\n")[0]
    named = done.returncode == 1 and path.name in said
    return ("refused" if named else "FAILED"), re.sub(r"^radsig[^:]*: ", "", said)


def check_mesh(path, folder):
    scene = folder / "scene.toml"
    scene.write_text(MESH_SCENE % path)
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
        scene.write_text(SOUNDING_SCENE % (path, ground))
        done = run(ATMOSPHERE, "make", scene, "-o", folder / "out.rad")
        if "raise ground_altitude_m" not in done.stderr:
            break
    return verdict(done, path, True)


def table(where):
    """Rows of name, verdict and reason."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for path in files(where):
            if path.suffix.lower() in MESHES:
                rows.append((path, *check_mesh(path, pathlib.Path(folder))))
            elif ATMOSPHERE.exists():
                rows.append((path, *check_sounding(path, pathlib.Path(folder))))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="*", type=pathlib.Path)
    logging.disable()  # trimesh misses textures
    rows = table([*folders(), *parser.parse_args().folder])

    for path, what, why in rows:
        print(f"{what:8} {path.parent.name + '/' + path.name:50} {why.replace(str(path), path.name)[:150]}")
    count = {what: sum(row[1] == what for row in rows) for what in ("read", "refused", "WRONG", "FAILED")}
    print(", ".join(f"{number} {what}" for what, number in count.items()))
    return 1 if count["WRONG"] or count["FAILED"] else 0


if __name__ == "__main__":
    sys.exit(main())
