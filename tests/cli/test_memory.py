"""radsig check where memory runs out: it says so and ends, wherever that is."""
import os
import pathlib
import shutil
import signal
import subprocess

import pytest

SWEEP = pathlib.Path(__file__).with_name("allocation_sweep.c")
TOML_MISREAD = "Error while parsing floating-point"  # toml++ reads numbers from streams
CORNERS = "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nv 0 9 1\n"


@pytest.fixture(scope="module")
def sweep(program, tmp_path_factory):
    """The library that fails one allocation after another."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if not compiler:
        pytest.skip("there is no C compiler")
    if "san-" in str(program.path):
        pytest.skip("sanitizers have an allocator of their own")
    library = tmp_path_factory.mktemp("sweep") / "sweep.so"
    subprocess.run([compiler, "-O1", "-shared", "-fPIC", "-o", library, SWEEP], check=True)
    return library


@pytest.fixture(scope="module")
def scene(program, tmp_path_factory):
    """A scene with something of every table."""
    folder = tmp_path_factory.mktemp("scene")
    (folder / "some.mat").write_text("1\nasphalt\n1\n.22\n5.93\n2.114\n0.0\n.93\n.93\n.40\nflat.ems\n"
                                     "null\n")
    (folder / "flat.ems").write_text("".join(
        f"{angle}\n" + "".join(f"{39850 - 100 * i} .9\n" for i in range(396)) for angle in range(91)))
    (folder / "some.toml").write_text('[[material]]\nname = "wall"\nspectrum_file = ["vis.csv", "tir.csv"]\n'
                                      'angular = "rough"\nthickness_cm = 10\n')
    (folder / "vis.csv").write_text("wavelength_um,reflectance\n0.28,.2\n0.6,.3\n4,.2\n")
    (folder / "tir.csv").write_text("wavenumber_cm1,emissivity\n2600,.9\n1000,.8\n995,.9\n700,.95\n")
    (folder / "names.csv").write_text("pattern,material\nbox_*,wall\nbric,wall\n")
    (folder / "curve.csv").write_text("wavelength_um,response\n8,0\n10,1\n12,0\n")
    return program.write_scene(
        folder, meshes={"plane.obj": CORNERS + "usemtl asphalt\nf 1 2 3 4\nf 1 2 5 3 4\nusemtl box_1\nl 1 2\nf 1 2 5\n",
                        "box.ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                   "property float y\nproperty float z\nelement face 1\n"
                                   "property list uchar int vertex_indices\nend_header\n"
                                   "0 0 1\n1 0 1\n1 1 1\n3 0 1 2\n"},
        site={"ground_material": "asphalt"},
        geometry=[{"file": "plane.obj", "thickness_cm": 5.0},
                  {"file": "box.ply", "material": "wall", "power_w_m2": 10.0}],
        library={"materials": ["some.mat", "some.toml"]}, materials={"alias_file": "names.csv"},
        material=[{"name": "wall", "density_kg_m3": 2000.0,
                   "specific_heat_j_kg_k": 900.0, "conductivity_w_m_k": 1.0,
                   "power_w_m2_by_hour": [[8, 100], [18, 0]]}],
        band=[{"name": "lwir", "wavelength_um": [8.0, 14.0], "count": 2},
              {"name": "line", "wavelength_um": [10.0, 10.05]},
              {"name": "curved", "response": "curve.csv"}],
        weather={"air_temperature_sunrise_c": 15.0, "air_temperature_peak_c": 29.0,
                 "peak_time_h": 15.0, "relative_humidity_sunrise": .9, "wind_m_s": 2.0},
        render={"thermal": "therm"}, sensor={"netd_k": .1})


def test_whichever_allocation_fails_check_says_so_and_ends(program, sweep, scene, tmp_path):
    whole = program.run("check", scene)
    assert whole.returncode == 0, whole.stderr

    done = program.run("check", scene, timeout=1200,
                       env={**os.environ, "LD_PRELOAD": str(sweep), "SWEEP_FOLDER": str(tmp_path)})
    assert done.returncode == 0, done.stderr

    codes = [tuple(map(int, line.split())) for line in (tmp_path / "codes").read_text().splitlines()]
    failed = aborted = 0
    for number, code in codes:
        out, err = ((tmp_path / f"{number}.{kind}").read_text() for kind in ("out", "err"))
        if code == 0:  # the C library did without, or the last one needed no more
            assert (number, out) == (number, whole.stdout)
            continue
        failed += 1
        lines = err.splitlines()
        if code == -signal.SIGABRT and "terminate called" in err:
            aborted += 1  # toml++ throws where it promises not to
            continue
        assert code == 1 and out == "" and lines, f"allocation {number}: {code}, {err}"
        assert any("memory" in line or TOML_MISREAD in line for line in lines), \
            f"allocation {number}: {err}"
        assert not any("unknown key" in line for line in lines), f"allocation {number}: {err}"
        assert "(null)" not in err
    assert codes[-1][1] == 0 and failed > 200  # it had 980 when this was written
    assert aborted <= 4  # two in each TOML file
