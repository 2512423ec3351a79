#!/usr/bin/env python3
"""Plots build/bench/rays.csv: Mray/s of radsig's packets and of Embree's best modes, by CPU time."""

import collections
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SIDES = {"radsig": "packets", "Embree robust": None, "Embree": None}  # None: the best mode


def read(path):
    """{class: {side: {mesh: Mray/s}}}, one core."""
    rates = collections.defaultdict(lambda: collections.defaultdict(dict))
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["cores"] != "1" or SIDES[row["side"]] not in (None, row["mode"]):
                continue
            best = rates[row["class"]][row["side"]]
            mesh = f"{row['mesh']}\n{int(row['facets']):,}"
            best[mesh] = max(best.get(mesh, 0), float(row["mray_cpu_s"]))
    return rates


def main(source, target):
    rates = read(source)
    figure, axes = plt.subplots(1, len(rates), figsize=(5 * len(rates), 4), squeeze=False)
    for axis, (name, sides) in zip(axes[0], rates.items()):
        for i, (side, values) in enumerate(sides.items()):
            at = [k + (i - 1) * 0.27 for k in range(len(values))]
            axis.bar(at, values.values(), 0.25, label=side)
            axis.set_xticks(range(len(values)), values, fontsize=7)
        axis.set_title(name)
        axis.set_ylabel("Mray/s, one core")
    axes[0][0].legend()
    figure.tight_layout()
    figure.savefig(target, dpi=120)


if __name__ == "__main__":
    main(*sys.argv[1:])
