"""What the scripts share that read all files which installed packages bring along."""

import argparse
import importlib.util
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
RADSIG = ROOT / "build" / "radsig"
LARGEST_BYTES = 20_000_000

SITE = """name = "packaged"
[site]
latitude_deg = {latitude:.5f}
longitude_deg = {longitude:.5f}
time = {time}
"""
CAMERA = """[camera]
position_m = [0, 0, {height_m}]
target_m = [0, 0, 0]
focal_length_mm = 50
pixels = [8, 8]
"""
UNIFORM_SKY = """[atmosphere]
uniform = { sky_temperature_k = 260.0, sky_radiance_w_m2_sr_um = 0.0, sun_irradiance_w_m2_um = 0.0, transmission = 1.0, path_temperature_k = 260.0 }
"""


def mesh_scene(site, mesh, material, thermal, more=""):
    """A scene of one mesh, whose material `any` has the keys in `material`, under an even sky.
    `site`: (latitude, longitude, time)."""
    latitude, longitude, time = site
    return (SITE.format(latitude=latitude, longitude=longitude, time=time) + more + UNIFORM_SKY
            + f"[[geometry]]\nfile = '''{mesh}'''\nmaterial = \"any\"\n[[material]]\nname = \"any\"\nemissivity = 0.9\n{material}\n"
            + CAMERA.format(height_m=5) + '[[band]]\nname = "lwir"\nwavelength_um = [8.0, 13.3]\n'
            + f'[render]\nthermal = "{thermal}"\n')


def folders(packages, others):
    """Where Python packages lie, and other folders, that are there."""
    found = [pathlib.Path(folder).expanduser() for folder in others]
    for package in packages:
        spec = importlib.util.find_spec(package)
        found += map(pathlib.Path, (spec.submodule_search_locations or []) if spec else [])
    return [folder for folder in found if folder.is_dir()]


def files(where, is_one):
    return sorted({path.resolve() for folder in where for path in folder.rglob("*")
                   if path.is_file() and path.stat().st_size < LARGEST_BYTES and is_one(path)})


def refusal(done, path):
    """(verdict, reason) of a run that failed."""
    said = done.stderr.strip().split("\n")
    line = next((line for line in said if path.name in line and "warning:" not in line), said[-1])
    named = done.returncode == 1 and path.name in line
    return ("refused" if named else "FAILED"), re.sub(r"^radsig[^:]*: ", "", line)


def main(description, table, where):
    """Prints the table of all files in `where` and in the folders that the command line names; `table` gives rows
    of path, what was tried, verdict, reason. Exits with 1 if a verdict is neither `read` nor `refused`."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="*", type=pathlib.Path)
    rows = table([*where, *parser.parse_args().folder])
    for path, tried, what, why in rows:
        print(f"{what:8} {path.name[:44]:44} {tried:12} {why.replace(str(path), path.name)[:200]}")
    count = {what: sum(row[2] == what for row in rows) for what in ("read", "refused", "WRONG", "FAILED")}
    print(", ".join(f"{number} {what}" for what, number in count.items()))
    sys.exit(1 if count["WRONG"] or count["FAILED"] else 0)
