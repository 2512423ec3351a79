"""radsig devices, and what is said where OpenCL is missing or wrong."""
import os
import pathlib
import re
import subprocess

import pytest


@pytest.fixture
def without_opencl(tmp_path):
    """An environment whose OpenCL loader finds no platform."""
    empty = tmp_path / "vendors"
    empty.mkdir()
    return {**os.environ, "OCL_ICD_VENDORS": str(empty), "OPENCL_VENDOR_PATH": str(empty)}


def rows(program):
    heading, *lines = program.run("devices").stdout.splitlines()
    return heading, lines


def test_the_table_has_a_heading_with_units(program):
    heading, lines = rows(program)

    assert len(lines) >= 1
    for words in ("device", "type", "units", "memory GiB", "name", "platform", "version"):
        assert words in heading


def test_exactly_one_device_is_the_default(program):
    marked = [line for line in rows(program)[1] if line.startswith("*")]

    assert len(marked) == 1
    assert re.match(r"\* +\d+ +(cpu|gpu|accelerator) +\d+ +\d+\.\d ", marked[0])


def test_every_device_states_its_opencl_version(program):
    for line in rows(program)[1]:
        assert re.search(r", OpenCL \d\.\d", line)  # CL_DEVICE_VERSION begins so


def test_devices_are_numbered_from_0(program):
    assert [int(line[1:].split()[0]) for line in rows(program)[1]] == list(
        range(len(rows(program)[1])))


def test_a_missing_platform_names_the_package_to_install(program, without_opencl):
    done = program.run("devices", env=without_opencl)

    assert done.returncode == 1 and done.stdout == ""
    assert "pocl-opencl-icd" in done.stderr


def test_a_render_without_a_platform_names_the_package_and_leaves_nothing(program, tmp_path,
                                                                          without_opencl):
    scene = program.write_scene(tmp_path)

    done = program.run("render", scene, "-o", tmp_path / "out", env=without_opencl)

    assert done.returncode == 1 and "pocl-opencl-icd" in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_render_on_the_default_device_by_its_number_is_the_same(program, tmp_path):
    number = next(line for line in rows(program)[1] if line.startswith("*")).split()[1]
    scene = program.write_scene(tmp_path)

    for out, options in (("a", []), ("b", ["--device", number])):
        done = program.run("render", scene, "-o", tmp_path / out, *options)
        assert done.returncode == 0, done.stderr

    assert (tmp_path / "a/plane.img").read_bytes() == (tmp_path / "b/plane.img").read_bytes()


def test_a_device_that_is_not_there_is_an_error_with_its_number(program, tmp_path):
    done = program.run("render", program.write_scene(tmp_path), "-o", tmp_path / "out", "--device",
                       "33")

    assert done.returncode == 1 and "33" in done.stderr
    assert not (tmp_path / "out").exists()


def test_devices_takes_no_arguments(program):
    done = program.run("devices", "extra")

    assert done.returncode == 2 and "'extra'" in done.stderr


def render_on(program, scene, out, numbers, environment, *options):
    return program.run("render", scene, "-o", out, "--device", numbers, *options,
                       env={**os.environ, **environment})


@pytest.mark.parametrize("kinds, mode", [("pthread pthread", "exact"),
                                         ("basic pthread", "thesis")])
def test_two_devices_give_the_bits_of_one(program, tmp_path, kinds, mode):
    scene = program.write_scene(tmp_path)
    options = ("--size", "160x160", "--mode", mode)  # tiles of 4096 pixels

    for numbers in ("0", "0,1", "1,0"):
        done = render_on(program, scene, tmp_path / numbers, numbers, {"POCL_DEVICES": kinds},
                         *options)
        assert done.returncode == 0 and done.stderr == ""

    one, *others = [[(tmp_path / numbers / name).read_bytes()
                     for name in ("plane.img", "plane_truth.img", "plane.hdr", "plane.exr")]
                    for numbers in ("0", "0,1", "1,0")]
    assert all(other == one for other in others)


def test_the_report_names_all_devices_and_what_each_did(program, tmp_path):
    scene = program.write_scene(tmp_path)

    render_on(program, scene, tmp_path / "out", "0,1", {"POCL_DEVICES": "basic pthread"}, "--size",
              "160x160")

    report = program.load(tmp_path / "out").report
    assert report["device"]["name"].startswith("basic")
    assert ", pthread" in report["device"]["name"]
    assert {"kernel primary", "device 1 kernel primary"} <= report["timings_s"].keys()


@pytest.fixture
def with_oclgrind(tmp_path):
    """An environment with two devices, of PoCL and of Oclgrind 21.10, which does not know all that
    its compiler makes of the kernels: a device that fails at its first tile."""
    library = pathlib.Path("/usr/lib/oclgrind/liboclgrind-rt-icd.so")
    pocl = pathlib.Path("/etc/OpenCL/vendors/pocl.icd")
    if not (library.exists() and pocl.exists()):
        pytest.skip("needs the packages oclgrind and pocl-opencl-icd")
    folder = tmp_path / "both"
    folder.mkdir()
    (folder / "pocl.icd").write_text(pocl.read_text())
    (folder / "oclgrind.icd").write_text(f"{library}\n")
    return {"OCL_ICD_VENDORS": f"{folder}/", "OPENCL_VENDOR_PATH": f"{folder}/"}


def oclgrind_and_pocl(program, environment):
    lines = program.run("devices", env={**os.environ, **environment}).stdout.splitlines()[1:]
    number = {"Oclgrind" in line: line[1:].split()[0] for line in lines}
    return number[True], number[False]


@pytest.mark.parametrize("is_first", [True, False])
def test_a_device_that_fails_leaves_its_tiles_to_the_other_with_a_warning(program, tmp_path,
                                                                          with_oclgrind, is_first):
    scene = program.write_scene(tmp_path)
    bad, good = oclgrind_and_pocl(program, with_oclgrind)
    numbers = f"{bad},{good}" if is_first else f"{good},{bad}"
    options = ("--size", "640x640", "--mode", "thesis")  # so many tiles that the bad one gets some

    alone = render_on(program, scene, tmp_path / "alone", good, with_oclgrind, *options)
    both = render_on(program, scene, tmp_path / "both_devices", numbers, with_oclgrind, *options)

    assert alone.returncode == 0 and both.returncode == 0, both.stderr
    assert f"warning: device {bad} (Oclgrind" in both.stderr and "kernel" in both.stderr
    for name in ("plane.img", "plane_truth.img"):
        assert (tmp_path / "alone" / name).read_bytes() == (
            tmp_path / "both_devices" / name).read_bytes()


# In front of the OpenCL loader: once a file exists, launches on one of the queues fail.
FAILING = r"""
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>
static cl_command_queue bad;
static int queues;
cl_command_queue clCreateCommandQueue(cl_context c, cl_device_id d, cl_command_queue_properties p,
                                      cl_int *e)
{
    cl_command_queue (*next)(cl_context, cl_device_id, cl_command_queue_properties, cl_int *) =
        dlsym(RTLD_NEXT, "clCreateCommandQueue");
    cl_command_queue q = next(c, d, p, e);
    if (queues++ == atoi(getenv("FAILING_QUEUE"))) bad = q;
    return q;
}
cl_int clEnqueueNDRangeKernel(cl_command_queue q, cl_kernel k, cl_uint n, const size_t *o,
                              const size_t *g, const size_t *l, cl_uint w, const cl_event *v,
                              cl_event *e)
{
    cl_int (*next)(cl_command_queue, cl_kernel, cl_uint, const size_t *, const size_t *,
                   const size_t *, cl_uint, const cl_event *, cl_event *) =
        dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel");
    if (q == bad && access(getenv("FAILING_SINCE"), F_OK) == 0) return CL_DEVICE_NOT_AVAILABLE;
    return next(q, k, n, o, g, l, w, v, e);
}
"""


@pytest.mark.parametrize("bad", [0, 1])
def test_a_device_that_fails_at_a_later_time_is_left_out_with_a_warning(program, tmp_path, bad):
    (tmp_path / "failing.c").write_text(FAILING)
    subprocess.run(["cc", "-shared", "-fPIC", "-o", tmp_path / "failing.so", tmp_path / "failing.c",
                    "-ldl"], check=True)
    scene = program.write_scene(
        tmp_path, render={"thermal": "therm"},
        material=[{"name": "wall", "emissivity": 0.9, "density_kg_m3": 2114.0,
                   "specific_heat_j_kg_k": 920.0, "conductivity_w_m_k": 0.689, "thickness_cm": 5.0,
                   "exposed_area": -0.5}],
        weather={"air_temperature_sunrise_c": 15.0, "air_temperature_peak_c": 29.0,
                 "peak_time_h": 15.0, "relative_humidity_sunrise": 0.9, "wind_m_s": 2.0})
    options = ("--size", "320x320", "--time",
               "1992-06-21T10:00:00-04:00,1992-06-21T13:00:00-04:00")
    pocl = {"POCL_DEVICES": "pthread pthread"}
    first, second = "19920621T100000-0400", "19920621T130000-0400"

    alone = render_on(program, scene, tmp_path / "alone", "0", pocl, *options)
    both = render_on(program, scene, tmp_path / "both", "0,1",
                     {**pocl, "LD_PRELOAD": str(tmp_path / "failing.so"), "FAILING_QUEUE": str(bad),
                      "FAILING_SINCE": str(tmp_path / "both" / first / "plane.json")}, *options)

    assert alone.returncode == 0 and both.returncode == 0, both.stderr
    assert f"warning: device {bad} (" in both.stderr and "CL_DEVICE_NOT_AVAILABLE" in both.stderr
    for folder in (first, second):
        assert (tmp_path / "alone" / folder / "plane.img").read_bytes() == (
            tmp_path / "both" / folder / "plane.img").read_bytes()


def test_where_the_only_device_fails_the_render_fails_and_leaves_nothing(program, tmp_path,
                                                                         with_oclgrind):
    bad, _ = oclgrind_and_pocl(program, with_oclgrind)

    done = render_on(program, program.write_scene(tmp_path), tmp_path / "out", bad, with_oclgrind)

    assert done.returncode == 1 and "Oclgrind" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("numbers", ["0,0", "0,", ",1", "0;1", "64", "-1", "", "0 1", "a"])
def test_numbers_that_are_none_are_wrong_usage(program, tmp_path, numbers):
    done = program.run("render", program.write_scene(tmp_path), "-o", tmp_path / "out", "--device",
                       numbers)

    assert done.returncode == 2 and "--device" in done.stderr


def test_of_several_devices_one_that_is_not_there_is_an_error(program, tmp_path):
    done = program.run("render", program.write_scene(tmp_path), "-o", tmp_path / "out", "--device",
                       "0,33")

    assert done.returncode == 1 and "33" in done.stderr
