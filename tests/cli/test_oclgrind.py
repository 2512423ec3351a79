"""The ray kernels under Oclgrind: no access out of bounds, no race, and the answers of the CPU."""
import os
import pathlib
import shutil
import subprocess

import numpy as np
import pytest
import cases

ROOT = pathlib.Path(__file__).resolve().parents[2]
RADSIG = ROOT / os.environ.get("RADSIG", "build/radsig")

pytestmark = pytest.mark.skipif(not shutil.which("oclgrind"), reason="needs the package oclgrind")

# Oclgrind 21.10 does not know some of what its compiler makes of optimised code.
OCLGRIND = ["oclgrind", "--data-races", "--build-options", "-cl-opt-disable -DRAY_PORTABLE"]


@pytest.fixture
def mesh(tmp_path):
    corner, position = cases.join(cases.icosphere(2), cases.box((-3, -3, -2), (3, 3, -1.5)))
    lines = ["v %.9g %.9g %.9g" % tuple(p) for p in position]
    lines += ["f " + " ".join(str(i + 1) for i in c if i != cases.NO_CORNER) for c in corner]
    path = tmp_path / "mesh.obj"
    path.write_text("\n".join(lines) + "\n")
    return path


def rays():
    random = np.random.default_rng(1)
    origin = random.uniform(-3, 3, (40, 3))
    rays = np.hstack([origin, random.uniform(-1, 1, (40, 3)) - origin])
    return "\n".join(" ".join("%.9g" % x for x in ray) for ray in rays) + "\n"


@pytest.mark.parametrize("lanes", ["16", "1"])
@pytest.mark.parametrize("command", [
    ("trace",), ("trace", "--any-hit"), ("trace", "--cull", "back"),
    ("shape-factor", "--point", "0,0,1.5", "--normal", "1,0,0", "--zenith-step", "30"),
])  # fmt: skip
def test_ray_kernels_are_clean_and_answer_as_on_the_cpu(mesh, command, lanes):
    def run(*before):
        return subprocess.run([*before, RADSIG, *command, mesh], input=rays(), text=True,
                              capture_output=True, env=os.environ | {"RADSIG_RAY_LANES": lanes})

    checked, expected = run(*OCLGRIND), run()

    assert expected.returncode == 0, expected.stderr
    assert checked.stderr == ""
    assert checked.stdout == expected.stdout
