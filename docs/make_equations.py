#!/usr/bin/env python3
"""Writes docs/equations.md from the marks `eq. N` in kernels/, host/ and tests/.

--check only tells whether the file is up to date (exit code 1 if it is not)."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TARGET = ROOT / "docs/equations.md"

MEANING = {
    "2.3.2-6": "facets seen from behind are not met",
    "2.4-1": "radiance at the sensor from a specular facet",
    "2.4-2": "radiance at the sensor from a diffuse facet",
    "2.4-3": "radiance in band: spectrum times response, integrated",
    "2.4-4": "transmission of the sun's broad band through a body",
    "2.4-5": "Planck's law",
    "2.4.1-1": "sky radiance between two zenith angles, at the lower azimuth",
    "2.4.1-2": "sky radiance between two zenith angles, at the upper azimuth",
    "2.4.1-3": "sky radiance between the two azimuths",
    "2.4.2-6": "shape factor: the weighted share of rays that meet nothing",
    "2.4.2-7": "directions of the hemisphere's rays",
    "2.4.3-3": "transmission of a body: exp(-extinction x thickness)",
    "2.5.3-2": "direction of a pixel's ray",
}

HEADER = """# Equations of the thesis
Made by `docs/make_equations.py` from the marks `eq. N` in the sources; `make lint` checks that it
is up to date. A test is listed if it names the equation or if it is the test of the file that
computes it. Where the program departs from an equation stands in [departures.md](departures.md).

| equation | what | computed in | tests |
|---|---|---|---|
"""

NUMBER = r"\d(?:\.\d)*-\d+"
MARK = re.compile(rf"eq\.\s+({NUMBER}(?:(?:\s+to\s+|\s+and\s+|\s+with\s+|,\s+){NUMBER})*)")
NAME = re.compile(r"(\w+)\s*\(")
DEFINED = re.compile(r"^(?:static |inline |kernel |global |const |[\w*]+ )*[*\w]*\(")


def numbers_of(mark):
    """The equations that `2.4.1-1 to 2.4.1-3` or `2.4-1 and 2.4-2` mean."""
    found = re.findall(NUMBER, mark)
    if " to " in mark:
        stem, first = found[0].rsplit("-", 1)
        last = found[-1].rsplit("-", 1)[1]
        return [f"{stem}-{i}" for i in range(int(first), int(last) + 1)]
    return found


def function_of(lines, at):
    """What the mark in line `at` belongs to: the function around it or the one below its comment."""
    if lines[at].startswith((" ", "\t")) and not lines[at].lstrip().startswith("*"):
        steps = range(at, -1, -1)
    else:
        steps = range(at, min(at + 25, len(lines)))
    for i in steps:
        line = lines[i]
        if line.startswith(("#ifndef", "#include")):
            return ""  # the comment on top of the file
        if DEFINED.match(line) and "*/" not in line and not line.startswith(("/*", " *")):
            return NAME.search(line)[1]
        if line.startswith("} ") and line.endswith(";"):
            return line[2:-1]
        if line.startswith("#define"):
            return line.split()[1]
    return ""


def marks(*folders):
    """Yields equation, path and function of every mark."""
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".h", ".c", ".cl", ".py"):
                continue
            lines = path.read_text().split("\n")
            for at, line in enumerate(lines):
                for mark in MARK.finditer(line):
                    if line.count('"', 0, mark.start()) % 2 == 1:
                        continue  # a text of the program
                    for number in numbers_of(mark[1]):
                        yield number, path.relative_to(ROOT), function_of(lines, at)


def tests_of(path):
    """The tests of a source file, by their name."""
    wanted = [*(ROOT / "tests/host").rglob(f"{path.stem}_test.c"), *(ROOT / "tests/kernels").rglob(f"test_{path.stem}.py")]
    return [str(t.relative_to(ROOT)) for t in wanted if t.exists()]


def sections(number):
    section, last = number.rsplit("-", 1)
    return [int(i) for i in section.split(".")], int(last)


def page():
    computed, tests = {}, {}
    for number, path, function in marks("kernels", "host"):
        where = f"`{path}`" + (f" {function}" if function else "")
        computed.setdefault(number, [])
        if where not in computed[number]:
            computed[number].append(where)
        tests.setdefault(number, set()).update(tests_of(path))
    for number, path, _ in marks("tests"):
        tests.setdefault(number, set()).add(str(path))
    missing = sorted((set(computed) | set(tests)) - set(MEANING))
    if missing:
        sys.exit(f"docs/make_equations.py: MEANING has no line for eq. {', '.join(missing)}")
    order = sorted(computed, key=sections)
    rows = [f"| {n} | {MEANING[n]} | {'<br>'.join(computed[n])} | "
            f"{'<br>'.join(f'`{t}`' for t in sorted(tests.get(n, ())))} |\n" for n in order]
    return HEADER + "".join(rows)


def main():
    text = page()
    if "--check" not in sys.argv[1:]:
        TARGET.write_text(text)
        return 0
    if TARGET.exists() and TARGET.read_text() == text:
        return 0
    print("docs/equations.md is not up to date: run python3 docs/make_equations.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
