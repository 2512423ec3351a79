#!/usr/bin/env python3
"""Times temperatures: the kernel alone on facets that all differ, 48 h at 15 min, with the materials of
the thesis' Table D-1; then the airport at 512 x 512 as radsig renders it. A facet-step is one record of
the weather, four sub-steps in the kernel. See bench/README.md."""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import pyopencl as cl

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path += [str(ROOT / "tests"), str(ROOT / "tests/kernels")]
import table_d1  # noqa: E402
from opencl import OpenCL  # noqa: E402
from records import FACET, FORCING, MATERIAL, SPAN  # noqa: E402

STEPS, STEP_S, LANES, LOCAL, RUNS = 193, 900.0, 16, 64, 5
MILLION, AIRPORT = 1 << 20, 54545
SCENE = ROOT / "scenes/airport/scene.toml"


def bodies(rows, count):
    random = np.random.default_rng(1)
    facets, materials = np.zeros(count, FACET), np.zeros(len(rows), MATERIAL)
    normal = random.normal(size=(count, 3))
    facets["normal"] = normal / np.linalg.norm(normal, axis=1)[:, None]
    facets["material"] = np.arange(count) % len(rows)
    facets["thickness_m"] = 0.01 * np.array([r.thickness_cm for r in rows])[facets["material"]]
    for material, r in zip(materials, rows):
        material["density_kg_m3"] = 1000 * r.density_g_cm3
        material["specific_heat_j_kg_k"] = 4184 * r.specific_heat_cal_g_c
        material["conductivity_w_m_k"] = 0.11622 * r.conductivity_cal_cm_h_c
        material["solar_absorptance"] = r.visible_emissivity
        material["thermal_emissivity"], material["exposed_area"] = r.thermal_emissivity, r.exposed_area
    lump = materials["exposed_area"][facets["material"]] >= 0
    return facets[np.argsort(lump, kind="stable")], materials  # slabs first, as radsig lays them


def weather():
    hour = np.arange(STEPS) * 0.25
    forcing = np.zeros(STEPS, FORCING)
    forcing["sun"][:, 2] = height = np.maximum(0, np.cos(2 * np.pi * (hour - 12) / 24))
    forcing["direct_w_m2"], forcing["diffuse_w_m2"] = 900 * height, 100 * height
    forcing["air_temperature_k"] = 290 + 6 * np.cos(2 * np.pi * (hour - 15) / 24)
    forcing["sky_longwave_w_m2"] = 300
    forcing["convection_w_m2_k"] = 12
    forcing["rain_temperature_k"] = forcing["air_temperature_k"]
    return forcing


def measure(opencl, rows, count=MILLION):
    """(seconds, seconds of processor time) of each run, temperatures kept on the device."""
    facets, materials = bodies(rows, count)
    span = np.zeros(1, SPAN)
    span[0] = (count, STEPS - 1, 1, 3, 1.0, STEP_S, 96, STEPS)
    lit = np.random.default_rng(2).integers(0, 2**32, (3, count), np.uint32)
    arguments, _ = opencl.bind("thermal", {
        "span": span, "facets": facets, "materials": materials,
        "load": {"forcing": weather(), "sunlit": lit, "power_materials": 0},
        "temperature_k": np.empty(count, np.float32)})
    groups = -(-count // LANES)
    runs = []
    for _ in range(RUNS + 1):
        start = time.perf_counter(), time.process_time()
        opencl.build("thermal")(opencl.queue, (-(-groups // LOCAL) * LOCAL,), (LOCAL,), *arguments)
        opencl.queue.finish()
        runs.append((time.perf_counter() - start[0], time.process_time() - start[1]))
    return runs[1:]


def report(name, runs, count, compute_units):
    seconds, processor = (statistics.median(column) for column in zip(*runs))
    rate = count * (STEPS - 1) / 1e6
    print(f"{name}: {seconds:.2f} s ({min(r[0] for r in runs):.2f} to {max(r[0] for r in runs):.2f}),"
          f" {rate / seconds:.0f} M facet-steps/s; {processor:.2f} s of processor time, which is"
          f" {rate * compute_units / processor:.0f} M/s on {compute_units} idle ones")


def render(model):
    """What the airport's temperatures take, of radsig's own report."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([ROOT / "build/radsig", "render", SCENE, "-o", folder, "--size", "512x512",
                        "--set", f'render.thermal="{model}"'], check=True)
        times = json.loads((pathlib.Path(folder) / "airport.json").read_text())["timings_s"]
    kernels = {k: t for k, t in times.items()
               if k.split()[-1] in ("thermal", "layered", "sun_history", "conduction")}
    print(f"airport, {model}: facets {times['host temperatures']:.2f} s, sun rays included; facets and"
          " pixels together: " + ", ".join(f"{k} {t:.2f} s" for k, t in kernels.items()))


def main():
    device = [d for p in cl.get_platforms() for d in p.get_devices()][0]
    opencl = OpenCL(cl.Context([device]))
    start = time.perf_counter()
    opencl.build("thermal")
    print(f"{device.name}, {device.max_compute_units} compute units, {STEPS - 1} steps; "
          f"the kernel was built in {time.perf_counter() - start:.2f} s")
    slabs = [r for r in table_d1.ROWS if r.exposed_area < 0]
    lumps = [r for r in table_d1.ROWS if r.exposed_area >= 0]
    for name, rows, count in (("a million slabs", slabs, MILLION), ("a million lumps", lumps, MILLION),
                              ("a million of both", table_d1.ROWS, MILLION),
                              (f"{AIRPORT} slabs", slabs, AIRPORT)):
        report(name, measure(opencl, rows, count), count, device.max_compute_units)
    for model in ("therm", "layered"):
        render(model)


if __name__ == "__main__":
    main()
