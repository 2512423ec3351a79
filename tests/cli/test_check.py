"""radsig check on scenes that are wrong in one place each: the message names file and line."""
import resource
import shutil

import numpy as np
import pytest

GOOD = """name = "plane"
[site]
latitude_deg = 40.0
longitude_deg = -80.0
time = 1992-06-21T13:20:00-04:00
[atmosphere]
uniform = { sky_temperature_k = 260, sky_radiance_w_m2_sr_um = 0, \
sun_irradiance_w_m2_um = 0, transmission = 1, path_temperature_k = 260 }
[[geometry]]
file = "plane.obj"
[library]
materials = "some.mat"
[camera]
position_m = [0, 0, 60]
target_m = [0, 0, 0]
focal_length_mm = 85
pixels = [16, 12]
[[band]]
name = "lwir"
wavelength_um = [8.0, 14.0]
[render]
thermal = "fixed"
[[material]]
name = "wall"
emissivity = 0.9
temperature_k = 300.0
"""
PLANE = "usemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
MATERIAL = ("1\nasphalt\n1\n.22\n5.93\n2.114\n0.0\n.93\n.93\n.40\nasphalt.ems\nnull\n")
WEATHER = '[weather]\nhistory = "day.wth"\n'
WITH_WEATHER = GOOD + WEATHER
WITH_DATABASE = GOOD.replace(GOOD.splitlines()[6], 'database = "june24_1500z.rad"').replace("14.0]",
                                                                                            "13.0]")


def weather_text(count=97):
    row = "%.2f 20.0 1013.0 .60 -1 2.0 0.0 0.0 1.0 0 0 0 0"
    return f"{count} 0.25\n" + "".join(row % (i / 4) + "\n" for i in range(count))


def emissivity_text():
    rows = [f"{39850 - 100 * i} 0.9" for i in range(396)]
    return "".join(f"{angle}\n" + "\n".join(rows) + "\n" for angle in range(91))


@pytest.fixture(scope="module")
def folder(program, tmp_path_factory):
    """The files that GOOD and its kin name, all of them right."""
    path = tmp_path_factory.mktemp("check")
    (path / "plane.obj").write_text(PLANE)
    (path / "some.mat").write_text(MATERIAL)
    (path / "asphalt.ems").write_text(emissivity_text())
    (path / "day.wth").write_text(weather_text())
    shutil.copy(program.airport / "june24_1500z.rad", path)
    return path


def line_of(text, part):
    """The number of the line that holds `part`, counted from 1."""
    return 1 + [part in line for line in text.splitlines()].index(True)


def check(program, folder, text, *options, name="scene.toml"):
    (folder / name).write_text(text)
    return program.run("check", folder / name, *options)


def assert_refused(program, folder, text, *expected):
    """check ends with 1, prints no summary and says all that is expected; render leaves nothing."""
    done = check(program, folder, text)
    assert done.returncode == 1 and done.stdout == ""
    for words in expected:
        assert words in done.stderr
    rendered = program.run("render", folder / "scene.toml", "-o", folder / "out")
    assert rendered.returncode == 1 and not (folder / "out").exists()
    assert rendered.stderr.replace("radsig render:", "radsig check:") == done.stderr


@pytest.mark.parametrize("text", [GOOD, WITH_WEATHER, WITH_DATABASE])
def test_the_scenes_to_be_broken_are_right(program, folder, text):
    done = check(program, folder, text)

    assert done.returncode == 0, done.stderr


def test_a_summary_names_units(program, folder):
    summary = check(program, folder, WITH_WEATHER).stdout

    for words in ("latitude 40.000000 deg", "east-positive", "10000 m2", "z 0 to 0 m",
                  "every 15 min", "20.0 to 20.0 C", "W/m2", "lens 85 mm", "60 m from its target",
                  "8 to 14 um", "gain 1 per W m-2 sr-1"):
        assert words in summary


# What is replaced in GOOD, by what, where the message points, what it says.
@pytest.mark.parametrize("old, new, at, words", [
    ("focal_length_mm = 85", "focal_length_mm = 85\nlens = 3", "lens = 3", "lens: unknown key"),
    ("latitude_deg = 40.0", "latitude = 40.0", "latitude = 40.0", "expected the key latitude_deg"),
    ("latitude_deg = 40.0", "latitude_deg = 140.0", "latitude_deg", "from -90 to 90"),
    ("transmission = 1", "transmission = 1.2", "uniform", "from 0 to 1"),
    ('"plane.obj"', '"absent.obj"', "absent.obj", "absent.obj: No such file"),
    ('"some.mat"', '"absent.mat"', "absent.mat", "absent.mat: No such file"),
    ("focal_length_mm = 85", 'focal_length_mm = "long"', "focal_length_mm",
     "expected a finite number"),
    ("pixels = [16, 12]", "pixels = [16]", "pixels", "expected 2 numbers"),
    ("pixels = [16, 12]", "pixels = [16, 12.5]", "pixels", "expected whole numbers"),
    ("pixels = [16, 12]", "pixels = [16, 0]", "pixels", "from 1 to"),
    ("[site]", "[site", "[site", ""),
    ('name = "lwir"', 'name = "lw ir"', "lw ir", "expected a word"),
    ("wavelength_um = [8.0, 14.0]", "wavelength_um = [14.0, 8.0]", "wavelength_um",
     "expected the low edge first"),
    ("T13:20:00-04:00", "T13:20:00", "time =", "a date and time with offset"),
    ("emissivity = 0.9", "emissivity = 0.9\nroughness = 1.5", "roughness", "1.5"),
    ("emissivity = 0.9\n", "", "[[material]]", "has no emissivity"),
    ("temperature_k = 300.0", "temperature_k = 300.0\nemissivity_file = \"plane.obj\"", None,
     "plane.obj:1: "),
    ('thermal = "fixed"', 'thermal = "warm"', "thermal =", '"fixed" or "therm"'),
    ('thermal = "fixed"', 'thermal = "fixed"\nhemisphere_step_deg = { zenith = 15 }', "hemisphere",
     "azimuth: missing"),
    ("target_m = [0, 0, 0]", "target_m = [0, 0, 60]", "[camera]", "the same point"),
])
def test_a_wrong_value_is_reported_at_its_line(program, folder, old, new, at, words):
    assert old in GOOD
    text = GOOD.replace(old, new, 1)
    place = f"{folder}/scene.toml:{line_of(text, at)}: " if at else f"{folder}/"

    assert_refused(program, folder, text, place, words)


@pytest.mark.parametrize("table", ["site", "camera", "atmosphere", "[band]", "[geometry]"])
def test_a_missing_table_is_named(program, folder, table):
    head, _, tail = GOOD.partition(f"[{table}]\n")
    text = head + tail[tail.index("\n["):].lstrip("\n")

    assert_refused(program, folder, text, f"{folder}/scene.toml", f"[{table}]")


def test_two_errors_in_one_file_are_both_reported(program, folder):
    text = GOOD.replace("latitude_deg = 40.0", "latitude_deg = 140.0").replace("[16, 12]", "[16]")

    assert_refused(program, folder, text, f"scene.toml:{line_of(text, 'latitude')}: ",
                   f"scene.toml:{line_of(text, 'pixels')}: ")


def test_errors_of_several_files_are_all_reported(program, folder):
    (folder / "bad.obj").write_text(PLANE.replace("1 2 3 4", "1 2 3 5"))
    (folder / "bad.mat").write_text(MATERIAL.replace("2.114", "dense"))
    text = GOOD.replace("some.mat", "bad.mat").replace("plane.obj", "bad.obj")

    assert_refused(program, folder, text, "bad.obj:6: ", "bad.mat:6: ")


def test_a_material_of_the_mesh_that_nobody_states_is_named(program, folder):
    (folder / "bad.obj").write_text(PLANE.replace("usemtl wall", "usemtl velvet"))

    assert_refused(program, folder, GOOD.replace("plane.obj", "bad.obj"),
                   'bad.obj: material "velvet"')


@pytest.mark.parametrize("count", [3, 300])
def test_a_missing_thickness_is_told_once_a_material(program, folder, count):
    faces = [f"usemtl m{i}\nf 1 2 3\nf 2 3 4\n" for i in range(count)]
    (folder / "many.obj").write_text(PLANE + "".join(faces))
    materials = [f'[[material]]\nname = "m{i}"\nemissivity = 0.9\n' for i in range(count)]
    text = GOOD.replace("plane.obj", "many.obj") + "".join(materials)

    done = check(program, folder, text)

    assert done.returncode == 1 and done.stderr.count("has no temperature") == count


def test_twenty_thousand_materials_and_geometries_are_read_within_seconds(program, folder):
    """Comparing each name with all others took 8 s of materials, and 3 s of geometries."""
    if "san-" in str(program.path):
        pytest.skip("sanitizers take time of their own")
    names = [f"m{i}" for i in range(20000)]
    vertices = "v -50 -50 0\nv 50 -50 0\nv 50 50 0\n"
    (folder / "many.obj").write_text(vertices + "".join(f"usemtl {n}\nf 1 2 3\n" for n in names))
    materials = "".join(f'[[material]]\nname = "{n}"\nemissivity = 0.9\ntemperature_k = 300\n'
                        for n in names)
    again = ["".join(".//" if i >> bit & 1 else "./" for bit in range(15)) for i in range(20000)]
    geometries = "".join(f'[[geometry]]\nfile = "{place}plane.obj"\n' for place in again)
    text = GOOD.replace("plane.obj", "many.obj") + materials + geometries
    before_s = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime

    done = check(program, folder, text)

    assert done.returncode == 0, done.stderr
    assert resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before_s < 5


@pytest.mark.parametrize("face, words", [("f 1 2 3 5", "bad.obj:6: "), ("f 1 2 x", "bad.obj:6: "),
                                         ("f 1 2", "bad.obj:6: "), ("f 0 1 2", "bad.obj:6: ")])
def test_a_bad_face_is_reported_at_its_line(program, folder, face, words):
    (folder / "bad.obj").write_text(PLANE.replace("f 1 2 3 4", face))

    assert_refused(program, folder, GOOD.replace("plane.obj", "bad.obj"), words)


@pytest.mark.parametrize("old, new, line", [("2.114", "dense", 6), (".22", "-1", 4),
                                            ("null\n", "", 12), ("1\nasphalt", "2\nasphalt", 13)])
def test_a_bad_material_record_is_reported_at_its_line(program, folder, old, new, line):
    (folder / "bad.mat").write_text(MATERIAL.replace(old, new, 1))

    assert_refused(program, folder, GOOD.replace("some.mat", "bad.mat"), f"bad.mat:{line}: ")


def test_a_bad_emissivity_is_reported_at_its_line(program, folder):
    lines = emissivity_text().splitlines()
    lines[400] = lines[400].replace("0.9", "1.9")  # line 401
    (folder / "bad.ems").write_text("\n".join(lines) + "\n")
    text = GOOD.replace("emissivity = 0.9", 'emissivity_file = "bad.ems"')

    assert_refused(program, folder, text, "bad.ems:401: ")


@pytest.mark.parametrize("old, new, line", [
    ("12.00 20.0 1013.0 .60", "12.00 20.0 1013.0 1.60", 50),
    ("12.00 20.0 1013.0", "12.00 warm 1013.0", 50),
    ("12.00 20.0", "12.75 20.0", 50),
    ("97 0.25", "97 0.3", 1),
])
def test_a_bad_row_of_weather_is_reported_at_its_line(program, folder, old, new, line):
    text = weather_text()
    assert old in text
    (folder / "bad.wth").write_text(text.replace(old, new, 1))

    assert_refused(program, folder, WITH_WEATHER.replace("day.wth", "bad.wth"), f"bad.wth:{line}: ")


def test_a_short_history_is_reported(program, folder):
    (folder / "bad.wth").write_text("".join(weather_text().splitlines(keepends=True)[:40]))

    assert_refused(program, folder, WITH_WEATHER.replace("day.wth", "bad.wth"), "bad.wth:")


@pytest.mark.parametrize("row, new", [(20, "8.064516 1240.0 5.5e-5 1.5"), (13, "8 words"),
                                      (60, "0.5 0.1")])
def test_a_bad_row_of_the_database_is_reported_at_its_line(program, folder, row, new):
    lines = (folder / "june24_1500z.rad").read_text().splitlines()
    data = np.flatnonzero([not line.startswith("#") for line in lines])
    lines[data[row]] = new
    (folder / "bad.rad").write_text("\n".join(lines) + "\n")

    assert_refused(program, folder, WITH_DATABASE.replace("june24_1500z.rad", "bad.rad"),
                   f"bad.rad:{data[row] + 1}: ")


def test_a_band_outside_the_database_is_reported_at_its_table(program, folder):
    text = WITH_DATABASE.replace("[8.0, 13.0]", "[3.0, 5.0]")

    assert_refused(program, folder, text, f"scene.toml:{line_of(text, '[[band]]')}: ", "3 to 5 um")


def test_a_sensor_file_of_another_database_is_reported_at_its_band(program, folder):
    (folder / "short.sen").write_text("26\n1.0\n0.0\n" + "1.0\n" * 26)  # the database has 27
    text = WITH_DATABASE.replace("wavelength_um = [8.0, 13.0]", 'sensor = "short.sen"')

    assert_refused(program, folder, text, f"scene.toml:{line_of(text, '[[band]]')}: ",
                   "26 responses", "27 points")


def test_facets_without_thickness_are_an_error_for_therm(program, folder):
    text = WITH_WEATHER.replace('"fixed"', '"therm"') + """[[material]]
name = "wall"
emissivity = 0.9
density_kg_m3 = 2000
specific_heat_j_kg_k = 900
conductivity_w_m_k = 1
"""
    text = text.replace(GOOD[GOOD.index("[[material]]"):], "")

    assert_refused(program, folder, text, "wall has no thickness", "thickness_cm")


def test_therm_without_weather_is_an_error(program, folder):
    assert_refused(program, folder, GOOD.replace('"fixed"', '"therm"'), "[weather]", "scene.toml: ")


def test_facets_without_a_temperature_are_an_error_for_fixed(program, folder):
    assert_refused(program, folder, GOOD.replace("temperature_k = 300.0\n", ""),
                   "wall has no temperature", "temperature_k")


@pytest.mark.parametrize("setting, words", [
    ("site.latitude_deg=140", "from -90 to 90"),
    ("site.latitude_deg=", "--set: site.latitude_deg: "),
    ("camera.lens=3", "unknown key"), ("camera.pixels=[1", "--set camera.pixels=[1"),
])
def test_a_bad_setting_is_an_error_that_names_it(program, folder, setting, words):
    done = check(program, folder, GOOD, "--set", setting)

    assert done.returncode == 1 and words in done.stderr


def test_a_scene_that_is_not_there_is_an_error(program, folder):
    done = program.run("check", folder / "absent.toml")

    assert done.returncode == 1 and "absent.toml" in done.stderr and done.stdout == ""


@pytest.mark.parametrize("bytes_", [b"", b"\x00\x01\x02", b"name = \"\xff\"\n", b"[" * 100000])
def test_a_file_that_is_no_scene_is_an_error(program, folder, bytes_):
    (folder / "odd.toml").write_bytes(bytes_)

    done = program.run("check", folder / "odd.toml", text=False)

    assert done.returncode == 1 and b"odd.toml" in done.stderr


def test_every_error_of_an_all_but_empty_scene_names_the_file(program, folder):
    done = check(program, folder, 'name = "x"\n')

    assert done.returncode == 1
    assert all("scene.toml" in line for line in done.stderr.splitlines())


def test_all_keys_of_a_large_table_are_known(program, tmp_path):
    generate = {
        "model": "us-standard-1976", "wavenumber_cm1": [700.0, 1300.0], "wavenumber_step_cm1": 20.0,
        "sample_step_cm1": 5.0, "aerosol": "rural", "visibility_km": 23.0,
        "phase_function": "henyey-greenstein", "asymmetry": .7, "ground_altitude_m": 0.0,
        "ground_albedo": [.1, .2], "ground_albedo_edge_um": [9.0], "sensor_altitude_m": 9000.0,
        "sensor_azimuth_deg": 10.0, "path_zenith_deg": [0.0, 60.0, 10.0],
        "target_altitude_m": [500.0, 1000.0], "range_m": [100.0, 1000.0],
        "sky_step_deg": {"zenith": 15, "azimuth": 30}}
    atmosphere = {"uniform": program.vacuum, "generate": generate}

    done = program.run("check", program.write_scene(tmp_path, atmosphere=atmosphere))

    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name, text, key", [
    ("psf.csv", "0,1,0\n1,4,1\n0,1,0\n", '[sensor]\npsf = "psf.csv"\n'),
    ("day.wth", weather_text(), WEATHER)])
def test_a_byte_order_mark_is_passed_over(program, folder, tmp_path, name, text, key):
    for each in ("plane.obj", "some.mat", "asphalt.ems"):
        shutil.copy(folder / each, tmp_path)
    (tmp_path / name).write_text("\ufeff" + text, encoding="utf-8")

    done = check(program, tmp_path, "\ufeff" + GOOD + key)

    assert done.returncode == 0, done.stderr


def test_control_characters_of_files_reach_no_terminal(program, folder):
    (folder / "bad.mat").write_text(MATERIAL.replace("2.114", "\x1b]0;owned\x07\x1b[2J\r"))

    done = check(program, folder, GOOD.replace("some.mat", "bad.mat"))

    assert done.returncode == 1 and "bad.mat:6: found '?]0;owned??[2J'" in done.stderr
    assert not any(c in done.stderr for c in "\x1b\x07\r")


def test_names_of_materials_reach_no_terminal_as_they_are(program, folder):
    (folder / "odd.obj").write_text(PLANE.replace("wall", "wa\x1bll"))
    done = check(program, folder, GOOD.replace("plane.obj", "odd.obj"))

    assert done.returncode == 1 and "\x1b" not in done.stderr


def test_a_peak_beyond_the_documented_range_is_told_at_its_line(program, folder):
    weather = ("[weather]\nair_temperature_sunrise_c = 15\nair_temperature_peak_c = {}\n"
               "peak_time_h = 15\nrelative_humidity_sunrise = 0.9\nwind_m_s = 2\n")

    assert_refused(program, folder, GOOD + weather.format(70.5), "air_temperature_peak_c: found 70.5",
                   "from -100 to 70")
    assert_refused(program, folder, GOOD + weather.format(5), f"scene.toml:{line_of(GOOD + weather, '[weather]')}: ",
                   "weather: air temperature at its peak in C: found 5")
    assert check(program, folder, GOOD + weather.format(70)).returncode == 0
