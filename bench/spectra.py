#!/usr/bin/env python3
"""What spectra cost at the airport: 400 bands, and a band of the visible against one of the infrared.
See bench/README.md."""

import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from departures import AIRPORT, PROGRAM, ROOT

ROUNDS = 3
SIZE = 256
CASES = {
    "400 bands": ("june24_1500z.rad", [8.0, 13.3], "count = 400\n"),
    "visible": ("../atmosphere/june24_1500z_vis.radc", [0.4, 0.7], ""),
    "infrared": ("june24_1500z.rad", [8.0, 13.3], ""),
}


def write_scene(folder, case):
    """The airport with another database and band; its files by their full names."""
    database, edges, more = CASES[case]
    text = (AIRPORT / "scene.toml").read_text()
    text = text.replace("june24_1500z.rad", str(AIRPORT / database))
    text = text.replace('"airport.gdb"', f'"{AIRPORT / "airport.gdb"}"')
    text = text.replace("../library", str(ROOT / "scenes/library"))
    text = text.replace("wavelength_um = [8.0, 13.3]\n", f"wavelength_um = {edges}\n{more}")
    (folder / "scene.toml").write_text(text)
    return folder / "scene.toml"


def kernels_s(folder, case, mode):
    """Seconds by kernel of one render."""
    out = folder / "out"
    subprocess.run([PROGRAM, "render", write_scene(folder, case), "-o", out, "--mode", mode,
                    "--size", f"{SIZE}x{SIZE}", "--planes", "material"], check=True)
    times = json.loads((out / "airport.json").read_text())["timings_s"]
    return {name.split()[1]: s for name, s in times.items() if name.startswith("kernel ")}


def main():
    wanted = [("400 bands", "exact"), *((c, m) for m in ("exact", "thesis")
                                        for c in ("visible", "infrared"))]
    runs = {each: [] for each in wanted}
    with tempfile.TemporaryDirectory() as name:
        for _ in range(ROUNDS):  # by turns, so that a busy machine is busy for all
            for each in wanted:
                runs[each].append(kernels_s(Path(name), *each))

    def median(each, *kernels):
        return statistics.median(sum(r[k] for k in kernels or r) for r in runs[each])

    for text, kernels in (("in band_planes.cl, which integrates spectra over bands", ["band_planes"]),
                          ("with radiometry.cl, which makes them",
                           ["band_planes", "radiometry"])):
        rate = 400 * SIZE**2 / median(wanted[0], *kernels) / 1e9
        print(f"400 bands: {rate:.3f} G pixel-bands/s {text}")
    for mode in ("exact", "thesis"):
        ratio = median(("visible", mode)) / median(("infrared", mode))
        print(f"{mode} mode: the visible costs {ratio:.2f} times the infrared, all kernels; "
              f"those two alone "
              f"{median(('visible', mode), *kernels):.4f} s against "
              f"{median(('infrared', mode), *kernels):.4f} s")


if __name__ == "__main__":
    sys.exit(main())
