"""All kernels under Oclgrind, on small sizes: no access out of bounds, no race, and the answers of the CPU."""
import json
import os
import pathlib
import shutil
import subprocess

import numpy as np
import pytest
import cases
from built_program import VACUUM
from test_sheet import SITE, constant_weather

ROOT = pathlib.Path(__file__).resolve().parents[2]
RADSIG = ROOT / os.environ.get("RADSIG", "build/radsig")

pytestmark = pytest.mark.skipif(not shutil.which("oclgrind"), reason="needs the package oclgrind")

# Oclgrind 21.10 does not know some of what its compiler makes of optimised code.
OCLGRIND = ["oclgrind", "--data-races", "--build-options", "-cl-opt-disable -DRAY_PORTABLE"]


@pytest.fixture
def mesh(tmp_path):
    corner, position = cases.join(cases.icosphere(2), cases.box((-3, -3, -2), (3, 3, -1.5)))
    lines = ["v %.9g %.9g %.9g" % tuple(p) for p in position]
    lines += ["f " + " ".join(str(i + 1) for i in c if i != cases.NO_CORNER) for c in corner]
    path = tmp_path / "mesh.obj"
    path.write_text("\n".join(lines) + "\n")
    return path


def rays():
    random = np.random.default_rng(1)
    origin = random.uniform(-3, 3, (40, 3))
    rays = np.hstack([origin, random.uniform(-1, 1, (40, 3)) - origin])
    return "\n".join(" ".join("%.9g" % x for x in ray) for ray in rays) + "\n"


@pytest.mark.parametrize("lanes", ["16", "1"])
@pytest.mark.parametrize("command", [
    ("trace",), ("trace", "--any-hit"), ("trace", "--cull", "back"),
    ("shape-factor", "--point", "0,0,1.5", "--normal", "1,0,0", "--zenith-step", "30"),
])  # fmt: skip
def test_ray_kernels_are_clean_and_answer_as_on_the_cpu(mesh, command, lanes):
    def run(*before):
        return subprocess.run([*before, RADSIG, *command, mesh], input=rays(), text=True,
                              capture_output=True, env=os.environ | {"RADSIG_RAY_LANES": lanes})

    checked, expected = run(*OCLGRIND), run()

    assert expected.returncode == 0, expected.stderr
    assert checked.stderr == ""
    assert checked.stdout == expected.stdout


YARD = ("usemtl floor\nv -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n"
        "usemtl wall\nv -3 2 0\nv 3 2 0\nv 3 2 4\nv -3 2 4\nv 6 2 4\nv 6 2 0\nf 5 6 7 8\nf 6 10 9 7\n")
CLOUD = ("usemtl cloud\n" + "".join(f"v {x} {y} {z}\n" for z in (5, 6) for y in (-40, 40) for x in (-40, 40)) +
         "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n")
SCATTERING = ("wavenumber_cm1,single_scattering_albedo,asymmetry\n"
              + "".join(f"{39850 - 100 * i},0.9,0.8\n" for i in range(396)))
MATTER = {"density_kg_m3": 2000.0, "specific_heat_j_kg_k": 900.0, "conductivity_w_m_k": 50.0,
          "thickness_cm": 5.0, "solar_absorptance": 0.6}
BASE = {
    "site": {**SITE, "time": "1992-06-22T12:00:00+00:00"},
    "band": [{"name": "lwir", "wavelength_um": [10.0, 10.1]}],
    "render": {"thermal": "fixed", "hemisphere_step_deg": {"zenith": 30.0, "azimuth": 60.0}},
    "geometry": [{"file": "yard.obj"}],
    "material": [{"name": "floor", "emissivity": 0.8, "temperature_k": 300.0, "specular_share": 0.4,
                  "roughness": 0.3},
                 {"name": "wall", "emissivity": 0.6, "temperature_k": 320.0, "two_sided": True}],
    "atmosphere": {"uniform": {**VACUUM, "sky_temperature_k": 260.0, "sun_irradiance_w_m2_um": 2.0}},
    "camera": {"position_m": [8.0, -12.0, 4.5], "target_m": [0.0, 0.0, 1.0], "pixels": [4, 3]},
}
WARM = {"weather": {"history": "still.csv"},
        "material": [{"name": n, "emissivity": 0.9, **MATTER} for n in ("floor", "wall")]}
SCENES = {
    "rough": {**BASE, "render": {**BASE["render"], "samples_per_pixel": 4}},
    "mirror": {**BASE, "render": {**BASE["render"], "mode": "thesis"}},
    "sensor": {**BASE, "sensor": {"seed": 1, "netd_k": 0.1, "gaussian_fwhm_px": 2.0, "bits": 12}},
    "cloud": {**BASE, "geometry": [{"file": "yard.obj"}, {"file": "cloud.obj"}],
              "camera": {**BASE["camera"], "position_m": [8.0, -12.0, 9.0]},
              "material": [*BASE["material"], {"name": "cloud", "extinction_per_km": 100.0,
                                               "temperature_k": 280.0, "scattering_file": "cloud.csv"}]},
    "slab": {**BASE, **WARM, "render": {**BASE["render"], "thermal": "therm"}},
    "layers": {**BASE, **WARM, "render": {**BASE["render"], "thermal": "layered"}},
}


def rendered(program, folder, name, *before):
    """Planes of a scene, and the kernels that it ran."""
    scene = program.write_scene(folder, {"yard.obj": YARD, "cloud.obj": CLOUD}, **SCENES[name])
    (folder / "still.csv").write_text(constant_weather(10.0, 2.0))
    (folder / "cloud.csv").write_text(SCATTERING)
    out = folder / ("out" + "-checked" * bool(before))
    done = subprocess.run([*before, RADSIG, "render", scene, "-o", out], text=True, capture_output=True,
                          env=os.environ | {"RADSIG_RAY_LANES": "1"})
    assert done.returncode == 0
    assert [line for line in done.stderr.splitlines() if "warning: " not in line] == []
    report = json.loads((out / "plane.json").read_text())
    return program.load(out).planes, {k[7:] for k in report["timings_s"] if k.startswith("kernel ")}


# With single rays: Oclgrind 21.10 now and then converts equal lanes of a vector of 16 to different integers.
def test_the_kernels_of_renders_are_clean_and_make_the_image_of_the_cpu(program, tmp_path):
    every = {path.stem for path in (ROOT / "kernels").rglob("*.cl")}
    # By the test above, and what shows the preview's coarse pictures alone.
    ran = {"trace", "occluded", "facet_temperature"}

    for name in SCENES:
        folder = tmp_path / name
        folder.mkdir()
        checked, kernels = rendered(program, folder, name, *OCLGRIND)
        expected, _ = rendered(program, folder, name)
        ran |= kernels
        for plane in expected:
            np.testing.assert_allclose(checked[plane], expected[plane], rtol=1e-4, atol=1e-4,
                                       err_msg=f"{name}: {plane}")
    assert ran == every
