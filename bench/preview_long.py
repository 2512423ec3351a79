#!/usr/bin/env python3
"""Uses the preview offscreen for minutes as a person would, and tells how its memory grows.

bench/preview_long.py [MINUTES [PROGRAM]], by default 10 and build/radsig-view.
Exit 1 where the preview fails, writes to its standard error or keeps growing."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENE = ROOT / "scenes/airport/scene.toml"
# What is freed goes back to the system at once, so that the memory counted is what is in use.
GIVE_BACK = {"MALLOC_ARENA_MAX": "1", "MALLOC_MMAP_THRESHOLD_": "65536", "MALLOC_TRIM_THRESHOLD_": "65536"}
# What a build with sanitizers needs for it: the libraries' own leaks are known, little is held back.
SANITIZED = {"LSAN_OPTIONS": f"print_suppressions=0:suppressions={ROOT}/tests/sanitizer.supp",
             "ASAN_OPTIONS": "quarantine_size_mb=4:use_sigaltstack=0"}
GROWTH_MB = 16  # between the first round after WARM_SHARE of the time, and the last
WARM_SHARE = 0.2

# One round: views, times, planes, colours, modes, sizes, comparison and values.
ROUND = """drag left 60 20
drag right -20 10
scroll 3
wait
key n
key n
key g
click 100 90
key v
wait
key >
key >
key p
key c
wait
key c
key m
wait
key m
key c
key p
size 760 520
wait
key y
key e
key l
key escape
key home
size 654 442
wait
key v
page {page}
click 200 150
wait
error
"""


def resident_mb(pid):
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024


def is_done(child):
    """Reads what a round prints, which ends with the error that is shown: none, an empty line."""
    for line in child.stdout:
        if line == "\n":
            return True
        if not line.startswith(("pixel ", "day ")):
            sys.exit(f"bench/preview_long.py: the preview shows an error: {line}")
    return False


def use(program, minutes, page):
    """Returns the memory after every round, the exit code, and what was written as errors."""
    with tempfile.TemporaryFile("w+") as errors:
        child = subprocess.Popen([program, SCENE, "--size", "480x360", "--script", "-", "--offscreen", page],
                                 stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors, text=True,
                                 env=os.environ | GIVE_BACK | SANITIZED)
        rounds, start = [], time.monotonic()
        while time.monotonic() - start < 60 * minutes:
            child.stdin.write(ROUND.format(page=page))
            child.stdin.flush()
            if not is_done(child):
                break
            rounds.append(resident_mb(child.pid))
            print(f"{time.monotonic() - start:6.0f} s {rounds[-1]:8.1f} MB", flush=True)
        child.stdin.close()
        code = child.wait()
        errors.seek(0)
        return rounds, code, errors.read()


def main():
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
    program = sys.argv[2] if len(sys.argv) > 2 else ROOT / "build/radsig-view"
    with tempfile.TemporaryDirectory() as folder:
        rounds, code, errors = use(program, minutes, Path(folder) / "page.png")
    warm = rounds[int(WARM_SHARE * len(rounds)):]
    growth_mb = warm[-1] - warm[0] if warm else 0.0
    print(f"{len(rounds)} rounds, exit code {code}, {growth_mb:+.1f} MB since the first fifth")
    if code or errors:
        sys.exit(f"bench/preview_long.py: {errors or code}")
    if not warm or growth_mb > GROWTH_MB:
        sys.exit("bench/preview_long.py: memory grows")


if __name__ == "__main__":
    main()
