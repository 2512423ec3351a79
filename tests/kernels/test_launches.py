"""The launches that kernels/launches.py makes from the kernels' signatures: what compiles, and what does not."""
import pathlib
import subprocess

import numpy as np
import pytest
import records
from opencl import launches

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def generated(tmp_path_factory):
    folder = tmp_path_factory.mktemp("generated")
    launches.main(folder)
    return folder


@pytest.fixture
def errors_of(generated, tmp_path):
    """The compiler's errors for a function body that works with dev, hits and backgrounds."""
    def compile_(body):
        path = tmp_path / "snippet.c"
        path.write_text('#include "launches.h"\n'
                        "status snippet(device *dev, hit_record_buffer hits,\n"
                        "               background_record_buffer backgrounds);\n"
                        "status snippet(device *dev, hit_record_buffer hits,\n"
                        "               background_record_buffer backgrounds)\n"
                        f"{{\n{body}\n}}\n")
        folders = [f"-I{ROOT}", f"-I{ROOT}/host", f"-I{ROOT}/kernels", f"-I{generated}"]
        done = subprocess.run(["gcc", "-std=c11", "-fsyntax-only", *folders, str(path)],
                              capture_output=True, text=True)
        return [line for line in done.stderr.split("\n") if "error:" in line]
    return compile_


def launch(arguments):
    return f"return background_hit_run(dev, shape1(1), &(background_hit_args){{{arguments}}});"


def test_buffers_of_the_declared_types_compile(errors_of):
    assert errors_of(launch(".count = 1, .background = backgrounds, .hit = hits")) == []


def test_a_buffer_of_another_type_does_not_compile(errors_of):
    errors = errors_of(launch(".count = 1, .background = hits, .hit = hits"))

    assert len(errors) == 1 and "hit_record_buffer" in errors[0]


def test_a_misspelt_argument_does_not_compile(errors_of):
    errors = errors_of(launch(".count = 1, .backgroud = backgrounds, .hit = hits"))

    assert "has no member named" in errors[0] and "backgroud" in errors[0]


@pytest.mark.parametrize("call", ["device_allocate(dev, &hits, 1, other)",
                                  "device_upload(dev, hits, 1, other)",
                                  "device_download(dev, hits, 1, other)",
                                  "device_map(dev, hits, 1, (const background_record **)&other)"])
def test_host_memory_of_other_elements_does_not_compile(errors_of, call):
    right = call.replace("background_record", "hit_record")
    assert errors_of(f"hit_record *other = 0; return {right};") == []
    assert errors_of(f"background_record *other = 0; return {call};") != []


@pytest.fixture
def read(tmp_path):
    """Reads the signature of a kernel `some`, and headers."""
    def read_(signature, **headers):
        for name, text in headers.items():
            (tmp_path / f"{name}.h").write_text(text)
        (tmp_path / "some.cl").write_text(f"\n/* kernel void not(const uint this)\n{{ */\n{signature}\n{{\n}}\n")
        return launches.read(tmp_path)[0]
    return read_


def test_values_and_buffers_are_told_apart(read):
    kernel = read("kernel void some(const uint count, global const float *in,\n"
                  "                 OPTIONAL global const uint *order, global float *out)")

    assert [(a.name, a.type, a.is_buffer, a.is_optional, a.is_input) for a, _ in kernel.arguments] == [
        ("count", "uint", False, False, True), ("in", "float", True, False, True),
        ("order", "uint", True, True, True), ("out", "float", True, False, False)]


def test_a_shared_body_is_a_function_that_the_kernel_calls_and_its_lines_stay(read):
    kernel = read("SHARED_BODY kernel void some(const uint count, TABLES(TREE_TABLES),\n"
                  "                             global float *out)", tree=TREE)
    text = ("/* Some. */\nSHARED_BODY kernel void some(const uint count, TABLES(TREE_TABLES),\n"
            "                             global float *out)\n{\n    out[get_global_id(0)] = 0.0f;\n}\n")

    made = launches.with_shared_body(kernel, text)

    assert made.split("\n")[4] == "    out[BODY_ID(0)] = 0.0f;"
    assert "some_shared_body(count, world, nodes, out, get_global_id(0), get_global_id(1));" in made
    assert launches.with_shared_body(kernel, text.replace("SHARED_BODY ", "")).count("BODY") == 0


TREE = """#define TREE_TABLES(TABLE, AND) \\
    TABLE(world_record, world) AND \\
    TABLE(OPTIONAL global const bvh_node *, nodes)
"""


def test_a_group_stands_for_its_tables(read):
    kernel = read("kernel void some(TABLES(TREE_TABLES), global float *out)", tree=TREE)

    assert [".".join(names) for _, names in kernel.arguments] == ["tree.world", "tree.nodes", "out"]
    assert [a.is_optional for a, _ in kernel.arguments] == [False, True, False]


@pytest.mark.parametrize("signature, message", [
    ("kernel void some(float *out)", "some.cl:4: found 'float *out', expected `const TYPE name`"),
    ("kernel void some(TABLES(SKY_TABLES))", "some.cl:4: found 'TABLES(SKY_TABLES)', expected"),
    ("kernel void other(const uint n)", "some.cl:1: found the kernels other, expected the one kernel some"),
    ("kernel void some(" + ", ".join(f"const uint a{i}" for i in range(1 + launches.PARAMETERS)) + ")",
     f"some.cl:4: found {1 + launches.PARAMETERS} parameters, expected {launches.PARAMETERS} or fewer")])
def test_a_signature_that_says_something_else_is_refused(read, signature, message):
    with pytest.raises(launches.Mistake) as mistake:
        read(signature)
    assert message in str(mistake.value)


def test_a_group_that_lists_something_else_is_refused(read):
    with pytest.raises(launches.Mistake) as mistake:
        read("kernel void some(TABLES(TREE_TABLES))", tree=TREE.replace(" AND \\", " \\"))
    assert "tree.h:1: found 'TABLE(world_record, world) TABLE(" in str(mistake.value)


@pytest.fixture
def by_name(opencl):
    """Binds background_hit's arguments, some of them changed."""
    right = {"count": 1, "background": np.zeros(1, records.BACKGROUND), "hit": np.zeros(1, records.HIT)}
    return lambda **changed: opencl.bind("background_hit", {**right, **changed})


def test_tests_launch_by_the_same_names(by_name):
    arguments, written = by_name()

    assert len(arguments) == 3 and [array.dtype for array, _ in written] == [records.HIT]


@pytest.mark.parametrize("changed, message", [
    ({"hit": None}, "kernel background_hit: hit is missing"),
    ({"order": 1}, "kernel background_hit: there is no order"),
    ({"background": np.zeros(1, records.HIT)}, "kernel background_hit: background is .*, expected background_record"),
    ({"hit": np.zeros((4, 2), records.HIT)[:, 0]}, "hit is written and not contiguous")])
def test_tests_are_told_what_does_not_fit_the_signature(by_name, changed, message):
    with pytest.raises(TypeError, match=message):
        by_name(**changed)
