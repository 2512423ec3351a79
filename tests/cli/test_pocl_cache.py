"""The folder in which PoCL keeps its kernels: chosen so that it can be written, damaged, built into."""
import os
import shutil

import pytest


RAY = "0 0 5 0 0 -1\n"


def trace(program, folder, cache):
    """Builds one kernel, or takes it from the cache."""
    mesh = folder / "floor.obj"
    mesh.write_text("v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n")
    return program.run("trace", mesh, input=RAY, env=with_cache(cache))


@pytest.fixture(scope="module")
def warm(program, tmp_path_factory):
    """A cache that holds the kernel of a trace."""
    folder = tmp_path_factory.mktemp("warm")
    cache = folder / "cache"
    cache.mkdir()
    done = trace(program, folder, cache)
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


def test_all_kernels_of_a_first_render_are_built_for_one_size_of_group(program, tmp_path):
    cache = tmp_path / "cache"
    cache.mkdir()
    done = program.run("render", program.write_scene(tmp_path), "-o", tmp_path / "out",
                       env=with_cache(cache))
    assert done.returncode == 0 and done.stderr == ""

    built = list(cache.rglob("*.so"))
    assert len(built) >= 10
    assert len({path.stem for path in built}) == len(built)


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

    done = trace(program, tmp_path, cache)

    assert done.returncode == 0 and done.stdout == "5,0\n", done.stderr
    assert done.stderr.count(": a damaged kernel of PoCL, which is built again") == count > 0
    again = trace(program, tmp_path, cache)
    assert again.returncode == 0 and again.stderr == ""


def test_a_kernel_with_another_time_and_the_same_bytes_is_kept(program, warm, tmp_path):
    cache = tmp_path / "cache"
    shutil.copytree(warm, cache)
    for path in cache.rglob("*.so"):
        os.utime(path, (0, 0))

    done = trace(program, tmp_path, cache)

    assert done.returncode == 0 and done.stderr == ""


def test_kernels_that_a_killed_run_left_unfinished_are_built_again(program, warm, tmp_path):
    cache = tmp_path / "cache"
    count = damage(warm, cache, "*.so", lambda data: data[:len(data) // 2])
    (cache / "radsig-files").unlink()

    done = trace(program, tmp_path, cache)

    assert done.returncode == 0 and done.stderr.count("a damaged kernel of PoCL") == count > 0


def test_what_another_process_writes_at_this_moment_is_left_alone(program, warm, tmp_path):
    cache = tmp_path / "cache"
    shutil.copytree(warm, cache)
    written = cache / "tempfile_1a2b3c.so"
    written.write_bytes(b"")

    done = trace(program, tmp_path, cache)

    assert done.returncode == 0 and done.stderr == ""
    assert written.exists()
