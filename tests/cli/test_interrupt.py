"""Ctrl-C: work of every stage ends soon, with 130, and leaves nothing."""
import signal
import subprocess
import time

import pytest

BOUND_S = 3.0  # half a second on an idle machine; tests have others beside them


def begin(program, scene, folder, *options):
    """A render that takes a while; its kernels are in PoCL's cache."""
    assert program.run("render", scene, "-o", folder / "warm", "--size", "8x8", *options).returncode == 0
    return subprocess.Popen([program.path, "render", scene, "-o", folder / "out", "--size", "6000x4000",
                             *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


@pytest.mark.parametrize("options", [[], ["--mode", "thesis"]])
@pytest.mark.parametrize("after_s", [0.1, 0.6, 1.5, 4.0])  # reading, the tree, facets, pixels
def test_an_interrupt_ends_a_render_soon(program, airport, tmp_path, options, after_s):
    process = begin(program, airport, tmp_path, *options)
    time.sleep(after_s)

    process.send_signal(signal.SIGINT)
    sent = time.monotonic()
    message = process.communicate(timeout=60)[1]

    assert process.returncode == 130 and message.endswith("radsig render: interrupted\n")
    assert time.monotonic() - sent < BOUND_S
    assert not (tmp_path / "out").exists()


def test_the_second_interrupt_ends_the_process_at_once(program, airport, tmp_path):
    process = begin(program, airport, tmp_path)
    time.sleep(0.6)

    while process.poll() is None:
        process.send_signal(signal.SIGINT)
        time.sleep(0.001)

    assert process.returncode in (130, -signal.SIGINT)
