#!/usr/bin/env python3
"""Writes the emissivity files that materials.mat names: python3 make_emissivity.py [FOLDER].

Without an argument they go beside this file. The layout is thesis Appendix A item 7: for each angle
of 0..90 degrees a line with the angle, then 396 rows of wavenumber in cm-1, 39850 down to 350, and
emissivity. e(wavenumber, angle) follows from a published normal emissivity e_n for each spectral
range and a function of angle that is assumed. Ranges without a measurement hold 1.0 at all angles,
as the thesis' own sample does.
"""

import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ANGLES_DEG = np.arange(91)
WAVENUMBERS_CM1 = np.arange(39850, 349, -100)

# Nodes that a range covers, cm-1. LWIR as in the thesis' sample; the others reach the next node
# beyond 3-5 and .4-2.5 um, so that a band up to these edges meets no unmeasured node.
RANGES_CM1 = {
    "LWIR": (750, 1250),
    "MWIR": (1950, 3350),
    "SWIR": (3950, 7650),
    "NIR": (7750, 14250),
    "VIS": (14350, 25050),
}

APPENDIX_A = "thesis Appendix A item 7, new asphalt"
TABLE_D1 = "thesis Table D-1"
FLIR = "FLIR emissivity tables (T505002, chapter 21)"
SALISBURY = "Salisbury and D'Aria 1992 (8-14 um) and 1994 (3-5 um), Remote Sens. Environ. 42 and 47"
SLUM = "Kotthaus and others 2014, urban spectral library, mean of the class"
RUBIN = "Rubin 1985, soda-lime glass n, k, one surface"
PMMA = "Zhang and others 2020, PMMA n, k, one surface"
HALE = "Hale and Querry 1973, water n, k"
KARLSSON = "Karlsson and Ribbing 1982, austenitic steel n, k"
BOWKER = "Bowker and others 1985, NASA RP-1139, green vegetation"

# file: function of angle, {range: (normal emissivity, source)}
TABLE = {
    "new_asphalt": ("D", {"LWIR": (0.961, APPENDIX_A)}),
    "old_asphalt": (
        "R",
        {
            "LWIR": (0.939, SLUM),
            "MWIR": (0.89, SALISBURY),
            "SWIR": (0.828, SLUM),
            "NIR": (0.836, SLUM),
            "VIS": (0.870, SLUM),
        },
    ),
    "concrete": (
        "R",
        {
            "LWIR": (0.94, TABLE_D1),
            "MWIR": (0.95, FLIR),
            "SWIR": (0.663, SLUM),
            "NIR": (0.654, SLUM),
            "VIS": (0.728, SLUM),
        },
    ),
    "brick": (
        "R",
        {
            "LWIR": (0.931, SLUM),
            "MWIR": (0.85, FLIR),
            "SWIR": (0.616, SLUM),
            "NIR": (0.637, SLUM),
            "VIS": (0.757, SLUM),
        },
    ),
    "shingles": (
        "R",
        {
            "LWIR": (0.953, SALISBURY),
            "MWIR": (0.943, SALISBURY),
            "SWIR": (0.625, SLUM),
            "NIR": (0.751, SLUM),
            "VIS": (0.880, SLUM),
        },
    ),
    "grass": (
        "R",
        {
            "LWIR": (0.983, SALISBURY),
            "MWIR": (0.986, SALISBURY),
            "SWIR": (0.80, BOWKER),
            "NIR": (0.55, BOWKER),
            "VIS": (0.94, BOWKER),
        },
    ),
    "plant_leaf": (
        "R",
        {
            "LWIR": (0.977, SALISBURY),
            "MWIR": (0.984, SALISBURY),
            "SWIR": (0.77, BOWKER),
            "NIR": (0.53, BOWKER),
            "VIS": (0.93, BOWKER),
        },
    ),
    "soil": ("R", {"LWIR": (0.973, SALISBURY), "MWIR": (0.804, SALISBURY)}),
    "sand": (
        "R",
        {
            "LWIR": (0.90, TABLE_D1),
            "MWIR": (0.75, SALISBURY),
            "SWIR": (0.76, TABLE_D1),
            "NIR": (0.76, TABLE_D1),
            "VIS": (0.76, TABLE_D1),
        },
    ),
    "panel": ("D", {"LWIR": (0.78, TABLE_D1), "MWIR": (0.90, FLIR)}),
    "grey_panel_5": (
        "D",
        {
            "LWIR": (0.87, TABLE_D1),
            "MWIR": (0.90, FLIR),
            "SWIR": (0.72, TABLE_D1),
            "NIR": (0.72, TABLE_D1),
            "VIS": (0.72, TABLE_D1),
        },
    ),
    "metallic_paint": (
        "D",
        {
            "LWIR": (0.44, TABLE_D1),
            "MWIR": (0.44, TABLE_D1),
            "SWIR": (0.88, TABLE_D1),
            "NIR": (0.88, TABLE_D1),
            "VIS": (0.88, TABLE_D1),
        },
    ),
    "paint": ("D", {"LWIR": (0.93, FLIR), "MWIR": (0.90, FLIR)}),
    "grey_paint": (
        "D",
        {
            "LWIR": (0.93, FLIR),
            "MWIR": (0.90, FLIR),
            "SWIR": (0.50, TABLE_D1),
            "NIR": (0.50, TABLE_D1),
            "VIS": (0.50, TABLE_D1),
        },
    ),
    "white_paint": (
        "D",
        {
            "LWIR": (0.93, FLIR),
            "MWIR": (0.90, FLIR),
            "SWIR": (0.20, TABLE_D1),
            "NIR": (0.20, TABLE_D1),
            "VIS": (0.20, TABLE_D1),
        },
    ),
    "dark_paint": (
        "D",
        {
            "LWIR": (0.93, FLIR),
            "MWIR": (0.90, FLIR),
            "SWIR": (0.90, TABLE_D1),
            "NIR": (0.90, TABLE_D1),
            "VIS": (0.90, TABLE_D1),
        },
    ),
    "glass": (
        "D",
        {
            "LWIR": (0.871, RUBIN),
            "MWIR": (0.965, RUBIN),
            "SWIR": (0.96, RUBIN),
            "NIR": (0.96, RUBIN),
            "VIS": (0.96, RUBIN),
        },
    ),
    "plexiglass": (
        "D",
        {
            "LWIR": (0.955, PMMA),
            "MWIR": (0.965, PMMA),
            "SWIR": (0.964, PMMA),
            "NIR": (0.963, PMMA),
            "VIS": (0.961, PMMA),
        },
    ),
    "rubber": (
        "D",
        {
            "LWIR": (0.95, FLIR),
            "MWIR": (0.92, FLIR),
            "SWIR": (0.93, TABLE_D1),
            "NIR": (0.93, TABLE_D1),
            "VIS": (0.93, TABLE_D1),
        },
    ),
    "bare_steel": (
        "D",
        {
            "LWIR": (0.28, FLIR),
            "MWIR": (0.30, FLIR),
            "SWIR": (0.239, KARLSSON),
            "NIR": (0.303, KARLSSON),
            "VIS": (0.374, KARLSSON),
        },
    ),
    "oxidised_steel": ("R", {"LWIR": (0.82, FLIR), "MWIR": (0.82, FLIR)}),
    "water": (
        "D",
        {
            "LWIR": (0.987, HALE),
            "MWIR": (0.973, HALE),
            "SWIR": (0.982, HALE),
            "NIR": (0.980, HALE),
            "VIS": (0.979, HALE),
        },
    ),
    "unmeasured": ("R", {}),
}


def dielectric(normal, angle_deg):
    """D: Fresnel's formulas for the real index that has this normal emissivity, unpolarised."""
    r = np.sqrt(1 - normal)
    index = (1 + r) / (1 - r)
    cosine = np.cos(np.radians(angle_deg))
    inside = np.sqrt(1 - (np.sin(np.radians(angle_deg)) / index) ** 2)
    across = (cosine - index * inside) / (cosine + index * inside)
    along = (index * cosine - inside) / (index * cosine + inside)
    return np.where(angle_deg == 90, 0.0, 1 - (across**2 + along**2) / 2)


def rough(normal, angle_deg):
    """R, assumed: flat to 60 degrees, then a quarter of a cosine wave down to 0 at 90."""
    return normal * np.where(
        angle_deg == 90, 0.0, np.cos(np.radians(3 * np.maximum(angle_deg - 60, 0)))
    )


def table(function, ranges):
    """Shape (91, 396): angle, wavenumber."""
    values = np.ones((len(ANGLES_DEG), len(WAVENUMBERS_CM1)))
    for name, (normal, _) in ranges.items():
        low, high = RANGES_CM1[name]
        inside = (WAVENUMBERS_CM1 >= low) & (WAVENUMBERS_CM1 <= high)
        angular = {"D": dielectric, "R": rough}[function](normal, ANGLES_DEG)
        values[:, inside] = angular[:, None]
    return values


def text(values):
    lines = []
    for angle, row in zip(ANGLES_DEG.tolist(), values.tolist()):
        lines.append(f"{angle}")
        lines += ["%d %.6f" % pair for pair in zip(WAVENUMBERS_CM1.tolist(), row)]
    return "\n".join(lines) + "\n"


def named_files(path):
    """The .ems files that a materials database names, in the order met."""
    lines = path.read_text(encoding="ascii").split()
    if len(lines) != 1 + 11 * int(lines[0]):
        raise ValueError(
            f"{path}:1: count {lines[0]} and {len(lines)} lines, expected eleven lines a record"
        )
    return list(dict.fromkeys(lines[10::11]))


def main():
    if len(sys.argv) > 2:
        sys.exit("usage: make_emissivity.py [FOLDER]")
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) == 2 else HERE
    try:
        names = named_files(HERE / "materials.mat")
        unknown = [name for name in names if name.removesuffix(".ems") not in TABLE]
        if unknown:
            raise ValueError(
                f"materials.mat names {', '.join(unknown)}, expected names of the table here"
            )
        for name in names:
            (folder / name).write_text(
                text(table(*TABLE[name.removesuffix(".ems")])), encoding="ascii"
            )
    except (OSError, ValueError) as error:
        sys.exit(f"make_emissivity.py: {error}")
    print(
        f"materials.mat: {len(names)} emissivity files of {len(ANGLES_DEG)} angles"
        f" by {len(WAVENUMBERS_CM1)} wavenumbers"
    )


if __name__ == "__main__":
    main()
