#!/usr/bin/env python3
"""Reads all weather that installed packages bring along, and prints a table of what came of it.

    tests/packaged_weather.py [FOLDER ...]

Searches the packages below, where they are installed, and the folders named, for EPW years, TMY3, NSRDB and PVGIS
tables, SURFRAD and SOLRAD days. Each is the weather of a scene at its place on some of its days. `read` means that
the air at noon is the file's and that its light keeps the day's sum; `refused` that radsig said why; all else is a
failure, and the exit code is 1."""

import csv
import io
import math
import pathlib
import re
import subprocess
import tempfile

import packaged
from packaged import RADSIG, refusal

LANGLEY_PER_HOUR_W_M2 = 41840 / 3600
SMALLEST_SUM_WH = 300  # of a day, below which a per cent is little

MODULES = ["pvlib", "ladybug", "ladybug_core", "accim", "epw", "pyepw", "diyepw", "besos", "eppy", "geomeppy"]  # PyPI
FOLDERS = ["/usr/share/energyplus", "/usr/share/doc/energyplus"]
YEAR_DAYS = [(1, 15), (2, 28), (2, 29), (3, 1), (4, 20), (6, 21), (9, 28), (10, 11), (12, 31)]

MATTER = """thickness_cm = 5
density_kg_m3 = 2000
specific_heat_j_kg_k = 900
conductivity_w_m_k = 1"""


def folders():
    return packaged.folders(MODULES, FOLDERS)


def scene(path, place, date, offset_h):
    """Weather of a file at (latitude, longitude), at noon of (year, month, day)."""
    time = f"{date[0]:04}-{date[1]:02}-{date[2]:02}T12:00:00{offset_text(offset_h)}"
    return packaged.mesh_scene((*place, time), "plane.obj", MATTER, "therm", f"[weather]\nhistory = '''{path}'''\n")


def kind(path):
    """What a file is by its name and its first lines; None: no weather."""
    suffix = path.suffix.lower()
    if suffix == ".epw":
        return "EPW"
    head = path.read_bytes()[:3000].decode("latin-1").split("\n")[:3]
    if suffix == ".dat" and len(head) == 3 and "version" in head[1]:
        return "SURFRAD" if len(head[2].split()) == 48 else "SOLRAD"
    if suffix == ".csv" and len(head) == 3:
        if head[1].startswith("Date (MM/DD/YYYY)"):
            return "TMY3"
        if head[0].startswith("Source,Location ID"):
            return "NSRDB"
        if head[0].startswith("Latitude (decimal degrees)"):
            return "PVGIS"
    return None


def files(where):
    return packaged.files(where, lambda path: path.suffix.lower() in {".epw", ".csv", ".dat"} and kind(path))


def number(text):
    try:
        value = float(text)
    except ValueError:
        return math.nan
    return math.nan if abs(value) >= 9900 else value


class Year:
    """Hours by (month, day, hour that ends): air in C, direct and diffuse in Wh/m2, as the file states them."""

    def __init__(self, path, what):
        rows = list(csv.reader(io.StringIO(path.read_text(encoding="utf-8-sig", errors="replace"))))
        self.hours, self.ends = {}, what in ("EPW", "TMY3")
        if what == "EPW":
            place = rows[0]
            self.latitude, self.longitude, self.offset_h = map(float, place[6:9])
            for row in rows[1:]:
                if row and row[0].strip().isdigit() and len(row) > 20:
                    self.hours[int(row[1]), int(row[2]), int(row[3])] = (row[0], row[6], row[14], row[15])
        elif what == "TMY3":
            self.offset_h, self.latitude, self.longitude = map(float, rows[0][3:6])
            air, direct, diffuse = (next(i for i, name in enumerate(rows[1]) if name.startswith(begin))
                                    for begin in ("Dry-bulb (", "DNI (", "DHI ("))
            for row in rows[2:]:
                month, day, year = row[0].split("/")
                self.hours[int(month), int(day), int(row[1][:2])] = (year, row[air], row[direct], row[diffuse])
        elif what == "NSRDB":
            head = dict(zip(rows[0], rows[1]))
            self.latitude, self.longitude = float(head["Latitude"]), float(head["Longitude"])
            self.offset_h = float(head["Time Zone"])
            at = {name: i for i, name in enumerate(rows[2])}
            for row in rows[3:]:
                key = int(row[1]), int(row[2]), int(row[3]) + int(row[4]) / 60
                self.hours[key] = (row[0], row[at["Temperature"]], row[at["DNI"]], row[at["DHI"]])
        else:
            words = [row[0].split(":")[-1] for row in rows[:3]]
            self.latitude, self.longitude, self.offset_h = float(words[0]), float(words[1]), 0.0
            names = next(row for row in rows if row and row[0] == "time(UTC)")
            air, direct, diffuse = (names.index(name) for name in ("T2m", "Gb(n)", "Gd(h)"))
            for row in rows:
                stamp = re.match(r"(\d{4})(\d\d)(\d\d):(\d\d)(\d\d)", row[0]) if row else None
                if stamp:
                    year, month, day, hour, minute = map(int, stamp.groups())
                    self.hours[month, day, hour + minute / 60] = (year, row[air], row[direct], row[diffuse])
        self.step_h = 24 / max(1, sum(key[:2] == next(iter(self.hours))[:2] for key in self.hours))
        self.year = int(next(iter(self.hours.values()))[0])

    def days(self):
        """Days that the file has, with the one before, and 29 February and 1 March of a leap year."""
        have = {key[:2] for key in self.hours}
        return [day for day in YEAR_DAYS if day in have or (day == (2, 29) and (2, 28) in have and (3, 1) in have)]

    def day(self, month, day):
        """Air at noon, sums of light."""
        if (month, day, 12) not in self.hours:
            day = 28
        of_day = [row for key, row in self.hours.items() if key[:2] == (month, day)]
        sums = [self.step_h * sum(number(row[i]) for row in of_day) for i in (2, 3)]
        return number(self.hours.get((month, day, 12), [math.nan] * 4)[1]), *sums


def offset_text(hours):
    return f"{'-' if hours < 0 else '+'}{int(abs(hours)):02}:{round(60 * (abs(hours) % 1)):02}"


def run(folder, text):
    (folder / "plane.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "scene.toml").write_text(text)
    return subprocess.run([RADSIG, "weather", folder / "scene.toml", "-o", folder / "made.wth"],
                          capture_output=True, text=True, errors="replace", timeout=120)


def warnings_of(done):
    return [line for line in re.findall(r"warning: (.*)", done.stderr)
            if "made.wth: leaves out" not in line and "is the weather of" not in line]


def made(folder):
    """Air at noon of the second day, sums of its light, the brightest beam."""
    rows = [list(map(float, line.split())) for line in (folder / "made.wth").read_text().split("\n")[1:] if line]
    day = [row for row in rows if 24.0 <= row[0] < 48.0]
    sums = [sum(row[i] for row in day) / 4 * LANGLEY_PER_HOUR_W_M2 for i in (6, 7)]
    return day[48][1], *sums, max(row[6] for row in rows) * LANGLEY_PER_HOUR_W_M2


def check_day(path, year, date, folder):
    leap = date == (2, 29) or date == (3, 1)
    done = run(folder, scene(path, (year.latitude, year.longitude), (2024 if leap else year.year, *date), year.offset_h))
    if done.returncode:
        return refusal(done, path)
    told = warnings_of(done)
    air, *sums, brightest = made(folder)
    noon, *expected = year.day(*date)
    text = f"{air:.1f} C at noon, {sums[0]:.0f} and {sums[1]:.0f} Wh/m2, {brightest:.0f} W/m2 at most"
    near = lambda got, wanted: math.isnan(wanted) or abs(got - wanted) <= 0.01 * max(SMALLEST_SUM_WH, wanted)
    # Where light does not fit the sun it may be anywhere near a day's ends; where it is missing it is derived.
    odd = [line for line in told if "does not fit" in line or "follow from the global" in line or "counts as" in line]
    right = brightest < 1200 and (math.isnan(noon) or abs(air - noon) < 0.05) \
        and (odd or all(map(near, sums, expected)))
    return ("read" if right else "WRONG"), text + ("" if right else f", expected {noon:.1f} C, {expected}") \
        + "".join(f"; {line.split(path.name)[-1].lstrip(': ')}" for line in told)


def check_station(path, folder):
    """A day of SURFRAD or SOLRAD."""
    lines = path.read_text().split("\n")
    latitude, longitude = map(float, lines[1].split()[:2])
    first = list(map(float, lines[2].split()))
    offset_h = round(-abs(longitude) / 15)
    done = run(folder, scene(path, (latitude, -abs(longitude)), tuple(map(int, (first[0], first[2], first[3]))), offset_h))
    if done.returncode:
        return refusal(done, path)
    noon = [list(map(float, line.split())) for line in lines[2:] if line.split()[4:5] == [str(12 - offset_h)]]
    air = [row[38] for row in noon if row[5] < 8 and row[39] == 0]
    right = not air or abs(sum(air) / len(air) - made(folder)[0]) < 0.3
    return ("read" if right else "WRONG"), "; ".join(line.split(path.name)[-1].lstrip(": ") for line in warnings_of(done))


def check(path, folder):
    """(verdict, reason) of every day that is tried."""
    what = kind(path)
    if what in ("SURFRAD", "SOLRAD"):
        return [(what, *check_station(path, folder))]
    year = Year(path, what)
    return [(f"{what} {month:02}-{day:02}", *check_day(path, year, (month, day), folder)) for month, day in year.days()]


def table(where):
    """Rows of path, what was tried, verdict and reason."""
    with tempfile.TemporaryDirectory() as folder:
        return [(path, *row) for path in files(where) for row in check(path, pathlib.Path(folder))]


if __name__ == "__main__":
    packaged.main(__doc__, table, folders())
