"""The window, driven by keys and pointer like a person's, on a virtual screen."""
import ctypes
import ctypes.util
import pathlib
import shutil
import subprocess
import time

import numpy as np
import pytest

from png import read_png

MISSING = [name for name in ("Xvfb", "xdotool") if not shutil.which(name)]
pytestmark = pytest.mark.skipif(bool(MISSING), reason=f"{' and '.join(MISSING)} missing: make deps")


def state_density(display, dots_per_inch):
    """Tells the programs of a screen how dense it is, as a desktop does: the resource Xft.dpi."""
    x11 = ctypes.CDLL(ctypes.util.find_library("X11"))
    resource_manager, string, text = 23, 31, f"Xft.dpi:\t{dots_per_inch}\n".encode()
    x11.XOpenDisplay.restype, x11.XDefaultRootWindow.restype = ctypes.c_void_p, ctypes.c_ulong
    link = ctypes.c_void_p(x11.XOpenDisplay(display.encode()))
    root = ctypes.c_ulong(x11.XDefaultRootWindow(link))
    x11.XChangeProperty(link, root, ctypes.c_ulong(resource_manager), ctypes.c_ulong(string), 8, 0, text,
                        len(text))
    x11.XCloseDisplay(link)


class Person:
    """Someone at a window on a screen of its own."""

    def __init__(self, preview, scene, folder, size, dots_per_inch=96):
        self.screen = subprocess.Popen(
            ["Xvfb", "-displayfd", "1", "-noreset", "-screen", "0", "1280x1024x24"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.folder = folder
        # GLX's driver is unloaded before leaks are looked for, and then has no name that could be
        # suppressed: leaks are looked for by the tests without a window.
        self.environment = {**preview.environment(), "ASAN_OPTIONS": "detect_leaks=0:use_sigaltstack=0",
                            "DISPLAY": ":" + self.screen.stdout.readline().strip()}
        state_density(self.environment["DISPLAY"], dots_per_inch)
        self.program = subprocess.Popen([preview.radsig, "view", scene, "--size", size], cwd=folder,
                                        env=self.environment, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.window = self.do("search", "--sync", "--name", "radsig:").split()[0]
        self.do("windowfocus", "--sync", self.window)

    def do(self, *words):
        return subprocess.run(["xdotool", *words], env=self.environment, capture_output=True, text=True,
                              timeout=60, check=True).stdout

    def press(self, *keys):
        self.do("key", "--delay", "30", *keys)

    def click(self, x, y):
        self.do("mousemove", "--window", self.window, str(x), str(y))
        self.do("click", "1")

    def values(self):
        """Values by plane that the next pick prints, which waits for the exact picture."""
        picked = {}
        words = self.program.stdout.readline().split()
        while words[0] == "pixel":
            picked[words[3]] = float(words[4])
            self.picked = int(words[1]), int(words[2])
            words = self.program.stdout.readline().split()
        for _ in range(95):  # of the day's 96 lines the first is read
            assert words[0] == "day"
            words = self.program.stdout.readline().split()
        return picked

    def page(self, number):
        """The page that `z` saves."""
        self.press("z")
        path = self.folder / f"plane-page-{number}.png"
        for _ in range(200):
            if path.exists():
                return path
            time.sleep(0.05)
        raise AssertionError(f"{path.name} was not saved")

    def end(self):
        self.press("q")
        return self.program.wait(30)


    def leave(self):
        self.program.kill()
        self.program.wait()
        self.screen.terminate()
        self.screen.wait()


@pytest.fixture
def person(preview, scene, tmp_path):
    someone = Person(preview, scene, tmp_path, "480x320")
    yield someone
    someone.leave()


@pytest.fixture
def person_at_dense_screen(preview, scene, tmp_path):
    someone = Person(preview, scene, tmp_path, "480x320", dots_per_inch=192)
    yield someone
    someone.leave()


def ink(page):
    """Dark pixels where the legend's unit stands: right of the picture, above the bar."""
    pixels = read_png(page)
    return int((pixels[50:72, -150:].sum(axis=2) < 300).sum())


def test_a_person_can_orbit_pick_save_and_quit(preview, scene, person, tmp_path):
    person.press("space")
    person.values()
    first = person.page(1)
    person.press("Left", "Left", "greater", "space")
    person.values()
    orbited = person.page(2)
    person.press("o")
    person.click(12 + 240, 56 + 160)  # the picture begins 12 pixels from the left, 56 from the top
    picked = person.values()
    person.press("n")
    other = person.page(3)
    code = person.end()

    assert code == 0 and person.program.stderr.read() == ""
    assert len({path.read_bytes() for path in (first, orbited, other)}) == 3
    assert ink(first) > 50  # letters of 12 pixels: some ten dark pixels each
    camera = {"view": "plane-view-1.adv", "position_m": None, "target_m": None, "pixels": None,
              "focal_length_mm": None}
    preview.write_scene(tmp_path, **{**preview.scene, "camera": camera})
    rendered = np.frombuffer(preview.render(scene, pathlib.Path(tmp_path / "out"), "--time",
                                            "1992-06-21T14:20:00-04:00"), "<f4")
    assert picked["radiance_lwir"] == pytest.approx(rendered.reshape(2, 320, 480)[0, 160, 240], rel=1e-8)


def test_a_drag_orbits_and_a_resized_window_has_a_larger_picture(preview, person, tmp_path):
    person.press("o")
    person.do("mousemove", "--window", person.window, "200", "200", "mousedown", "1", "mousemove_relative",
              "50", "0", "mouseup", "1")
    person.press("o")
    person.do("windowsize", "--sync", person.window, "900", "700")
    person.press("o", "space")
    person.values()
    code = person.end()

    assert code == 0
    views = [(tmp_path / f"plane-view-{i}.toml").read_text() for i in (1, 2, 3)]
    assert views[0] != views[1]
    assert "pixels = [480, 320]" in views[1]
    assert "pixels = [726, 618]" in views[2]  # less the margins of 174 and 82 pixels


def test_on_a_dense_screen_all_is_twice_as_large_and_a_click_finds_its_pixel(person_at_dense_screen):
    person = person_at_dense_screen
    person.click(2 * (12 + 240), 2 * (56 + 160))
    person.values()
    page = read_png(person.page(1))
    geometry = person.do("getwindowgeometry", person.window)
    code = person.end()

    assert code == 0 and "1308x804" in geometry  # 480 + 174 by 320 + 82 pixels, doubled
    assert person.picked == (240, 160)
    left = page[2 * 56:2 * (56 + 150), 2 * 12:2 * (12 + 150)]  # clear of cross, values and arrow
    blocks = left.reshape(150, 2, 150, 2, 3)
    assert (blocks == blocks[:, :1, :, :1]).all()  # a pixel of the picture covers two by two
    assert len(np.unique(left)) > 2
