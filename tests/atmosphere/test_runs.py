"""How radsig-atmosphere runs LOWTRAN: beside it, interrupted, with nothing left behind."""

import os
import pathlib
import shutil
import signal
import subprocess
import time

import pytest

BUILD = pathlib.Path(__file__).parents[2] / "build"
VISIBLE = pathlib.Path(__file__).parents[2] / "scenes/atmosphere/june24_1500z_vis.toml"


@pytest.fixture
def moved(atmosphere, tmp_path):
    """The two programs in another folder."""
    folder = tmp_path / "a folder"
    folder.mkdir()
    for name in ("radsig-atmosphere", "radsig-lowtran"):
        shutil.copy(BUILD / name, folder)
    return folder


def test_the_programs_work_in_any_folder(moved, tmp_path):
    lwir = VISIBLE.with_name("june24_lwir.toml")
    subprocess.run([moved / "radsig-atmosphere", "make", lwir, "-o", "x.radc"], cwd=tmp_path, check=True)

    assert (tmp_path / "x.radc").read_bytes() == VISIBLE.with_name("june24_lwir_12.radc").read_bytes()


def test_without_radsig_lowtran_it_tells_how_to_build_it(moved, tmp_path):
    (moved / "radsig-lowtran").unlink()
    done = subprocess.run([moved / "radsig-atmosphere", "cloud", "stratus", "-o", tmp_path / "x.ext"],
                          capture_output=True, text=True)

    assert done.returncode == 1
    assert "a folder/radsig-lowtran: No such file or directory (make atmosphere builds it)" in done.stderr


def start(folder):
    """Runs in a session of its own, with a folder for its work, once LOWTRAN runs."""
    (folder / "scratch").mkdir()
    (folder / "x.radc").write_text("old")
    started = subprocess.Popen([BUILD / "radsig-atmosphere", "make", VISIBLE, "-o", folder / "x.radc"],
                               env={**os.environ, "TMPDIR": str(folder / "scratch")}, stderr=subprocess.PIPE,
                               start_new_session=True)
    while not list((folder / "scratch").glob("*/*/TAPE5")):
        assert started.poll() is None
        time.sleep(0.01)
    return started


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_an_interrupted_run_leaves_the_old_file_and_nothing_else(atmosphere, tmp_path, number):
    started = start(tmp_path)
    os.killpg(started.pid, number)  # as a terminal does, to LOWTRAN's processes too
    said = started.communicate()[1]

    assert started.returncode == 130 and b"interrupted" in said
    assert (tmp_path / "x.radc").read_text() == "old"
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["scratch", "x.radc"]


def test_an_interrupt_of_the_program_alone_ends_lowtran_too(atmosphere, tmp_path):
    started = start(tmp_path)
    begin = time.monotonic()
    started.send_signal(signal.SIGINT)
    started.communicate()

    assert started.returncode == 130
    assert time.monotonic() - begin < 2  # a tenth of a second, and what else CI's processors do
    assert not subprocess.run(["pgrep", "-g", str(started.pid)], capture_output=True).stdout


def test_children_that_others_started_are_left_alone(atmosphere, tmp_path):
    # the shell becomes radsig-atmosphere, and its sleep that program's child, which ends meanwhile
    done = subprocess.run(
        ["sh", "-c", 'sleep 0.1 & exec "$@"', "sh", BUILD / "radsig-atmosphere", "make", VISIBLE,
         "-o", tmp_path / "x.radc"], capture_output=True, text=True)

    assert done.returncode == 0, done.stderr


def test_what_a_killed_run_left_goes_with_the_next(atmosphere, tmp_path):
    started = start(tmp_path)
    os.killpg(started.pid, signal.SIGKILL)
    started.communicate()
    assert len(list((tmp_path / "scratch").iterdir())) == 1

    subprocess.run([BUILD / "radsig-atmosphere", "cloud", "stratus", "-o", tmp_path / "x.ext"], check=True,
                   env={**os.environ, "TMPDIR": str(tmp_path / "scratch")})

    assert list((tmp_path / "scratch").iterdir()) == []


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no /dev/full")
def test_what_is_printed_and_does_not_arrive_ends_with_1(atmosphere):
    for arguments in (["--help"], ["--version"], ["make", "--help"], ["show", VISIBLE.with_name("june24_lwir_12.radc")]):
        with open("/dev/full", "w") as full:
            done = subprocess.run([BUILD / "radsig-atmosphere", *arguments], stdout=full, stderr=subprocess.PIPE)
        assert done.returncode == 1 and b"stdout: No space left on device" in done.stderr


def test_by_night_one_run_serves_all_azimuths(atmosphere, tmp_path):
    decks = tmp_path / "decks"
    atmosphere("make", VISIBLE.with_name("january_night.toml"), "-o", tmp_path / "x.radc", "--keep-decks", decks)
    sky = [path.read_text() for path in decks.glob("sky_*")]

    assert len(sky) == 1 + 18 * 5  # the zenith, and azimuths from 0 to 360 at each other angle
    assert len(set(sky)) == 1 + 18


@pytest.mark.parametrize("output", ["absent/x.ext", "folder", "/dev/null"])
def test_an_output_that_cannot_be_written_is_told_of_before_any_run(atmosphere, tmp_path, output):
    (tmp_path / "folder").mkdir()
    before = os.times().children_user
    done = atmosphere("cloud", "cumulus", "-o", tmp_path / output, code=1)

    assert str(tmp_path / output) in done.stderr
    assert os.times().children_user - before < 1.0  # its 2 x 50 runs take some seconds
