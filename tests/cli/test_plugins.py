"""Plug-ins: OpenImageIO is loaded by those runs alone that write pictures, from beside the program or
from where it is installed."""
import shutil
import subprocess

import pytest
from built_program import RADSIG, write_scene

IMAGE = RADSIG.parent / "plugins" / "image.so"


@pytest.fixture
def copied(tmp_path):
    """Runs a copy of the program, beside which stand no plug-ins."""
    folder = tmp_path / "prefix" / "bin"
    folder.mkdir(parents=True)
    shutil.copy(RADSIG, folder / "radsig")

    def run(*arguments):
        return subprocess.run([folder / "radsig", *map(str, arguments)], capture_output=True,
                              text=True, timeout=300)

    run.folder = folder
    return run


def render(run, tmp_path):
    return run("render", write_scene(tmp_path), "-o", tmp_path / "out")


def test_the_program_is_not_linked_to_openimageio():
    linked = subprocess.run(["ldd", RADSIG], capture_output=True, text=True, check=True).stdout

    assert "libOpenCL" in linked and "OpenImageIO" not in linked
    assert len(linked.splitlines()) < 20  # with OpenImageIO there were 263


def test_a_render_without_the_plugin_writes_nothing_and_names_both_places(copied, tmp_path):
    done = render(copied, tmp_path)

    assert done.returncode == 1
    assert str(copied.folder / "plugins" / "image.so") in done.stderr
    assert str(copied.folder / "../lib/radsig/image.so") in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_check_needs_no_plugin(copied, tmp_path):
    assert copied("check", write_scene(tmp_path)).returncode == 0


def test_an_installed_program_finds_the_plugin_under_lib(copied, tmp_path):
    installed = copied.folder.parent / "lib" / "radsig"
    installed.mkdir(parents=True)
    shutil.copy(IMAGE, installed)

    done = render(copied, tmp_path)

    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "plane.exr").exists()


def test_a_damaged_plugin_is_named_with_what_the_loader_says(copied, tmp_path):
    plugin = copied.folder / "plugins" / "image.so"
    plugin.parent.mkdir()
    plugin.write_bytes(b"no library " * 1000)

    done = render(copied, tmp_path)

    assert done.returncode == 1
    assert f"{plugin}: cannot be loaded: " in done.stderr and "invalid ELF header" in done.stderr


def test_a_plugin_of_another_version_is_refused(copied, tmp_path):
    version = copied("--version").stdout.split()[1]
    plugin = copied.folder / "plugins" / "image.so"
    plugin.parent.mkdir()
    other = "9" * len(version)
    plugin.write_bytes(IMAGE.read_bytes().replace(f"{version}\0".encode(), f"{other}\0".encode()))

    done = render(copied, tmp_path)

    assert done.returncode == 1
    assert f"{plugin}: found version {other}, expected {version}" in done.stderr


def test_a_plot_fails_for_want_of_the_plugin_before_anything_is_read(copied):
    done = copied("thermal", "--plot", "x.png", "--materials", "absent.mat", "--material", "grass",
                  "--weather", "absent.wth", "--site", "40,-80", "--date", "1992-06-21",
                  "--utc-offset", "-4", "--thickness-cm", "5")

    assert done.returncode == 1
    assert "image.so" in done.stderr and "absent" not in done.stderr
