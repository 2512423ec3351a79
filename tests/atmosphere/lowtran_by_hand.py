"""Runs LOWTRAN 7 by hand on a deck: nothing of radsig-atmosphere takes part."""

import pathlib
import re
import subprocess

import numpy

HERE = pathlib.Path(__file__).parent


def run(deck, folder):
    """Rows of wavenumber, transmission, emitted and scattered radiance of the deck's last run, ascending in wavelength."""
    folder.mkdir(exist_ok=True)
    lowtran = HERE.parents[1] / "build/lowtran/lowtran7.o"
    subprocess.run(["gfortran", "-O2", "-o", folder / "by_hand", HERE / "by_hand.f90", lowtran], check=True)
    (folder / "TAPE5").write_text(deck)
    (folder / "out").mkdir(exist_ok=True)
    for name in ("TAPE6", "TAPE7", "TAPE8"):
        (folder / "out" / name).write_text("")
    said = subprocess.run(["./by_hand"], cwd=folder, capture_output=True, text=True, check=True).stdout
    return numpy.array([[float(x) for x in line.split()] for line in said.splitlines()])[::-1]


def tape7_spectra(folder):
    """(wavenumber, transmission) of every run, ascending in wavelength, as TAPE7 prints them: four decimals."""
    spectra, rows = [], []
    for line in (folder / "out/TAPE7").read_text().splitlines():
        if line.startswith(" -9999."):
            spectra, rows = spectra + [numpy.array(rows)[::-1]], []
        elif re.match(r" *\d+\. +\d\.\d{4} ", line):
            rows.append([float(word) for word in line.split()[:2]])
    return spectra
