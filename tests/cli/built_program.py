"""The built program, and small scenes for it."""
import copy
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
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
