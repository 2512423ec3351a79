#!/usr/bin/env python3
"""Writes the tables of columns in docs/file-formats.md, from the tables that the program reads by.

A table stands between `<!-- columns of FILE -->` and `<!-- end of columns -->`. --check only tells whether
the document is up to date (exit code 1 if it is not)."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TARGET = ROOT / "docs/file-formats.md"
PLACE = re.compile(r"(<!-- columns of ([\w/.]+) -->\n).*?(<!-- end of columns -->)", re.S)
COLUMN = re.compile(r'\[\w+\]\s*=\s*\{\s*"([^"]+)",\s*"([^"]+)",\s*(-?\d+),\s*([-\de.]+),\s*([-\de.]+),'
                    r'\s*(true|false)\s*\}')


def table(source):
    """A column a row: where it stands, if it has no name in the file, its name, unit and range."""
    rows = sorted((int(field), name, unit, low, high, zero == "true")
                  for name, unit, field, low, high, zero in COLUMN.findall(source.read_text()))
    if not rows:
        sys.exit(f"{source.relative_to(ROOT)}: found no columns")
    named = rows[0][0] < 0
    out = "| name | unit | range |\n|---|---|---|\n" if named else \
        "| field | quantity | unit | range |\n|---|---|---|---|\n"
    for field, name, unit, low, high, zero in rows:
        first = f"`{name}`" if named else f"{field + 1} | {name}"
        out += f"| {first} | {unit} | {low} to {high}{', 0 is missing' if zero else ''} |\n"
    return out


def main():
    text = TARGET.read_text()
    made = PLACE.sub(lambda m: m[1] + table(ROOT / m[2]) + m[3], text)
    if "--check" in sys.argv[1:]:
        if made != text:
            print("docs/file-formats.md is not up to date: run python3 docs/make_columns.py")
            return 1
    else:
        TARGET.write_text(made)
    return 0


if __name__ == "__main__":
    sys.exit(main())
