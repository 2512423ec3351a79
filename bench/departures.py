#!/usr/bin/env python3
"""How much exact mode's departures from the thesis matter at the airport, part by part. See
bench/README.md."""

import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/radsig"
AIRPORT = ROOT / "scenes/airport"
TARGET = ROOT / "build/bench/departures.csv"
SIZE = 256
BANDS = {"lwir": ([8.0, 13.3], AIRPORT / "june24_1500z.rad"),
         "mwir": ([3.0, 5.0], ROOT / "scenes/atmosphere/june24_1500z_mwir.radc")}
PARTS = ["emitted", "reflected_sun", "reflected_sky", "reflected_background", "path"]
MEAN = "W m-2 sr-1 um-1"


def write_scene(folder, band):
    """The airport in another band; its files by their full names."""
    edges, database = BANDS[band]
    text = (AIRPORT / "scene.toml").read_text()
    for name, path in (("june24_1500z.rad", database), ("airport.gdb", AIRPORT / "airport.gdb"),
                       ("../library/materials.mat", ROOT / "scenes/library/materials.mat")):
        text = text.replace(f'"{name}"', f'"{path}"')
    text = re.sub(r'(?<=\[\[band\]\]\nname = )"lwir"\nwavelength_um = .*',
                  f'"{band}"\nwavelength_um = {edges}', text)
    (folder / "scene.toml").write_text(text)
    return folder / "scene.toml"


def planes_of(stem):
    """The planes of an ENVI image by name; NaN where there is no value."""
    header = stem.with_suffix(".hdr").read_text()
    names = re.search(r"band names = \{(.*?)\}", header, re.S)[1]
    values = np.fromfile(stem.with_suffix(".img"), "<f4").reshape(-1, SIZE, SIZE).astype(float)
    values[values == -9999] = np.nan
    return {name.strip().split(" [")[0]: plane for name, plane in zip(names.split(","), values)}


def render(folder, band, name, mode, *settings):
    """All planes of a render of the airport."""
    wanted = ["interaction", "temperature_c", "background_temperature_c", "shape_factor",
              f"apparent_temperature_{band}_c", *(f"{part}_{band}" for part in PARTS)]
    subprocess.run([PROGRAM, "render", write_scene(folder, band), "-o", folder / name, "--size",
                    f"{SIZE}x{SIZE}", "--mode", mode, "--planes", ",".join(wanted),
                    *(f"--set={s}" for s in settings)], check=True)
    return planes_of(folder / name / "airport") | planes_of(folder / name / "airport_truth")


def rows_of(band):
    """Name, unit and difference of every plane, exact less thesis."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        in_band = [render(folder, band, mode, mode) for mode in ("exact", "thesis")]
        mean = [render(folder, band, f"{mode}_mean", mode, "render.radiance=mean")
                for mode in ("exact", "thesis")]
        fine = render(folder, band, "fine", "exact",
                      "render.hemisphere_step_deg={ zenith = 5, azimuth = 10 }")
    radiance, apparent = f"radiance_{band}", f"apparent_temperature_{band}_c"

    def row(what, unit, plane, pair=in_band):
        return what, unit, pair[0][plane] - pair[1][plane]

    around = [sum(of[f"reflected_{part}_{band}"] for part in ("sky", "background")) for of in mean]
    rows = [row("radiance in band", "W m-2 sr-1", radiance),
            row("mean radiance: without the band's width", MEAN, radiance, mean),
            row("apparent temperature", "K", apparent)]
    rows += [row(part.replace("_", " "), MEAN, f"{part}_{band}", mean) for part in PARTS]
    rows += [("reflected sky and background", MEAN, around[0] - around[1]),
             row("temperature", "K", "temperature_c"),
             row("background's temperature", "K", "background_temperature_c"),
             row("shape factor", "1", "shape_factor"),
             ("cells of 5 x 10 degrees", "W m-2 sr-1", fine[radiance] - in_band[0][radiance])]
    kinds = in_band[0]["interaction"] > 1
    rows += [("apparent temperature, diffuse", "K", np.where(kinds, np.nan, rows[2][2])),
             ("apparent temperature, specular", "K", np.where(kinds, rows[2][2], np.nan))]
    return rows


def main():
    TARGET.parent.mkdir(parents=True, exist_ok=True)
    with open(TARGET, "w", newline="") as file:
        out = csv.writer(file)
        out.writerow(["band", "exact less thesis", "unit", "mean", "rms", "largest"])
        for band in BANDS:
            for what, unit, off in rows_of(band):
                off = off[~np.isnan(off)]
                sizes = off.mean(), np.sqrt((off**2).mean()), abs(off).max()
                out.writerow([band, what, unit, *sizes])
                print(f"{band}  {what:40} {sizes[0]:9.4f} {sizes[1]:9.4f} {sizes[2]:9.4f}  {unit}")
    print(f"written: {TARGET.relative_to(ROOT)}")


if __name__ == "__main__":
    sys.exit(main())
