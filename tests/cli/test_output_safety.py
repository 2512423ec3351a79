"""What becomes of the files of renders that are killed, that meet links, files of others and each
other. tests/host/output_folder_test.c and staging_folder_test.c have the same without the program."""
import re
import signal
import subprocess
import time

import pytest


def names(folder):
    return sorted(each.name for each in folder.iterdir())


def start(program, scene, folder, size="2000x2000", **options):
    """A render that takes a while, once it has begun to write."""
    before = names(folder) if folder.exists() else []
    process = subprocess.Popen([program.path, "render", scene, "-o", folder, "--size", size],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and (not folder.exists() or names(folder) == before):
        time.sleep(0.01)
    assert process.poll() is None
    return process


def finish(process):
    _, stderr = process.communicate(timeout=120)
    return process.returncode, stderr


@pytest.fixture
def scene(program, tmp_path):
    return program.write_scene(tmp_path)


def test_what_a_killed_render_left_goes_with_the_next(program, scene, tmp_path):
    process = start(program, scene, tmp_path / "out")
    process.kill()
    process.wait()
    assert re.fullmatch(r"\.radsig-\w{6}", " ".join(names(tmp_path / "out")))

    assert program.run("render", scene, "-o", tmp_path / "out").returncode == 0

    assert [name for name in names(tmp_path / "out") if not name.startswith("plane")] == []


def test_a_render_leaves_what_a_running_one_writes(program, scene, tmp_path):
    process = start(program, scene, tmp_path / "out", size="500x400")
    process.send_signal(signal.SIGSTOP)

    assert program.run("render", scene, "-o", tmp_path / "out").returncode == 0

    process.send_signal(signal.SIGCONT)
    assert finish(process)[0] == 0
    got = program.load(tmp_path / "out")
    assert got.planes["radiance_lwir"].shape == (400, 500)


def test_of_renders_at_once_one_whole_set_stands_in_the_folder(program, scene, tmp_path):
    processes = [subprocess.Popen([program.path, "render", scene, "-o", tmp_path / "out", "--size",
                                   size]) for size in ("48x32", "64x48", "32x16")]

    assert [each.wait(timeout=120) for each in processes] == [0, 0, 0]

    got = program.load(tmp_path / "out")  # which takes the size from the headers
    columns, rows = got.report["image"]["columns"], got.report["image"]["rows"]
    assert {plane.shape for plane in got.planes.values()} == {(rows, columns)}
    assert (tmp_path / "out" / "plane.img").stat().st_size == 4 * columns * rows
    assert all(name.startswith("plane") for name in names(tmp_path / "out"))


def test_links_in_the_place_of_files_are_replaced_and_not_followed(program, scene, tmp_path):
    victim = tmp_path / "victim"
    victim.write_text("precious")
    out = tmp_path / "out"
    assert program.run("render", scene, "-o", out).returncode == 0
    files = names(out)
    for each in out.iterdir():
        each.unlink()
        each.symlink_to(victim)

    assert program.run("render", scene, "-o", out).returncode == 0

    assert victim.read_text() == "precious" and names(out) == files
    assert not any(each.is_symlink() for each in out.iterdir())


def test_replaced_files_keep_their_permissions(program, scene, tmp_path):
    out = tmp_path / "out"
    assert program.run("render", scene, "-o", out).returncode == 0
    (out / "plane.img").chmod(0o600)
    (out / "plane.json").chmod(0o664)

    assert program.run("render", scene, "-o", out, umask=0o077).returncode == 0

    assert (out / "plane.img").stat().st_mode & 0o777 == 0o600
    assert (out / "plane.json").stat().st_mode & 0o777 == 0o664


@pytest.mark.parametrize("sent", [signal.SIGHUP, signal.SIGINT, signal.SIGTERM])
def test_a_render_that_is_ended_leaves_the_old_files_alone(program, scene, tmp_path, sent):
    out = tmp_path / "out"
    assert program.run("render", scene, "-o", out).returncode == 0
    before = {each.name: each.read_bytes() for each in out.iterdir()}
    process = start(program, scene, out)

    process.send_signal(sent)

    code, stderr = finish(process)
    assert code == 130 and "interrupted" in stderr
    assert {each.name: each.read_bytes() for each in out.iterdir()} == before


def test_a_render_under_nohup_goes_on_after_sighup(program, scene, tmp_path):
    process = start(program, scene, tmp_path / "out", size="500x400",
                    preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))

    process.send_signal(signal.SIGHUP)

    assert finish(process)[0] == 0


def test_the_longest_names_make_every_file(program, tmp_path):
    scene = program.write_scene(tmp_path, name="n" * 100,
                                band=[{"name": "b" * 100, "wavelength_um": [8.0, 14.0], "count": 2}])
    whole = ",".join(f"{kind}_{'b' * 100}_1" for kind in ("reflected_background", "transmission"))

    done = program.run("render", scene, "-o", tmp_path / "out", "--planes", whole, "--probe", "7,5")

    assert done.returncode == 0, done.stderr
    got = program.load(tmp_path / "out", "n" * 100)
    assert set(got.planes) == {*whole.split(","), *(f"radiance_{'b' * 100}_{i}" for i in (0, 1))}
    assert (tmp_path / "out" / f"{'n' * 100}_reflected_background_{'b' * 100}_1.png").exists()
