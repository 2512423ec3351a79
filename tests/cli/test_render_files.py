"""What radsig render leaves in the folder: files, options that change them, and nothing after a
failure."""
import hashlib
import json
import os
import pty
import resource
import shutil
import signal
import subprocess
import time

import numpy as np
import pytest

TRUTH = ["material", "background_material", "sunlit", "background_sunlit", "temperature_c",
         "background_temperature_c", "interaction", "view_angle_deg", "shape_factor", "range_m",
         "facet"]
OF_BAND = ["counts_{}", "apparent_temperature_{}_c", "emissivity_{}", "background_emissivity_{}"]
TWO = [{"name": "lwir", "wavelength_um": [8.0, 14.0]},
       {"name": "mwir", "wavelength_um": [3.0, 5.0]}]
MANY = [{"name": f"b{i:02}", "wavelength_um": [8.0 + 0.1 * i, 8.1 + 0.1 * i]} for i in range(17)]


def names(folder):
    return sorted(each.name for each in folder.iterdir())


def contents(folder):
    return {each.name: each.read_bytes() for each in folder.iterdir()}


def images(folder, name="plane"):
    """The files whose bytes depend on nothing but the inputs: all but the report's timings."""
    return {k: v for k, v in contents(folder).items() if k != f"{name}.json"}


@pytest.fixture(scope="module")
def made(program, tmp_path_factory):
    """A render of two bands; `scene` is its file."""
    folder = tmp_path_factory.mktemp("files")
    got = program.render(folder, band=TWO)
    got.scene = folder / "scene.toml"
    return got


def rendered(program, scene, folder, *options):
    done = program.run("render", scene, "-o", folder, *options)
    assert done.returncode == 0, done.stderr
    return program.load(folder)


def test_a_render_is_silent_where_stderr_is_no_terminal(program, made, tmp_path):
    done = program.run("render", made.scene, "-o", tmp_path / "out")

    assert done.returncode == 0 and done.stdout == "" and done.stderr == ""


def test_a_render_shows_progress_on_a_terminal(program, made, tmp_path):
    try:
        ours, theirs = pty.openpty()
    except OSError as error:
        pytest.skip(f"this system has no terminals to lend: {error}")
    done = program.run("render", made.scene, "-o", tmp_path / "out", capture_output=False,
                       stdout=subprocess.PIPE, stderr=theirs)
    shown = os.read(ours, 65536).decode()
    os.close(ours)
    os.close(theirs)

    assert done.returncode == 0 and done.stdout == ""
    assert "100 %" in shown and "plane" in shown


def test_every_plane_of_the_contract_is_written(made):
    wanted = ["radiance_lwir", "radiance_mwir", *TRUTH]
    wanted += [name.format(band) for band in ("lwir", "mwir") for name in OF_BAND]

    assert set(made.planes) >= set(wanted)
    assert list(made.planes)[:2] == wanted[:2] and len(made.header["band names"]) == 2


def test_the_files_are_those_of_the_contract(made):
    wanted = [f"plane{end}" for end in (".img", ".hdr", "_truth.img", "_truth.hdr", ".exr",
                                        ".json")]
    wanted += [f"plane_{name}.png" for name in made.planes]

    assert names(made.folder) == sorted(wanted)


def test_a_second_run_leaves_the_same_bytes(program, made, tmp_path):
    shutil.copytree(made.folder, tmp_path / "out")

    rendered(program, made.scene, tmp_path / "out")

    assert images(tmp_path / "out") == images(made.folder)


def test_a_render_replaces_an_earlier_one_of_its_name(program, made, tmp_path):
    shutil.copytree(made.folder, tmp_path / "out")

    got = rendered(program, made.scene, tmp_path / "out", "--size", "3x2", "--set",
                   "material.0.temperature_k=350")

    assert got.planes["radiance_lwir"].shape == (2, 3)
    assert got.planes["temperature_c"] == pytest.approx(76.85, abs=1e-3)
    assert names(tmp_path / "out") == names(made.folder)


def test_files_of_others_stay_in_the_folder(program, made, tmp_path):
    (tmp_path / "notes.txt").write_text("mine")

    rendered(program, made.scene, tmp_path)

    assert (tmp_path / "notes.txt").read_text() == "mine"


def test_the_folder_is_made_with_its_parents(program, made, tmp_path):
    rendered(program, made.scene, tmp_path / "a" / "b" / "c")

    assert (tmp_path / "a/b/c/plane.img").exists()


def test_the_report_names_inputs_with_their_hashes(made):
    for each in made.report["inputs"]:
        data = (made.scene.parent / each["path"]).read_bytes()
        assert each["sha256"] == hashlib.sha256(data).hexdigest()
        assert each["bytes"] == len(data)
    assert [os.path.basename(each["path"]) for each in made.report["inputs"]] == ["scene.toml",
                                                                                  "plane.obj"]


@pytest.mark.parametrize("change", [lambda path: path.unlink(),
                                    lambda path: path.rename(path.with_suffix(".old")),
                                    lambda path: path.write_text(path.read_text() + "# edited\n")])
def test_inputs_that_change_while_it_renders_have_the_hash_of_what_was_used(program, tmp_path, change):
    scene = program.write_scene(tmp_path)
    inputs = [scene, tmp_path / "plane.obj"]
    used = [hashlib.sha256(path.read_bytes()).hexdigest() for path in inputs]
    work = subprocess.Popen([program.path, "render", scene, "-o", tmp_path / "out",
                             "--size", "1200x1200"], stderr=subprocess.PIPE)
    while not any(tmp_path.glob("out/.radsig-*/*")):  # the scene is read then
        assert work.poll() is None
        time.sleep(0.005)
    for path in inputs:
        change(path)

    assert work.wait() == 0, work.stderr.read()
    report = json.loads((tmp_path / "out/plane.json").read_text())
    assert [each["sha256"] for each in report["inputs"]] == used


def test_the_report_is_json_whatever_the_paths_bytes_are(program, tmp_path):
    folder = os.fsencode(tmp_path) + b"/caf\xe9 \xc0\x80"  # Latin-1, an overlong form
    os.mkdir(folder)
    program.write_scene(tmp_path)
    for name in (b"scene.toml", b"plane.obj"):
        shutil.copy(os.fsencode(tmp_path) + b"/" + name, folder)

    done = subprocess.run([os.fsencode(program.path), b"render", folder + b"/scene.toml", b"-o",
                           os.fsencode(tmp_path) + b"/out"], capture_output=True)

    assert done.returncode == 0, done.stderr
    report = json.loads((tmp_path / "out/plane.json").read_text(encoding="utf-8"))
    assert report["scene_path"].endswith("/caf\u00e9 \u00c0\u0080/scene.toml")


def test_the_report_says_with_what_and_how(program, made):
    report = made.report
    version = program.run("--version").stdout.strip()

    assert report["program"] == version and report["mode"] == "exact"
    assert report["thermal"] == "fixed" and report["time"] == "1992-06-21T13:20:00-04:00"
    assert report["image"] == {"columns": 8, "rows": 6}
    assert report["device"]["name"] in program.run("devices").stdout
    assert report["settings"]["hemisphere_step_deg.zenith"] == 15
    assert report["materials"] == [{"number": 1, "name": "wall"}]
    assert [each["name"] for each in report["bands"]] == ["lwir", "mwir"]
    assert [each["name"] for each in report["planes"]] == list(made.planes)


def test_bands_leaves_out_the_others_and_changes_nothing(program, made, tmp_path):
    got = rendered(program, made.scene, tmp_path, "--bands", "mwir")

    assert not any("lwir" in name for name in names(tmp_path))
    assert list(got.header["band names"]) == ["radiance_mwir"]
    # the uniform atmosphere's grid starts at the band's edge: rounding alone
    assert got.planes["radiance_mwir"] == pytest.approx(made.planes["radiance_mwir"], rel=2e-6)


def test_planes_writes_those_beside_the_cube(program, made, tmp_path):
    got = rendered(program, made.scene, tmp_path, "--planes", "range_m,counts_mwir")

    assert list(got.planes) == ["radiance_lwir", "radiance_mwir", "range_m", "counts_mwir"]
    assert (tmp_path / "plane.img").read_bytes() == (made.folder / "plane.img").read_bytes()


def test_size_is_columns_by_rows(program, made, tmp_path):
    got = rendered(program, made.scene, tmp_path, "--size", "5x3")

    assert got.planes["range_m"].shape == (3, 5)


def test_mode_and_time_stand_in_the_report(program, made, tmp_path):
    got = rendered(program, made.scene, tmp_path, "--mode", "thesis", "--time",
                   "1992-06-21T23:20:00-04:00")

    assert got.report["mode"] == "thesis" and got.report["time"] == "1992-06-21T23:20:00-04:00"
    assert got.header["acquisition time"] == "1992-06-22T03:20:00Z"
    assert (got.planes["sunlit"] == 0).all() and (made.planes["sunlit"] == 1).all()
    assert any("shape_factor [thesis" in name for name in got.truth_header["band names"])


def test_a_set_value_is_the_scenes(program, made, tmp_path):
    got = rendered(program, made.scene, tmp_path, "--set", "camera.position_m=[0,0,30]")

    assert got.planes["range_m"].min() == pytest.approx(30, rel=0.01)


@pytest.fixture(scope="module")
def many(program, tmp_path_factory):
    """A render of 17 bands, one more than are written in full."""
    folder = tmp_path_factory.mktemp("many")
    got = program.render(folder, band=MANY)
    got.scene = folder / "scene.toml"
    return got


def test_above_16_bands_the_cube_and_the_planes_of_no_band_are_written(many):
    assert many.header["band names"] == [f"radiance_b{i:02}" for i in range(17)]
    assert set(many.planes) >= set(TRUTH)
    assert not any(name.split(" ")[0].endswith(("_b00", "_b00_c"))
                   for name in many.truth_header["band names"])
    assert not (many.folder / "plane.exr").exists()


def test_above_16_bands_three_bands_become_pictures(many):
    pictures = [name for name in names(many.folder) if name.startswith("plane_radiance_")]

    assert pictures == [f"plane_radiance_b{i}.png" for i in ("00", "08", "16")]


def test_above_16_bands_the_exr_is_written_on_request(program, many, tmp_path):
    rendered(program, many.scene, tmp_path, "--exr")

    assert (tmp_path / "plane.exr").stat().st_size > 0


def assert_nothing_new(done, folder, code=1):
    assert done.returncode == code and done.stdout == ""
    assert not folder.exists()


def test_a_bad_scene_writes_nothing(program, tmp_path):
    scene = program.write_scene(tmp_path, camera={"pixels": [0, 0]})

    assert_nothing_new(program.run("render", scene, "-o", tmp_path / "out"), tmp_path / "out")


def test_a_folder_that_cannot_be_made_is_an_error(program, made, tmp_path):
    (tmp_path / "file").write_text("mine")

    done = program.run("render", made.scene, "-o", tmp_path / "file" / "out")

    assert done.returncode == 1 and str(tmp_path / "file") in done.stderr
    assert names(tmp_path) == ["file"] and (tmp_path / "file").read_text() == "mine"


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_a_folder_that_cannot_be_written_is_an_error(program, made, tmp_path):
    (tmp_path / "out").mkdir(mode=0o555)

    done = program.run("render", made.scene, "-o", tmp_path / "out")

    assert done.returncode == 1 and names(tmp_path / "out") == []


def limit_file_size():
    """Room for the compiled kernels that PoCL caches, none for a large image."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (4 << 20, 4 << 20))


def test_files_that_grow_too_large_leave_the_old_ones_in_place(program, made, tmp_path):
    shutil.copytree(made.folder, tmp_path / "out")
    before = contents(tmp_path / "out")

    done = program.run("render", made.scene, "-o", tmp_path / "out", "--size", "800x800",
                       preexec_fn=limit_file_size)

    assert done.returncode == 1 and "plane" in done.stderr
    assert contents(tmp_path / "out") == before


@pytest.fixture
def small_disk(tmp_path):
    """A folder on a disk of 256 KiB of its own."""
    disk = tmp_path / "disk"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", disk],
                      capture_output=True).returncode:
        pytest.skip("a file system cannot be mounted here")
    yield disk
    subprocess.run(["umount", disk], check=True)


# Too large from the start; and images that fit with pictures that do not.
@pytest.mark.parametrize("options", [["--size", "200x200"],
                                     ["--size", "130x130", "--planes", "range_m"]])
def test_a_full_disk_leaves_the_old_output_in_place(program, made, small_disk, options):
    assert program.run("render", made.scene, "-o", small_disk / "out", "--planes",
                       "range_m").returncode == 0
    before = contents(small_disk / "out")

    done = program.run("render", made.scene, "-o", small_disk / "out", *options)

    assert done.returncode == 1 and "No space left" in done.stderr
    assert contents(small_disk / "out") == before


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_render_ends_with_130_and_leaves_nothing(program, made, tmp_path, sent):
    out = tmp_path / "out"
    command = [program.path, "render", made.scene, "-o", out, "--size", "2000x2000"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True)
    deadline = time.monotonic() + 60
    while not (out.exists() and names(out)) and time.monotonic() < deadline:
        time.sleep(0.01)

    process.send_signal(sent)
    stdout, stderr = process.communicate(timeout=60)

    assert process.returncode == 130 and stdout == "" and "interrupted" in stderr
    assert not out.exists()


def test_pixels_of_several_tiles_lie_where_they_belong(program, made, tmp_path):
    """500 x 300 pixels are three tiles of 65536."""
    got = rendered(program, made.scene, tmp_path, "--size", "500x300", "--planes", "range_m,facet")
    across = (np.arange(500) - 249.5) * 36 / 85 / 500
    upward = (np.arange(300) - 149.5) * 36 / 85 / 500

    expected = 60 * np.sqrt(1 + across**2 + upward[:, None] ** 2)
    assert got.planes["range_m"] == pytest.approx(expected, rel=1e-6)  # float32
    assert (got.planes["facet"] == 0).all()
