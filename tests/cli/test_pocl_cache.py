"""The folder in which PoCL keeps its kernels: chosen so that it can be written, damaged, built into."""
import os
import shutil

import pytest


@pytest.fixture(scope="module")
def warm(program, tmp_path_factory):
    """A cache that holds the kernels of a small scene."""
    folder = tmp_path_factory.mktemp("warm")
    scene = program.write_scene(folder)
    cache = folder / "cache"
    cache.mkdir()
    done = program.run("render", scene, "-o", folder / "out", env=with_cache(cache))
    assert done.returncode == 0 and done.stderr == ""
    return cache


def with_cache(cache):
    return {**os.environ, "POCL_CACHE_DIR": str(cache)}


def without_home(**changes):
    """An environment in which PoCL's own folder cannot be made, for root neither."""
    kept = {k: v for k, v in os.environ.items() if k not in ("POCL_CACHE_DIR", "XDG_RUNTIME_DIR")}
    return {**kept, "XDG_CACHE_HOME": "/dev/null", **changes}


def test_a_folder_of_its_own_takes_the_place_of_one_that_cannot_be_written(program, tmp_path):
    done = program.run("devices", env=without_home(TMPDIR=str(tmp_path)))

    own = tmp_path / f"radsig-{os.geteuid()}" / "pocl"
    assert done.returncode == 0 and own.is_dir()
    assert (f"warning: PoCL keeps its kernels in {own}, because /dev/null/pocl/kcache cannot be written"
            in done.stderr)
    assert own.parent.stat().st_mode & 0o777 == 0o700


def test_a_folder_that_others_can_write_is_not_taken(program, tmp_path):
    foreign = tmp_path / f"radsig-{os.geteuid()}"
    foreign.mkdir()
    foreign.chmod(0o777)

    done = program.run("devices", env=without_home(XDG_RUNTIME_DIR=str(tmp_path),
                                                   TMPDIR=str(tmp_path)))

    assert done.returncode == 0 and list(foreign.iterdir()) == []


def test_a_stated_folder_that_cannot_be_written_is_named(program):
    done = program.run("devices", env=with_cache("/dev/null/kernels"))

    assert done.returncode == 1 and "/dev/null/kernels cannot be written" in done.stderr
    assert "POCL_CACHE_DIR" in done.stderr and "pocl-opencl-icd" not in done.stderr


def test_all_kernels_of_a_first_render_are_built_for_one_size_of_group(warm):
    built = list(warm.rglob("*.so"))

    assert len(built) >= 10
    assert len({path.stem for path in built}) == len(built)


def test_a_first_render_notes_that_the_cache_has_its_kernels(warm):
    assert len(list(warm.glob("radsig-" + "[0-9a-f]" * 16))) == 1


DAMAGES = [("*.so", lambda data: data[:len(data) // 2]), ("*.so", lambda data: bytes(len(data))),
           ("*.so", lambda data: b""), ("program.bc", lambda data: data[:len(data) // 2]),
           ("program.bc", lambda data: bytes(len(data)))]


def damage(warm, cache, pattern, change):
    """Copies a cache and changes its files; returns how many."""
    shutil.copytree(warm, cache)
    files = [path for path in cache.rglob(pattern)]
    for path in files:
        path.write_bytes(change(path.read_bytes()))
    return len(files)


@pytest.mark.parametrize("pattern, change", DAMAGES)
def test_damaged_kernels_are_told_and_built_again(program, warm, tmp_path, pattern, change):
    cache = tmp_path / "cache"
    count = damage(warm, cache, pattern, change)

    done = program.run("render", program.write_scene(tmp_path), "-o", tmp_path / "out",
                       env=with_cache(cache))

    assert done.returncode == 0, done.stderr
    assert done.stderr.count(": a damaged kernel of PoCL, which is built again") == count > 0
    again = program.run("render", tmp_path / "scene.toml", "-o", tmp_path / "out", env=with_cache(cache))
    assert again.returncode == 0 and again.stderr == ""


def test_kernels_that_a_killed_run_left_unfinished_are_built_again(program, warm, tmp_path):
    cache = tmp_path / "cache"
    count = damage(warm, cache, "*.so", lambda data: data[:len(data) // 2])
    (cache / "radsig-files").unlink()

    done = program.run("render", program.write_scene(tmp_path), "-o", tmp_path / "out",
                       env=with_cache(cache))

    assert done.returncode == 0 and done.stderr.count("a damaged kernel of PoCL") == count
