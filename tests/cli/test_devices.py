"""radsig devices, and what is said where OpenCL is missing or wrong."""
import os
import re

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
