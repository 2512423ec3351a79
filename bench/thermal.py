#!/usr/bin/env python3
"""Times the thermal kernel on a million different facets of the thesis' Table D-1: 48 h at 15 min,
slabs of 8 nodes and lumps, each kind for itself and both together."""
import pathlib
import statistics
import sys
import time

import numpy as np
import pyopencl as cl

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path += [str(ROOT / "tests"), str(ROOT / "tests/kernels")]
import table_d1  # noqa: E402
from thermal_reference import FACET, FORCING, MATERIAL, SPAN  # noqa: E402

FACETS, STEPS, STEP_S, LANES, LOCAL, RUNS = 1 << 20, 193, 900.0, 16, 64, 5


def bodies(rows):
    random = np.random.default_rng(1)
    facets, materials = np.zeros(FACETS, FACET), np.zeros(len(rows), MATERIAL)
    normal = random.normal(size=(FACETS, 3))
    facets["normal"] = normal / np.linalg.norm(normal, axis=1)[:, None]
    facets["material"] = np.arange(FACETS) % len(rows)
    facets["thickness_m"] = 0.01 * np.array([r.thickness_cm for r in rows])[facets["material"]]
    for i, r in enumerate(rows):
        materials[i] = (1000 * r.density_g_cm3, 4184 * r.specific_heat_cal_g_c,
                        0.11622 * r.conductivity_cal_cm_h_c, r.visible_emissivity,
                        r.thermal_emissivity, r.exposed_area)
    return facets, materials


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


def measure(context, kernel, rows):
    """Seconds of each run, its temperatures kept on the device."""
    facets, materials = bodies(rows)
    span = np.zeros(1, SPAN)
    span[0] = (FACETS, STEPS - 1, 1, 3, 1.0, STEP_S, 96, STEPS)
    lit = np.random.default_rng(2).integers(0, 2**32, (3, FACETS), np.uint32)
    memory = [cl.Buffer(context, cl.mem_flags.COPY_HOST_PTR, hostbuf=a)
              for a in (facets, materials, weather(), lit)]
    out = cl.Buffer(context, cl.mem_flags.WRITE_ONLY, 4 * FACETS)
    seconds = []
    with cl.CommandQueue(context) as queue:
        for _ in range(RUNS + 1):
            start = time.perf_counter()
            kernel(queue, (FACETS // LANES,), (LOCAL,), span[0], *memory, np.uint32(0), None, out)
            queue.finish()
            seconds.append(time.perf_counter() - start)
    return seconds[1:]


def main():
    device = [d for p in cl.get_platforms() for d in p.get_devices()][0]
    context = cl.Context([device])
    source = (ROOT / "kernels/thermal.cl").read_text()
    program = cl.Program(context, source).build(f"-cl-std=CL1.2 -I {ROOT / 'kernels'}")
    kernel = program.thermal
    slabs = [r for r in table_d1.ROWS if r.exposed_area < 0]
    lumps = [r for r in table_d1.ROWS if r.exposed_area >= 0]
    print(f"{device.name}, {device.max_compute_units} compute units, {FACETS} facets, "
          f"{STEPS - 1} steps")
    for name, rows in (("slabs", slabs), ("lumps", lumps), ("mixed", table_d1.ROWS)):
        seconds = measure(context, kernel, rows)
        median = statistics.median(seconds)
        print(f"{name}: {median:.2f} s (from {min(seconds):.2f} to {max(seconds):.2f}), "
              f"{FACETS * (STEPS - 1) / median / 1e6:.0f} M facet-steps/s")


if __name__ == "__main__":
    main()
