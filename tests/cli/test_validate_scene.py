"""radsig validate thermal SCENE.toml FILE.csv: facets of a scene against measured temperatures."""
import csv
import io

import numpy as np
import pytest
from station_files import SITE, epw_text, surfrad_text
from test_validate import GRASS, arm_day  # noqa: F401

SIGMA = 5.670374419e-8
MATTER = {"name": "wall", "emissivity": 0.9, "density_kg_m3": 2000.0, "specific_heat_j_kg_k": 900.0,
          "conductivity_w_m_k": 1.0, "thickness_cm": 10.0}
# A level roof of 2 m2 in two facets, a wall that looks south.
MESH = """o house
g roof
usemtl wall
v 0 0 3
v 1 0 3
v 1 1 3
v 0 1 3
v 2 0 3
v 2 1 3
f 1 2 3 4
f 2 5 6 3
g south
v 0 0 0
v 2 0 0
f 7 8 5 1
"""


def still(**change):
    """An EPW whose sky, air and everything else is at 20 C, without light, so that surfaces are too."""
    value = {"air": 20.0, "dew": 5.0, "infrared": SIGMA * 293.15**4, "direct": 0, "diffuse": 0, **change}
    return epw_text(change={(day, hour): value for day in range(21, 25) for hour in range(1, 25)})


def validate(program, folder, measured, weather, code=0, options=(), matter=MATTER, **changes):
    name = "s.dat" if weather.startswith(" Roch") else "y.epw"
    (folder / name).write_text(weather)
    (folder / "measured.csv").write_text(measured)
    scene = program.write_scene(folder, meshes={"house.obj": MESH}, geometry=[{"file": "house.obj"}], site=SITE,
                                weather={"history": name}, material=[matter], **{"render": {"thermal": "layered"}, **changes})
    done = program.run("validate", "thermal", scene, folder / "measured.csv", *options)
    assert done.returncode == code, done.stderr
    return done.stderr if code else {row["name"]: row for row in csv.DictReader(io.StringIO(done.stdout))}


LAYERS = {**MATTER, "layers": [{"thickness_cm": 5, "conductivity_w_m_k": 0.04, "density_kg_m3": 50, "specific_heat_j_kg_k": 900}],
          "back": "stated", "back_temperature_c": 20}


@pytest.mark.parametrize("matter, render", [(MATTER, {"thermal": "therm"}), (MATTER, {"thermal": "layered"}), (LAYERS, {"thermal": "layered"}),
                                            (MATTER, {"thermal": "layered", "lateral_conduction": True})])
def test_what_is_in_balance_errs_by_what_the_measurement_is_off(program, tmp_path, matter, render):
    """Two days, gaps, odd minutes, an object, parts and a material beside each other."""
    measured = ("time,roof [C],south [K],house [F],wall [C]\n1992-06-22T10:07-04:00,18.5,295.15,68,20\n"
                "1992-06-22T12:00-04:00,,295.15,NA,20\n1992-06-23T16:44:30Z,18.5,-9999,68,20\n1992-06-23T23:50-04:00,18.5,295.15,68,20\n")
    found = validate(program, tmp_path, measured, still(), matter=matter, render=render)

    assert [found[name]["count"] for name in ("roof", "south", "house", "wall")] == ["3", "3", "3", "4"]
    assert [float(found[name]["bias_c"]) for name in ("roof", "south", "house", "wall")] == pytest.approx([1.5, -2.0, 0.0, 0.0], abs=0.02)
    assert [float(found[name]["rmse_c"]) for name in ("roof", "south")] == pytest.approx([1.5, 2.0], abs=0.02)


def test_hours_count_from_the_scene_s_midnight(program, tmp_path):
    measured = "time [h],roof [C]\n" + "".join(f"{h:.2f},20\n" for h in np.arange(-24, 24, 1 / 3))  # minutes as rounded fractions
    found = validate(program, tmp_path, measured, still())

    assert found["roof"]["count"] == "144" and float(found["roof"]["rmse_c"]) == pytest.approx(0.0, abs=0.02)


def test_the_measured_peak_is_sought_day_by_day(program, tmp_path):
    """A sheet of a millimetre follows the sun: its peak is at the solar noon, 13:13 by this clock, within an hour."""
    sheet = {**MATTER, "thickness_cm": 0.1}
    light = {(day, hour): {"air": 20.0, "dew": 5.0, "direct": 0, "diffuse": max(0, 800 - 18 * (hour - 12.7) ** 2)}
             for day in range(21, 25) for hour in range(1, 25)}
    hours = [f"1992-06-{day}T{hour:02}:00-04:00" for day in (22, 23) for hour in range(24)]
    measured = "time,roof [C]\n" + "".join(f"{time},{30 - abs(int(time[11:13]) - 10):.1f}\n" for time in hours)  # at 10 h
    found = validate(program, tmp_path, measured, epw_text(change=light), matter=sheet)

    assert float(found["roof"]["peak_lag_min"]) == pytest.approx(3 * 60, abs=60)


def test_surfrad_days_warm_a_scene_and_rows_are_written(program, tmp_path):
    day = surfrad_text(22, 23, 24, value=lambda now: {"direct": 0.0, "diffuse": 0.0, "air": 20.0, "infrared": SIGMA * 293.15**4, "rh": 40.0})
    rows = tmp_path / "rows.csv"
    validate(program, tmp_path, "time,south [C]\n1992-06-23T05:00:00-04:00,19\n1992-06-23T12:00:00-04:00,\n", day, options=["-o", rows])

    table = rows.read_text().splitlines()
    assert table[0] == "time,name,measured_c,predicted_c" and len(table) == 2
    assert table[1].startswith("1992-06-23T05:00:00-04:00,south,19.0000,")
    assert float(table[1].split(",")[3]) == pytest.approx(20.0, abs=0.02)


def test_longwave_from_the_ground_of_surfrad_is_that_of_the_facets_named(program, tmp_path):
    """Ground of emissivity 0.9 at 18 C under a sky of 20 C; a flag by night."""
    sky = SIGMA * 293.15**4
    up = 0.9 * SIGMA * 291.15**4 + 0.1 * sky
    day = surfrad_text(22, 23, 24, value=lambda now: {"direct": 0.0, "diffuse": 0.0, "air": 20.0, "rh": 40.0, "infrared": round(sky, 3),
                                                      "up": -9999.9 if now.hour < 3 else round(up, 3)}, step_min=15)
    (tmp_path / "y.dat").write_text(day)
    scene = program.write_scene(tmp_path, meshes={"house.obj": MESH}, geometry=[{"file": "house.obj"}], site=SITE, weather={"history": "y.dat"},
                                material=[MATTER], render={"thermal": "layered"})
    done = program.run("validate", "thermal", scene, tmp_path / "y.dat", "--facets=wall")
    name, count, rmse, bias, _ = done.stdout.splitlines()[1].split(",")

    # UTC's days end at 20 h local time: the first evening is left out, with its 4 h of which 3 lack a value
    assert name == "wall" and int(count) == 3 * 96 - 16 - 2 * 12
    assert "y.dat: 16 samples are of local days of which less than half is there" in done.stderr
    assert float(bias) == pytest.approx(2.0, abs=0.03) and float(rmse) == pytest.approx(2.0, abs=0.03)
    assert "y.dat: expected --facets NAME" in program.run("validate", "thermal", scene, tmp_path / "y.dat").stderr
    assert "no object, part or material 'wal' (did you mean 'wall'?)" in program.run("validate", "thermal", scene, tmp_path / "y.dat", "--facets=wal").stderr


def test_grass_of_a_measured_day_is_met_within_a_degree_and_a_half(program, tmp_path, arm_day):  # noqa: F811
    """The ARM day of test_validate as a scene: by the longwave that was measured, and by what radiates so."""
    table = np.genfromtxt(arm_day[1], delimiter=",", names=True)
    names = open(arm_day[1]).readline().strip().split(",")
    skin = table[table.dtype.names[[name.startswith("surface_temp") for name in names].index(True)]]
    (tmp_path / "measured.csv").write_text("time [h],lawn [K]\n" + "".join(f"{h:.2f},{k:.3f}\n" for h, k in zip(table[table.dtype.names[0]], skin)))
    grass = {"name": "lawn", "emissivity": GRASS["thermal-emissivity"], "solar_absorptance": GRASS["solar-absorptance"], "density_kg_m3": 1000.0,
             "specific_heat_j_kg_k": GRASS["heat-capacity-j-m3-k"] / 1000, "conductivity_w_m_k": GRASS["conductivity-w-m-k"],
             "thickness_cm": float(GRASS["thickness-cm"]), "surface_resistance_s_m": {"day": 50.0, "night": 200.0}}
    scene = program.write_scene(tmp_path, site={"latitude_deg": 36.3735, "longitude_deg": -97.0691, "time": "2023-06-01T12:00:00+00:00"},
                                geometry=[{"file": "plane.obj", "material": "lawn"}], meshes={"plane.obj": program.plane.replace("usemtl wall\n", "")},
                                material=[grass], weather={"history": str(arm_day[0])}, render={"thermal": "layered"})
    done = program.run("validate", "thermal", scene, tmp_path / "measured.csv")
    name, count, rmse, bias, lag = done.stdout.splitlines()[1].split(",")

    assert (name, count) == ("lawn", "48") and float(rmse) < 1.5 and abs(float(lag)) <= 60  # the notes' bound, measured longwave


@pytest.mark.parametrize("measured, message", [
    ("time,rof [C]\n1992-06-23T12:00-04:00,20\n", "measured.csv: the scene has no object, part or material 'rof' (did you mean 'roof'?)"),
    ("time,roof\n1992-06-23T12:00-04:00,20\n", "measured.csv:1: found 'time,roof', expected columns as name [C], not 'roof'"),
    ("time,roof [W/m2]\n1992-06-23T12:00-04:00,20\n", "expected columns as name [C], not 'roof [W/m2]'"),
    ("time,roof [C],roof [K]\n1992-06-23T12:00-04:00,20,293\n", "one column 'roof', not two"),
    ("time,roof [C]\nnoon,20\n", "measured.csv:2: found 'noon,20', expected a date and a time such as"),
    ("time,roof [C]\n1992-06-23T12:00-04:00,warm\n", "measured.csv:2"),
    ("time,roof [C]\n1992-06-23T12:00-04:00,20\n1992-06-23T11:00-04:00,20\n", "measured.csv:3: found '1992-06-23T11:00-04:00,20', expected a time after the one before"),
    ("time,roof [C]\n1992-06-23T12:00-04:00\n", "measured.csv:2: found '1992-06-23T12:00-04:00', expected 2 fields, one for each name, not 1"),
    ("time,roof [C]\n1992-06-23T12:00-04:00,NA\n", "measured.csv: no value of 'roof'"),
    ("time,roof [C]\n1992-07-23T12:00-04:00,20\n", "y.epw: has no weather of the scene's date"),
    ("time,roof [C]\n", "measured.csv:1: found 'time,roof [C]', expected rows behind the names"),
])
def test_what_cannot_be_compared_is_refused_with_the_reason(program, tmp_path, measured, message):
    assert message in validate(program, tmp_path, measured, still(), code=1)
