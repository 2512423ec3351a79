"""radsig validate: made-up weather, and a measured day where it is at hand."""
import os
import pathlib

import numpy as np
import pytest

SIGMA = 5.670374419e-8
SHARED = pathlib.Path(os.environ.get("RADSIG_SHARED", "../shared")) / "data/weather"
ARM = {"site": "36.3735,-97.0691", "date": "2023-06-01", "utc-offset": "0"}
# Grass on loam: albedo .17 is the measured one, resistances are those of the notes, the soil's
# capacity is the measured 2.2 MJ/m3/K, its conductivity that of moist loam.
GRASS = {"solar-absorptance": 0.83, "thermal-emissivity": 0.97, "thickness-cm": 100,
         "conductivity-w-m-k": 1.0, "heat-capacity-j-m3-k": 2.2e6}


def validate(program, table, **options):
    done = program.run("validate", "thermal", table, *(f"--{k}={v}" for k, v in options.items()))
    assert done.returncode == 0, done.stderr
    return {line.split()[0]: float(line.split()[1]) for line in done.stdout.splitlines()}


def steady_day(path, surface_c, **changes):
    """A day that never changes."""
    columns = {"time [h]": np.arange(48) / 2, "air_temperature [C]": 20.0, "pressure [hPa]": 1013.0,
               "relative_humidity [%]": 50.0, "wind [m/s]": 2.0, "global [W/m2]": 0.0,
               "longwave_down [W/m2]": SIGMA * 293.15**4, "surface_temperature [C]": surface_c}
    columns.update(changes)
    table = np.array([np.broadcast_to(c, 48) for c in columns.values()]).T
    np.savetxt(path, table, "%.6g", ",", header=",".join(columns), comments="")
    return path


def test_a_surface_in_balance_has_no_error(program, tmp_path):
    """Sky and air at 20 C, no sun: so is the surface."""
    found = validate(program, steady_day(tmp_path / "day.csv", 20.0), **ARM, **GRASS)

    assert found["rmse_c"] == pytest.approx(0, abs=0.01)


def test_a_constant_error_is_bias_and_rmse(program, tmp_path):
    found = validate(program, steady_day(tmp_path / "day.csv", 18.5), **ARM, **GRASS)

    assert found["bias_c"] == pytest.approx(1.5, abs=0.01)
    assert found["rmse_c"] == pytest.approx(1.5, abs=0.01)


def test_what_was_not_measured_is_a_gap(program, tmp_path):
    """Three hours without a value, and longwave that is there by day alone, are not bridged."""
    gaps = np.where(np.arange(48) // 6 == 3, np.nan, 18.5)
    found = validate(program, steady_day(tmp_path / "day.csv", gaps), **ARM, **GRASS, output=tmp_path / "rows.csv")
    table = steady_day(tmp_path / "up.csv", np.where(np.arange(48) > 12, SIGMA * 293.15**4, np.nan))
    table.write_text(table.read_text().replace("surface_temperature [C]", "longwave_up [W/m2]"))
    radiated = validate(program, table, **ARM, **GRASS)

    assert found["bias_c"] == pytest.approx(1.5, abs=0.01) and found["rmse_c"] == pytest.approx(1.5, abs=0.01)
    assert len((tmp_path / "rows.csv").read_text().splitlines()) == 1 + 2 * 42
    assert radiated["rmse_c"] == pytest.approx(0.0, abs=0.01)


def test_rows_are_written_on_demand(program, tmp_path):
    table = steady_day(tmp_path / "day.csv", 18.5)
    validate(program, table, **ARM, **GRASS, output=tmp_path / "rows.csv")

    rows = np.genfromtxt(tmp_path / "rows.csv", delimiter=",", names=True)
    assert len(rows) == 96 and rows["time_h"][-1] == 47.5  # the day stands twice
    assert rows["measured_c"] == pytest.approx(18.5, abs=1e-3)


@pytest.mark.parametrize("header, row, message", [
    ("time [h],heat [C]", "0,1", "known columns, not 'heat'"),
    ("time [min]", "0", "another unit of time, as [h], not [min]"),
    ("time [h],wind", "0,1", "columns as name [unit], not 'wind'"),
    ("time [h],time [h]", "0,1", "one column 'time', not two"),
    ("time [h],air_temperature [C],pressure [hPa],wind [m/s],dew_point [C]", "0,1,1000,1,0",
     "'global [W/m2]'"),
    ("time [h],air_temperature [C],pressure [hPa],wind [m/s],dew_point [C],global [W/m2]",
     "0,-9999,1000,1,0,0", "day.csv:2"),
    ("time [h],air_temperature [C],pressure [hPa],wind [m/s],dew_point [C],global [W/m2]",
     "0,20,1000,1,0,0", "two records or more")])
def test_a_broken_table_is_refused_at_its_line(program, tmp_path, header, row, message):
    (tmp_path / "day.csv").write_text(f"{header}\n{row}\n")
    options = [f"--{k}={v}" for k, v in {**ARM, **GRASS}.items()]
    done = program.run("validate", "thermal", tmp_path / "day.csv", *options)

    assert done.returncode == 1 and message in done.stderr


@pytest.mark.parametrize("name, text", [("year.epw", "LOCATION,a\n"), ("day.dat", " Bondville\n"), ("day.wth", "2 1\n"),
                                        ("day.csv", "timestamp,temp_air\n2023-06-01T00:00Z,20\n")])
def test_weather_with_dates_is_a_scene_s(program, tmp_path, name, text):
    (tmp_path / name).write_text(text)
    done = program.run("validate", "thermal", tmp_path / name, *(f"--{k}={v}" for k, v in {**ARM, **GRASS}.items()))

    assert done.returncode == 1 and f"{name}: expected a .csv with hours; other weather is a scene's" in done.stderr


@pytest.mark.parametrize("change, message", [
    ({"back": "snow"}, "--back: found 'snow'"), ({"site": None}, "needs --site"),
    ({"surface-resistance-s-m": "50"}, "expected DAY,NIGHT"),
    ({"surface-resistance-s-m": "50,200x"}, "expected DAY,NIGHT"),
    ({"surface-resistance-s-m": "50,2e6"}, "expected DAY,NIGHT"),
    ({"model": "therm", "back": "air"}, "need --model layered")])
def test_wrong_usage_exits_2_and_says_why(program, change, message):
    options = {k: v for k, v in {**ARM, **GRASS, **change}.items() if v is not None}
    done = program.run("validate", "thermal", "day.csv", *(f"--{k}={v}" for k, v in options.items()))

    assert done.returncode == 2 and message in done.stderr


@pytest.fixture(scope="module")
def arm_day(tmp_path_factory):
    """The ARM Southern Great Plains day as docs/file-formats.md tells to write it."""
    netcdf_file = pytest.importorskip("scipy.io").netcdf_file
    names = [SHARED / n for n in ("sgpecorsfE39.b1.20230601.000000.nc",
                                  "sgpsebsE39.b1.20230601.000000.cdf")]
    if not all(name.exists() for name in names):
        pytest.skip(f"{SHARED} holds no ARM day")
    flux, surface = (netcdf_file(name, mmap=False).variables for name in names)
    columns = {"time [h]": surface["time"][:] / 3600, "air_temperature [K]": flux["air_temperature"][:],
               "pressure [kPa]": flux["air_pressure"][:],
               "dew_point [K]": flux["dew_point_temperature"][:],
               "wind [m/s]": flux["mean_wind"][:], "global [W/m2]": surface["down_short_hemisp"][:]}
    down, up = (np.float64(surface[n][:]) for n in ("down_long", "up_long"))
    skin = ((up - 0.03 * down) / (0.97 * SIGMA)) ** 0.25
    paths = []
    for name, more in (("measured", {"longwave_down [W/m2]": down, "longwave_up [W/m2]": up}),
                       ("modelled", {"surface_temperature [K]": skin})):
        path = tmp_path_factory.mktemp("arm") / f"{name}.csv"
        both = {**columns, **more}
        np.savetxt(path, np.array(list(both.values())).T, "%.7g", ",", header=",".join(both),
                   comments="")
        paths.append(path)
    return paths


def test_grass_of_a_measured_day_is_met_within_a_degree_and_a_half(program, arm_day):
    found = validate(program, arm_day[0], **ARM, **GRASS, **{"surface-resistance-s-m": "50,200"})

    assert found["rmse_c"] < 1.5  # the notes' bound, measured longwave
    assert abs(found["peak_lag_min"]) <= 60


def test_with_a_modelled_sky_the_measured_day_is_met_within_two_degrees(program, arm_day):
    found = validate(program, arm_day[1], **ARM, **GRASS, **{"surface-resistance-s-m": "50,200"})

    assert found["rmse_c"] < 2.0  # the notes' bound


def test_a_dry_lawn_would_be_far_too_hot(program, arm_day):
    assert validate(program, arm_day[0], **ARM, **GRASS)["bias_c"] > 4  # notes: 5.7 C rms
