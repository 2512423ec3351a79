"""Tables of measured weather as people and spreadsheets write them."""
import numpy as np
import pytest
from station_files import AIR, DEW, DIFFUSE, DIRECT, PRESSURE, TIME, WIND, check, \
    epw_text, history

HEADER = ("time [h]", "air_temperature [C]", "pressure [hPa]", "wind [m/s]", "relative_humidity [%]",
          "direct [W/m2]", "diffuse [W/m2]")


def rows_of(step_h=1.0, hours=48, first_h=0.0, decimals=4, change=None):
    """Fields by row: dark days whose air goes up and down."""
    rows = []
    for i in range(round(hours / step_h)):
        hour = first_h + i * step_h
        row = {"time": f"{hour:.{decimals}f}", "air": f"{15 + 5 * np.sin(np.pi * hour / 12):.3f}",
               "pressure": "1000", "wind": "2", "rh": "50", "direct": "0", "diffuse": "0",
               **((change or {}).get(i, {}))}
        rows.append(list(row.values()))
    return rows


def table(rows, header=HEADER, separator=",", end="\n"):
    return end.join(separator.join(fields) for fields in [header, *rows]) + end


def read(program, folder, data, name="day.csv", **site):
    (folder / name).write_bytes(data.encode() if isinstance(data, str) else data)
    return history(program, folder, name, **site)


def refused(program, folder, data, name="day.csv"):
    (folder / name).write_bytes(data.encode() if isinstance(data, str) else data)
    (folder / "made.wth").unlink(missing_ok=True)
    done = check(program, folder, name)
    assert done.returncode == 1 and not (folder / "made.wth").exists()
    return done.stderr


def test_layout_does_not_matter(program, tmp_path):
    plain, _ = read(program, tmp_path, table(rows_of()))
    same = [
        table(rows_of(), end="\r\n"), table(rows_of(), end="\r"), table(rows_of(), separator=";"),
        table(rows_of(), separator="\t"), table(rows_of(), separator=" , "),
        "\ufeff" + table(rows_of()), table(rows_of()).encode("utf-16"),
        table(rows_of(), end=",,\r\n"), table(rows_of(), end=" \t\n"),
        table(rows_of(), end="\n\n"), table(rows_of()).rstrip("\n"),
        table([[f'"{field}"' for field in row] for row in rows_of()],
              [f'"{name}"' for name in HEADER])]

    for data in same:
        assert (read(program, tmp_path, data)[0] == plain).all()


def test_a_table_of_a_country_with_decimal_commas(program, tmp_path):
    plain, _ = read(program, tmp_path, table(rows_of()))
    rows = [[field.replace(".", ",") for field in row] for row in rows_of()]

    assert (read(program, tmp_path, table(rows, separator=";"))[0] == plain).all()


def test_a_suffix_in_capitals_is_the_same_suffix(program, tmp_path):
    plain, _ = read(program, tmp_path, table(rows_of()))

    assert (read(program, tmp_path, table(rows_of()), "Day.CSV")[0] == plain).all()
    (tmp_path / "Town.EPW").write_text(epw_text())
    assert len(history(program, tmp_path, "Town.EPW")[0]) == 193


@pytest.mark.parametrize("place, spelling", [
    (1, "air_temperature [\u00b0C]"), (1, "air_temperature [degC]"), (1, "Air_Temperature [ Celsius ]"),
    (1, "air_temperature (C)"), (2, "pressure [mb]"), (2, "pressure [millibar]"), (3, "wind [m s-1]"),
    (3, "wind [m/sec]"), (4, "relative_humidity [percent]"), (5, "direct [W/m\u00b2]"),
    (5, "direct [w/m^2]"), (6, "diffuse [W m-2]"), (0, "time [hours]")])
@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
def test_units_are_known_as_people_write_them(program, tmp_path, place, spelling, encoding):
    plain, _ = read(program, tmp_path, table(rows_of()))
    header = [*HEADER[:place], spelling, *HEADER[place + 1:]]

    assert (read(program, tmp_path, table(rows_of(), header).encode(encoding))[0] == plain).all()


@pytest.mark.parametrize("place, unit, scale, offset", [
    (1, "K", 1, 273.15), (1, "F", 1.8, 32), (2, "Pa", 100, 0), (2, "kPa", 0.1, 0), (3, "km/h", 3.6, 0),
    (3, "kn", 3600 / 1852, 0), (4, "1", 0.01, 0)])
def test_units_of_one_quantity_convert(program, tmp_path, place, unit, scale, offset):
    plain, _ = read(program, tmp_path, table(rows_of()))
    rows = [[*row[:place], f"{scale * float(row[place]) + offset:.6f}", *row[place + 1:]]
            for row in rows_of()]
    header = [*HEADER[:place], f"{HEADER[place].split()[0]} [{unit}]", *HEADER[place + 1:]]

    assert read(program, tmp_path, table(rows, header))[0] == pytest.approx(plain, abs=1e-3)


@pytest.mark.parametrize("flag", ["-9999", "-999.0", "9999", "-99.9", "999.9", "", "NA", "nan", "-", "null",
                                  "-9999.900"])
def test_flags_are_gaps_and_an_hour_is_bridged(program, tmp_path, flag):
    whole, _ = read(program, tmp_path, table(rows_of()))
    change = {30: {"air": flag, "wind": flag}}
    if flag != "999.9":  # a usual pressure, and light
        change[30] |= {"direct": flag, "pressure": flag}
    rows, errors = read(program, tmp_path, table(rows_of(change=change)))

    assert rows[30, AIR] == pytest.approx(rows[[29, 31], AIR].mean(), abs=2e-3)
    assert rows[:, [PRESSURE, WIND, DIRECT, DIFFUSE]] == pytest.approx(
        whole[:, [PRESSURE, WIND, DIRECT, DIFFUSE]])
    assert "out of range" not in errors


def test_longer_gaps_are_refused_with_the_quantity_and_the_hours(program, tmp_path):
    change = {i: {"wind": ""} for i in (60, 61, 62)}
    errors = refused(program, tmp_path, table(rows_of(step_h=0.5, change=change)))

    assert "day.csv: no wind at 30 h, until 31 h: expected gaps of an hour at most" in errors


def test_absent_rows_are_gaps(program, tmp_path):
    whole, _ = read(program, tmp_path, table(rows_of()))
    rows = rows_of()
    del rows[30]

    assert read(program, tmp_path, table(rows))[0][:, WIND] == pytest.approx(whole[:, WIND])
    del rows[30]
    assert "no air_temperature at 30 h, until 31 h" in refused(program, tmp_path, table(rows))


def test_a_value_out_of_range_counts_as_missing_with_a_warning(program, tmp_path):
    _, errors = read(program, tmp_path, table(rows_of(change={30: {"air": "180"}})))

    assert ("day.csv: counts as missing what is out of range: line 32: air_temperature from -95 to 70 C, "
            "not 180") in errors


def test_kelvin_under_celsius_is_refused(program, tmp_path):
    errors = refused(program, tmp_path, table(rows_of(change={i: {"air": "293"} for i in range(48)})))

    assert "no air_temperature at 0 h, until 47 h" in errors


@pytest.mark.parametrize("step_h", [1.0, 0.5])
def test_a_day_with_the_midnight_that_ends_it_is_a_day(program, tmp_path, step_h):
    day, _ = read(program, tmp_path, table(rows_of(step_h, 24)))
    longer, errors = read(program, tmp_path, table(rows_of(step_h, 24 + step_h)))

    assert (longer[:len(day)] == day).all() and len(longer) == len(day) + 1
    assert "less than a day" not in errors


@pytest.mark.parametrize("minutes, decimals", [(1, 3), (1, 4), (5, 2), (5, 3), (10, 2), (15, 2), (20, 2)])
def test_minutes_as_rounded_fractions_of_an_hour(program, tmp_path, minutes, decimals):
    rows, _ = read(program, tmp_path, table(rows_of(minutes / 60, 48, decimals=decimals)))

    assert len(rows) == 48 * 60 / minutes
    assert rows[:, TIME] == pytest.approx(np.arange(len(rows)) * minutes / 60, abs=1e-4)


@pytest.mark.parametrize("times, message", [
    ([0, 0.75, 1.5, 2.25], "found times 0.75 h apart, expected an interval that divides an hour"),
    ([0, 1, 1, 2], "day.csv:4: found '1,"), ([0, 1, 0.5], "expected a time after 1 h"),
    ([0, 1, 2, 3.3], "found the time 3.3 h, expected 3 h"), (["", 1], "expected a time")])
def test_times_that_are_no_even_steps_are_refused(program, tmp_path, times, message):
    rows = [[str(time), "15", "1000", "2", "50", "0", "0"] for time in times]

    assert message in refused(program, tmp_path, table(rows))


def test_relative_humidity_fills_a_dew_point_that_is_missing(program, tmp_path):
    header = [*HEADER, "dew_point [C]"]
    rows = [[*row[:1], "20", *row[2:], "" if i % 2 else "9.27"] for i, row in enumerate(rows_of())]

    assert read(program, tmp_path, table(rows, header))[0][:, DEW] == pytest.approx(9.27, abs=0.02)


def test_text_that_is_no_number_is_refused_and_shown_harmlessly(program, tmp_path):
    change = {3: {"air": "\x1b[2Jhot\x07"}}
    errors = refused(program, tmp_path, table(rows_of(change=change)))

    assert "day.csv:5:" in errors and "\x1b" not in errors and "\x07" not in errors
    assert "air_temperature in C, not '?[2Jhot?'" in errors


def test_latin_1_is_shown_readably(program, tmp_path):
    header = [*HEADER, "H\u00f6he [m]"]

    assert "known columns, not 'H\u00f6he'" in refused(program, tmp_path,
                                                     table(rows_of(), header).encode("latin-1"))


def test_relative_humidity_in_fractions_is_refused(program, tmp_path):
    said = refused(program, tmp_path, table(rows_of(change={i: {"rh": "0.55"} for i in range(48)})))

    assert "day.csv: its relative humidity is at most 0.55 %: expected per cent, not fractions" in said


def test_a_row_that_is_cut_and_one_with_decimal_commas_are_refused(program, tmp_path):
    rows = rows_of()
    rows[5] = rows[5][:4]
    assert "day.csv:7: " in refused(program, tmp_path, table(rows)) and "7 fields, one for each name, not 4" in refused(program, tmp_path, table(rows))
    rows[5] = [*rows_of()[5][:1], "15,2", *rows_of()[5][2:]]
    assert "7 fields, one for each name, not 8" in refused(program, tmp_path, table(rows))


def test_weather_that_ends_before_the_image_is_an_error_of_the_scene(program, tmp_path):
    (tmp_path / "short.csv").write_text(table(rows_of(hours=12)))

    done = program.run("check", program.write_scene(
        tmp_path, weather={"history": "short.csv"}, render={"thermal": "therm"},
        material=[{"name": "wall", "emissivity": 1.0, "solar_absorptance": 0.5, "density_kg_m3": 2000.0,
                   "specific_heat_j_kg_k": 900.0, "conductivity_w_m_k": 1.0, "exposed_area": -0.5}],
        geometry=[{"file": "plane.obj", "thickness_m": 0.1}]))

    assert done.returncode == 1
    # the image is at 13:20, the last record at 11
    assert "weather.history: ends 2.333 h before the image, expected weather up to its time" in done.stderr


def test_a_key_without_its_unit_names_the_one_that_has_it(program, tmp_path):
    done = program.run("check", program.write_scene(tmp_path, weather={"wind": 3.0}))

    assert "weather.wind: the unit is missing, expected the key wind_m_s" in done.stderr
