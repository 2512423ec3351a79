"""Several times of one day in one run."""
import pytest

CUBE = """usemtl box
v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nv -5 -5 12\nv 5 -5 12\nv 5 5 12\nv -5 5 12
f 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
"""
GROUND = "usemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
SITE = {"latitude_deg": 43.083, "longitude_deg": -77.667, "time": "1992-06-23T15:00:00-04:00"}
WEATHER = {"air_temperature_sunrise_c": 15.0, "air_temperature_peak_c": 29.0, "peak_time_h": 15.0,
           "relative_humidity_sunrise": 0.9, "wind_m_s": 2.0}
MATTER = {"emissivity": 0.93, "density_kg_m3": 2114.0, "specific_heat_j_kg_k": 920.0,
          "conductivity_w_m_k": 0.689, "thickness_cm": 5.0, "exposed_area": -0.5}
TIMES = ["1992-06-23T06:40:00-04:00", "1992-06-23T13:10:00-04:00", "1992-06-23T16:00:00-04:00"]
FOLDERS = ["19920623T064000-0400", "19920623T131000-0400", "19920623T160000-0400"]


def write(program, folder, **render):
    return program.write_scene(
        folder, meshes={"box.obj": CUBE, "ground.obj": GROUND}, site=SITE, weather=WEATHER,
        geometry=[{"file": "box.obj"}, {"file": "ground.obj"}],
        material=[{"name": "wall", **MATTER}, {"name": "box", **MATTER, "thickness_cm": 0.2}],
        render={"thermal": "therm", **render}, camera={"pixels": [24, 18]})


def bytes_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix != ".json"}


@pytest.mark.parametrize("render", [{}, {"mode": "thesis"}, {"thermal": "layered"}])
def test_each_image_of_a_run_is_the_one_of_its_own_run(program, tmp_path, render):
    path = write(program, tmp_path, **render)
    done = program.run("render", path, "-o", tmp_path / "day", "--time", ",".join(TIMES))
    assert done.returncode == 0, done.stderr

    for time, name in zip(TIMES, FOLDERS):
        assert program.run("render", path, "-o", tmp_path / name, "--time", time).returncode == 0
        assert bytes_of(tmp_path / "day" / name) == bytes_of(tmp_path / name)
    assert sorted(p.name for p in (tmp_path / "day").iterdir()) == FOLDERS


def test_the_times_differ_in_what_they_show(program, tmp_path):
    path = write(program, tmp_path)
    program.run("render", path, "-o", tmp_path / "day", "--time", ",".join(TIMES))
    planes = [program.load(tmp_path / "day" / name).planes for name in FOLDERS]

    assert planes[0]["temperature_c"].mean() < planes[1]["temperature_c"].mean() - 5
    assert (planes[1]["sunlit"] != planes[2]["sunlit"]).any()


def test_the_scene_states_its_times_in_a_list(program, tmp_path):
    path = write(program, tmp_path)
    text = path.read_text().replace(f"time = {SITE['time']}", f"time = [{TIMES[0]}, {TIMES[2]}]")
    path.write_text(text)

    assert f"times       2, the last {TIMES[2]}" in program.run("check", path).stdout
    done = program.run("render", path, "-o", tmp_path / "day", "--planes", "temperature_c")

    assert done.returncode == 0, done.stderr
    assert sorted(p.name for p in (tmp_path / "day").iterdir()) == [FOLDERS[0], FOLDERS[2]]


NINETY_SIX = [f"1992-06-23T{i // 4:02}:{15 * (i % 4):02}:00-04:00" for i in range(96)]


@pytest.mark.parametrize("option", [["--time", ",".join(NINETY_SIX)],
                                    ["--set", f"site.time=[{','.join(NINETY_SIX)}]"]])
def test_the_command_line_takes_96_times(program, tmp_path, option):
    path = write(program, tmp_path)

    done = program.run("render", path, "-o", tmp_path / "day", "--planes", "none-such", *option)

    assert done.returncode == 1 and "unknown plane 'none-such'" in done.stderr


def test_more_than_96_times_are_refused_with_their_number(program, tmp_path):
    times = NINETY_SIX + ["1992-06-23T23:50:00-04:00"]

    done = program.run("render", write(program, tmp_path), "-o", tmp_path / "day",
                       "--time", ",".join(times))

    assert done.returncode == 1 and "97 times, expected 1 to 96" in done.stderr


@pytest.mark.parametrize("times, message", [
    (["1992-06-23T06:00:00-04:00", "1992-06-24T06:00:00-04:00"], "times of one local day"),
    (["1992-06-23T06:00:00-04:00", "1992-06-23T12:00:00Z"], "times of one local day"),
    (["1992-06-23T08:00:00-04:00", "1992-06-23T06:00:00-04:00"], "a time after the one before"),
    (["1992-06-23T08:00:00-04:00", "1992-06-23T08:00:00-04:00"], "a time after the one before"),
    (["1992-06-23T08:00:00-04:00", "noon"], "--set"),
    ([""], "--time: found ''"),
])
def test_times_that_do_not_go_together_are_refused(program, tmp_path, times, message):
    path = write(program, tmp_path)
    if times == [""]:
        path.write_text(path.read_text().replace(f"time = {SITE['time']}", "time = []"))
        times, message = None, "scene.toml:"
    option = ["--time", ",".join(times)] if times else []

    done = program.run("render", path, "-o", tmp_path / "day", *option)

    assert done.returncode == 1 and message in done.stderr
    assert not (tmp_path / "day").exists()
