"""What is printed and does not arrive is a failure: every command ends with 1 and says why."""
import os
import signal
import subprocess

import pytest

SUN = ["sun", "--site=50,8", "--time=2024-06-21T00:00:00Z"]
MANY_SUNS = [*SUN, "--until=2024-06-28T00:00:00Z", "--step-min=1"]  # more than a buffer
FULL = "stdout: No space left on device"

needs_full = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no /dev/full")


def to_full(program, *arguments, **options):
    with open("/dev/full", "w") as full:
        return program.run(*arguments, capture_output=False, stdout=full, stderr=subprocess.PIPE,
                           **options)


@needs_full
@pytest.mark.parametrize("arguments", [
    SUN, MANY_SUNS, ["devices"], ["--help"], ["--version"], ["render", "--help"],
    ["weather", "--help"], ["view", "--help"]], ids=lambda a: " ".join(a[:2]))
def test_a_full_disk_behind_stdout_ends_with_1_and_the_reason(program, arguments):
    done = to_full(program, *arguments)

    assert done.returncode == 1 and done.stderr.endswith(f"{FULL}\n")
    assert done.stderr.count("\n") == 1


@needs_full
def test_a_summary_rays_and_a_share_that_do_not_arrive_end_with_1(program, tmp_path):
    scene, mesh = program.write_scene(tmp_path), tmp_path / "plane.obj"

    for arguments, given in [(["check", scene], ""), (["trace", mesh], "0 0 9 0 0 -1\n"),
                             (["shape-factor", mesh, "--point=0,0,1", "--normal=0,0,1"], "")]:
        done = to_full(program, *arguments, input=given)
        assert done.returncode == 1 and FULL in done.stderr, arguments


def test_a_closed_stdout_ends_with_1_if_something_is_printed(program):
    done = program.run(*SUN, capture_output=False, stderr=subprocess.PIPE,
                       preexec_fn=lambda: os.close(1))

    assert done.returncode == 1 and "stdout: " in done.stderr


def test_a_render_without_standard_streams_writes_the_same_files(program, tmp_path):
    """No file that it opens may become the stream that something is printed to."""
    scene = program.write_scene(tmp_path)

    for name, close in [("open", lambda: None), ("closed", lambda: os.closerange(0, 3))]:
        assert program.run("render", scene, "-o", tmp_path / name, capture_output=False,
                           preexec_fn=close).returncode == 0

    files = {p.name: p.read_bytes() for p in (tmp_path / "open").iterdir() if p.suffix != ".json"}
    for name, expected in files.items():
        assert (tmp_path / "closed" / name).read_bytes() == expected


def test_a_reader_that_closes_its_pipe_ends_a_command_by_sigpipe_quietly(program):
    process = subprocess.Popen([program.path, *MANY_SUNS], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)

    process.stdout.readline()
    process.stdout.close()

    assert process.stderr.read() == ""
    assert process.wait(timeout=60) == -signal.SIGPIPE


def test_rays_without_end_end_when_nobody_reads_what_they_meet(program, tmp_path):
    (tmp_path / "plane.obj").write_text(program.plane)
    process = subprocess.Popen(f"yes '0 0 9 0 0 -1' | {program.path} trace plane.obj", shell=True,
                               cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    process.stdout.readline()
    process.stdout.close()

    assert process.wait(timeout=120) == 128 + signal.SIGPIPE
