#!/usr/bin/env python3
"""Writes the tables of columns in docs/file-formats.md, from the tables that the program reads by.

A table stands between `<!-- columns of FILE -->` and `<!-- end of columns -->`. Where the file lists names that
headers have for its columns, they stand in it. --check only tells whether
the document is up to date (exit code 1 if it is not)."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TARGET = ROOT / "docs/file-formats.md"
PLACE = re.compile(r"(<!-- columns of ([\w/.]+) -->\n).*?(<!-- end of columns -->)", re.S)
COLUMN = re.compile(r'\[(\w+)\]\s*=\s*\{\s*"([^"]+)",\s*"([^"]+)",\s*(-?\d+),\s*([-\de.]+),\s*([-\de.]+),'
                    r'\s*(true|false)\s*\}')


NAMES = re.compile(r'\{(\w+),\s*"\|([^"]+)\|",\s*"([^"]*)"\}')


def names_by_column(text):
    """Names in headers, with their unit where it is not the column's."""
    usual = {key: unit for key, _, unit, *_ in COLUMN.findall(text)}
    found = {}
    for key, names, unit in NAMES.findall(text):
        hint = f" ({unit})" if unit and unit != usual[key] else ""
        found.setdefault(key, []).extend(f"`{name}`{hint}" for name in names.split("|"))
    return found


def table(source):
    """A column a row: where it stands, if it has no name in the file, its name, unit and range."""
    text = source.read_text()
    names = names_by_column(text)
    rows = sorted((int(field), name, unit, low, high, zero == "true", ", ".join(names.get(key, [])))
                  for key, name, unit, field, low, high, zero in COLUMN.findall(text))
    if not rows:
        sys.exit(f"{source.relative_to(ROOT)}: found no columns")
    heads = ["quantity", "unit", "range", "names"] if names else \
        ["name", "unit", "range"] if rows[0][0] < 0 else ["field", "quantity", "unit", "range"]
    out = "| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|\n"
    for field, name, unit, low, high, zero, headers in rows:
        bounds = f"{low} to {high}{', 0 is missing' if zero else ''}"
        first = f"{field + 1} | {name}" if field >= 0 else name if names else f"`{name}`"
        out += f"| {first} | {unit} | {bounds} |{f' {headers} |' if names else ''}\n"
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
