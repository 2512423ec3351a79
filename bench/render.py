#!/usr/bin/env python3
"""Times the airport at 512 x 512: the whole process and its stages. See bench/README.md."""

import csv
import json
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/radsig"
SCENE = ROOT / "scenes/airport/scene.toml"
TARGET = ROOT / "build/bench/render.csv"
RUNS = 5
NOISE = 0.15  # (slowest - fastest) / median


def render(folder):
    """Renders once. Returns seconds by name, and the process' peak memory in MB."""
    start = time.monotonic()
    child = os.posix_spawn(
        PROGRAM, [PROGRAM, "render", SCENE, "-o", folder, "--size", "512x512"], os.environ)
    _, code, usage = os.wait4(child, 0)
    wall_s = time.monotonic() - start
    if code != 0:
        sys.exit(f"bench/render.py: {PROGRAM.name} render failed")
    stages = json.loads((Path(folder) / "airport.json").read_text())["timings_s"]
    whole = {"process, wall": wall_s, "process, CPU": usage.ru_utime + usage.ru_stime}
    return whole | stages, usage.ru_maxrss / 1024


def measure():
    """Returns rows of name, unit and the value of every run."""
    runs = []
    with tempfile.TemporaryDirectory() as folder:
        render(folder)  # fills the caches of the disk and of the OpenCL compiler
        for _ in range(RUNS):
            runs.append(render(folder))
    rows = [(name, "s", [seconds[name] for seconds, _ in runs]) for name in runs[0][0]]
    rows.insert(2, ("process, peak memory", "MB", [memory_mb for _, memory_mb in runs]))
    return rows


def main():
    rows = measure()
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    with open(TARGET, "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(["name", "unit", "median", *(f"run {i + 1}" for i in range(RUNS))])
        for name, unit, values in rows:
            out.writerow([name, unit, statistics.median(values), *values])
    print(f"airport, 512 x 512, median of {RUNS} runs")
    for name, unit, values in rows:
        print(f"{name:28} {statistics.median(values):10.3f} {unit}")
    wall_s = rows[0][2]
    spread = (max(wall_s) - min(wall_s)) / statistics.median(wall_s)
    if spread > NOISE:
        print(f"the runs differ by {100 * spread:.0f} %: the machine was too noisy for a verdict")
    print(f"written: {TARGET.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
