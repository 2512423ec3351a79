"""What the tests of the preview share: the helpers of tests/cli, and scripts that do what a person
would."""
import importlib.util
import os
import pathlib
import subprocess
import types

import pytest

HERE = pathlib.Path(__file__).resolve().parent

_spec = importlib.util.spec_from_file_location("cli", HERE.parent / "cli" / "conftest.py")
cli = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(cli)
program, airport = cli.program, cli.airport

# A wall on a plane, seen from the south-east: its parts differ in temperature.
WALL = ("o yard\ng ground\nusemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
        "o shed\ng front\nusemtl tin\nv -8 0 0\nv 8 0 0\nv 8 0 12\nv -8 0 12\nf 5 6 7 8\n")

SCENE = {
    "meshes": {"wall.obj": WALL},
    "geometry": [{"file": "wall.obj"}],
    "material": [{"name": "wall", "emissivity": 0.9, "temperature_k": 300.0},
                 {"name": "tin", "emissivity": 0.5, "temperature_k": 320.0, "two_sided": True}],
    "atmosphere": {"uniform": {**cli.VACUUM, "sky_temperature_k": 260.0,
                               "sun_irradiance_w_m2_um": 2.0}},
    "camera": {"position_m": [20.0, -40.0, 30.0], "focal_length_mm": 35.0, "pixels": [64, 48]},
    "band": [{"name": "lwir", "wavelength_um": [8.0, 14.0]},
             {"name": "mwir", "wavelength_um": [3.0, 5.0]}],
}


def environment():
    """Without a display."""
    return {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}


def view(scene, folder, *lines, options=()):
    """Runs a script offscreen in a folder; returns what subprocess.run does."""
    script = folder / "script.txt"
    script.write_text("\n".join(lines) + "\n")
    return subprocess.run(
        [cli.RADSIG, "view", scene, "--offscreen", folder / "page.png", "--script", script, *options],
        cwd=folder, env=environment(), capture_output=True, text=True, timeout=300)


def render(scene, out, *options):
    done = cli.radsig("render", scene, "-o", out, *options)
    assert done.returncode == 0, done.stderr
    return next(f for f in out.glob("*.img") if not f.stem.endswith("_truth")).read_bytes()


def picks(text):
    """Values by plane of the lines that a click writes; of several the last."""
    words = [line.split() for line in text.splitlines() if line.startswith("pixel ")]
    return {w[3]: float(w[4]) for w in words}


@pytest.fixture
def scene(tmp_path):
    return cli.write_scene(tmp_path, **SCENE)


@pytest.fixture(scope="session")
def preview():
    """The helpers of this file."""
    return types.SimpleNamespace(view=view, render=render, picks=picks, environment=environment,
                                 radsig=cli.RADSIG, write_scene=cli.write_scene, scene=SCENE,
                                 envi=cli.envi)
