"""The preview without a display: what its picture shows, and what its controls do."""
import ctypes
import os
import signal
import struct
import subprocess
import time
import tomllib

import numpy as np
import pytest


def png_size(path):
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


def look(path):
    """Distance, azimuth and elevation of the camera of a saved view, seen from its target."""
    camera = tomllib.loads(path.read_text())["camera"]
    east, north, up = np.subtract(camera["position_m"], camera["target_m"])
    return (np.sqrt(east**2 + north**2 + up**2), np.degrees(np.arctan2(east, north)),
            np.degrees(np.arctan2(up, np.hypot(east, north))))


def test_a_page_is_written_without_a_display(preview, scene, tmp_path):
    done = preview.view(scene, tmp_path, "wait")

    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    width, height = png_size(tmp_path / "page.png")
    assert width >= 64 and height >= 48


def test_without_a_display_a_window_is_refused_with_the_way_out(preview, scene):
    done = subprocess.run([preview.radsig, "view", scene], env=preview.environment(),
                          capture_output=True, text=True)

    assert done.returncode == 1
    assert "no display" in done.stderr and "--offscreen" in done.stderr


def test_the_picture_at_rest_has_the_bytes_of_render(preview, scene, tmp_path):
    done = subprocess.run([preview.radsig, "view", scene, "--offscreen", tmp_path / "a.img", "--size",
                           "70x50"], env=preview.environment(), capture_output=True, text=True)

    assert done.returncode == 0, done.stderr
    expected = preview.render(scene, tmp_path / "out", "--size", "70x50")
    assert (tmp_path / "a.img").read_bytes() == expected


def test_after_moves_and_another_time_and_mode_it_still_has(preview, scene, tmp_path):
    done = preview.view(scene, tmp_path, "key left", "drag left 40 -20", "scroll 2", "key shift+up",
                        "key page-down", "key >", "key .", "key m", "key o", "wait", "image a.img")

    assert done.returncode == 0, done.stderr
    view = tmp_path / "plane-view-1.adv"
    changed = {**preview.scene, "camera": {"view": view.name, "position_m": None, "target_m": None,
                                           "focal_length_mm": None, "pixels": None}}
    preview.write_scene(tmp_path, **changed)
    expected = preview.render(scene, tmp_path / "out", "--mode", "thesis", "--time",
                              "1992-06-21T14:30:00-04:00")
    assert (tmp_path / "a.img").read_bytes() == expected


def test_the_saved_table_is_the_saved_view(preview, scene, tmp_path):
    preview.view(scene, tmp_path, "key a", "key control+right", "wait", "image a.img", "key o")
    camera = tomllib.loads((tmp_path / "plane-view-1.toml").read_text())["camera"]

    preview.write_scene(tmp_path, **{**preview.scene, "camera": camera})
    assert (tmp_path / "a.img").read_bytes() == preview.render(scene, tmp_path / "out")


def test_an_orbit_keeps_the_distance_and_turns_by_three_degrees(preview, scene, tmp_path):
    preview.view(scene, tmp_path, "key o", "key left", "key o", "key up", "key o")
    before, after, higher = (look(tmp_path / f"plane-view-{i}.toml") for i in (1, 2, 3))

    assert after == pytest.approx((before[0], before[1] + 3, before[2]), abs=1e-9)
    assert higher == pytest.approx((before[0], before[1] + 3, before[2] + 3), abs=1e-9)


def test_home_brings_the_scene_s_view_back(preview, scene, tmp_path):
    preview.view(scene, tmp_path, "wait", "image a.img", "key w", "key >", "key m", "wait",
                 "image b.img", "key home", "wait", "image c.img")
    first, moved, home = ((tmp_path / f"{name}.img").read_bytes() for name in "abc")

    assert moved != first
    assert home == first


def test_a_picked_value_is_the_image_s(preview, scene, tmp_path):
    done = preview.view(scene, tmp_path, "wait", "image a.img", "click 31 20")
    values = np.fromfile(tmp_path / "a.img", "<f4").reshape(2, 48, 64)
    picked = preview.picks(done.stdout)

    assert picked["radiance_lwir"] == pytest.approx(values[0, 20, 31], rel=1e-8)
    assert picked["radiance_mwir"] == pytest.approx(values[1, 20, 31], rel=1e-8)


def days(text):
    """Time, whether lit, and temperature in C of the steps that a click prints."""
    return [line.split()[1:] for line in text.splitlines() if line.startswith("day ")]


def test_open_ground_is_lit_as_long_as_the_sun_is_up(preview, scene, tmp_path):
    ground = preview.scene["meshes"]["wall.obj"].split("o shed")[0]
    preview.write_scene(tmp_path, **{**preview.scene, "meshes": {"wall.obj": ground}})
    done = preview.view(scene, tmp_path, "wait", "click 60 46")
    lit_h = sum(int(lit) for _, lit in days(done.stdout)) * 24 / len(days(done.stdout))

    # 2 acos(-tan 40 tan 23.44) / 15 h on the day of the solstice; a step is a quarter of an hour.
    expected_h = 2 * np.degrees(np.arccos(-np.tan(np.radians(40)) * np.tan(np.radians(23.44)))) / 15
    assert lit_h == pytest.approx(expected_h, abs=0.25)
    assert preview.picks(done.stdout)["hours_lit_24h"] == pytest.approx(lit_h, abs=1e-5)


def test_the_last_temperature_of_the_day_is_the_pixel_s(preview, airport, tmp_path):
    done = preview.view(airport, tmp_path, "wait", "click 20 110", options=["--size", "160x120"])
    last = days(done.stdout)[-1]

    assert last[0] == "1987-06-24T10:00:00-05:00"
    # Normals are rounded to 2^-13 before pixels' temperatures are computed.
    assert float(last[2]) == pytest.approx(preview.picks(done.stdout)["temperature_c"], abs=0.02)


def test_a_look_at_a_point_brings_it_to_the_middle(preview, scene, tmp_path):
    done = preview.view(scene, tmp_path, "wait", "click 40 30", "wait", "key t", "wait", "key space")
    facets = [line.split()[4] for line in done.stdout.splitlines() if " facet " in line]
    lines = [line.split() for line in done.stdout.splitlines() if " range_m " in line]

    assert facets[0] == facets[1]
    assert [line[1:3] for line in lines] == [["40", "30"], ["32", "24"]]
    # The camera does not move: half a pixel off the middle changes the range by less than 1 %.
    assert float(lines[1][4]) == pytest.approx(float(lines[0][4]), rel=1e-2)


@pytest.mark.parametrize("keys", ["n", "2", "l down enter", "g", "u", "k", "y", "e", "v", "h", "m", "c"])
def test_a_key_changes_the_page(preview, scene, tmp_path, keys):
    presses = [f"key {key}" for key in keys.split()]
    done = preview.view(scene, tmp_path, "wait", "page a.png", *presses, "wait", "page b.png")

    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.png").read_bytes() != (tmp_path / "b.png").read_bytes()


def test_thesis_minus_exact_is_the_difference_of_both_renders(preview, scene, tmp_path):
    done = preview.view(scene, tmp_path, "wait", "key p", "key c", "key c", "key m", "wait",
                        "click 32 20")
    exact, thesis = (np.frombuffer(preview.render(scene, tmp_path / mode, "--mode", mode), "<f4")
                     .reshape(2, 48, 64)[0, 20, 32] for mode in ("exact", "thesis"))

    assert preview.picks(done.stdout)["difference"] == pytest.approx(float(thesis - exact), rel=1e-7)


def test_the_page_takes_another_size(preview, scene, tmp_path):
    done = preview.view(scene, tmp_path, "wait", "size 800 600", "wait", "page b.png", "image b.img")

    assert done.returncode == 0, done.stderr
    assert png_size(tmp_path / "b.png") == (800, 600)
    header, _ = preview.envi.read(tmp_path / "b")
    columns, rows = int(header["samples"]), int(header["lines"])
    expected = preview.render(scene, tmp_path / "out", "--size", f"{columns}x{rows}")
    assert (tmp_path / "b.img").read_bytes() == expected


def test_the_full_render_in_the_background_is_render_s(preview, scene, tmp_path):
    done = preview.view(scene, tmp_path, "key d", "key o", "wait", "key Z", "pause 5")

    assert done.returncode == 0, done.stderr
    camera = tomllib.loads((tmp_path / "plane-view-1.toml").read_text())["camera"]
    preview.write_scene(tmp_path, **{**preview.scene, "camera": camera})
    expected = preview.render(scene, tmp_path / "out")
    assert (tmp_path / "plane-render-1" / "plane.img").read_bytes() == expected


class Conversation:
    """A preview that reads its script from a pipe."""

    def __init__(self, preview, scene, folder):
        self.program = subprocess.Popen(
            [preview.radsig, "view", scene, "--offscreen", folder / "page.png", "--script", "-"],
            cwd=folder, env=preview.environment(), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            text=True)

    def ask_for_error(self, *lines):
        """Does the lines; returns the error that is then shown."""
        self.program.stdin.write("\n".join([*lines, "error"]) + "\n")
        self.program.stdin.flush()
        return self.program.stdout.readline().strip()

    def end(self):
        self.program.stdin.close()
        return self.program.wait(60)


def test_a_change_of_a_file_is_seen_and_a_broken_one_keeps_the_view(preview, scene, tmp_path):
    text = scene.read_text()
    talk = Conversation(preview, scene, tmp_path)

    assert talk.ask_for_error("wait", "image a.img") == ""
    scene.write_text(text.replace("300.0", "310.0"))
    assert talk.ask_for_error("pause 1.5", "wait", "image b.img") == ""
    scene.write_text(text.replace("300.0", '"warm"'))
    error = talk.ask_for_error("pause 1.5", "wait", "image c.img")
    scene.write_text(text)
    assert talk.ask_for_error("pause 1.5", "wait", "image d.img") == ""
    assert talk.end() == 0

    assert f"{scene.name}:" in error and "warm" in error
    first, changed, broken, again = ((tmp_path / f"{name}.img").read_bytes() for name in "abcd")
    assert changed != first
    assert broken == changed
    assert again == first


def openings_of(path):
    """A descriptor from which can be read once a process has opened the file (inotify)."""
    libc = ctypes.CDLL(None, use_errno=True)
    watch = libc.inotify_init()
    assert libc.inotify_add_watch(watch, os.fsencode(path), 0x20) >= 0  # IN_OPEN
    return watch


def test_an_edit_while_the_scene_opens_is_noticed(preview, scene, tmp_path):
    # meshes are read after the scene file
    (tmp_path / "late.obj").write_text("usemtl tin\nv 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n")
    text = scene.read_text() + '[[geometry]]\nfile = "late.obj"\n'
    scene.write_text(text)
    watch = openings_of(tmp_path / "late.obj")
    talk = Conversation(preview, scene, tmp_path)
    os.read(watch, 4096)

    scene.write_text(text.replace("320.0", "340.0"))
    os.close(watch)
    assert talk.ask_for_error("wait", "pause 1.5", "wait", "image a.img") == ""
    assert talk.end() == 0

    assert (tmp_path / "a.img").read_bytes() == preview.render(scene, tmp_path / "out")


def test_an_orthographic_view_is_saved_as_a_table_alone_and_read_again(preview, scene, tmp_path):
    camera = {**preview.scene["camera"], "projection": "orthographic", "width_m": 60.0,
              "focal_length_mm": None}
    preview.write_scene(tmp_path, **{**preview.scene, "camera": camera})
    preview.view(scene, tmp_path, "key a", "wait", "image a.img", "key o")

    assert not (tmp_path / "plane-view-1.adv").exists()
    saved = tomllib.loads((tmp_path / "plane-view-1.toml").read_text())["camera"]
    assert saved["projection"] == "orthographic"
    preview.write_scene(tmp_path, **{**preview.scene, "camera": {**saved, "focal_length_mm": None}})
    assert (tmp_path / "a.img").read_bytes() == preview.render(scene, tmp_path / "out")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_ends_the_preview_soon_whatever_it_is_at(preview, airport, tmp_path, number):
    for wait_s in (0.2, 2.0, 5.0):  # reading the scene, building the tree, temperatures
        process = subprocess.Popen(
            [preview.radsig, "view", airport, "--offscreen", tmp_path / "a.img", "--size", "3000x3000"],
            cwd=tmp_path, env=preview.environment(), stderr=subprocess.PIPE, text=True)
        time.sleep(wait_s)
        process.send_signal(number)
        begin = time.monotonic()
        message = process.communicate(timeout=60)[1]

        assert process.returncode == 130 and message.endswith("radsig view: interrupted\n")
        assert time.monotonic() - begin < 2.0  # half a second, and other work on CI's processors
        assert not list(tmp_path.iterdir())


def test_quitting_while_the_scene_opens_does_not_wait_for_it(preview, airport, tmp_path):
    text = airport.read_text().replace('thermal = "therm"', 'thermal = "layered"')
    for name in ("airport.gdb", "june24_1500z.rad", "../library/materials.mat"):
        text = text.replace(f'"{name}"', f'"{(airport.parent / name).resolve()}"')
    (tmp_path / "scene.toml").write_text(text)
    talk = Conversation(preview, tmp_path / "scene.toml", tmp_path)
    talk.ask_for_error("pause 2")
    begin = time.monotonic()
    talk.program.stdin.write("key q\n")
    talk.program.stdin.flush()

    talk.program.wait(60)
    assert time.monotonic() - begin < 2.0


def test_an_unknown_plane_is_refused_by_name(preview, scene, tmp_path):
    done = preview.view(scene, tmp_path, options=["--plane", "nothing"])

    assert done.returncode == 1
    assert "'nothing'" in done.stderr


@pytest.mark.parametrize("line", ["jump 3", "click 1 2 3", "point 1 2x", "pause nan", "scroll 0x1",
                                  "size 100 -1", "size 4294967396 100", "key", "wait 1", "page "])
def test_a_script_s_wrong_line_is_refused_with_its_number(preview, scene, tmp_path, line):
    done = preview.view(scene, tmp_path, "error", line)

    assert done.returncode == 1
    assert "script.txt:2:" in done.stderr and line in done.stderr


@pytest.mark.parametrize("arguments", [[], ["--no-such"], ["a", "b"], ["a", "--size", "3"],
                                       ["a", "--offscreen", "a.gif"], ["a", "--plane"],
                                       ["a", "--size", "4294967360x48"]])
def test_wrong_usage_has_exit_code_2(preview, arguments):
    done = subprocess.run([preview.radsig, "view", *arguments], capture_output=True, text=True)

    assert done.returncode == 2
    assert "--help" in done.stderr


def test_the_help_names_the_options(preview):
    done = subprocess.run([preview.radsig, "view", "--help"], capture_output=True, text=True)

    assert done.returncode == 0
    for option in ("--offscreen", "--size", "--plane", "--script", "--bench"):
        assert option in done.stdout


def test_the_airport_at_rest_has_the_bytes_of_render(preview, airport, tmp_path):
    done = subprocess.run([preview.radsig, "view", airport, "--offscreen", tmp_path / "a.img", "--size",
                           "160x120"], env=preview.environment(), capture_output=True, text=True)

    assert done.returncode == 0, done.stderr
    expected = preview.render(airport, tmp_path / "out", "--size", "160x120")
    assert (tmp_path / "a.img").read_bytes() == expected
