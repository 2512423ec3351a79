"""Weather from EPW years and SURFRAD days: files in their layouts with values that are known."""
import datetime

import pytest
from station_files import (AIR, CLOUD, DEW, DIFFUSE, DIRECT, EXPOSURE, LANGLEY_PER_HOUR_W_M2, MATTER,
                           PRESSURE, RAIN, SITE, TIME, WIND, check, epw_text, history, surfrad_text)


def test_an_epw_hour_stands_at_its_end_by_the_scene_s_clock(program, tmp_path):
    (tmp_path / "year.epw").write_text(epw_text())
    rows, errors = history(program, tmp_path, "year.epw")

    assert len(rows) == 193
    assert "made.wth: leaves out the measured longwave of 193 records" in errors
    at_13 = rows[96 + 52]  # 13:00 by the clock is 12:00 standard time
    assert at_13[AIR] == pytest.approx(16.0) and at_13[DEW] == pytest.approx(5.0)
    assert at_13[PRESSURE] == pytest.approx(1000.0) and at_13[WIND] == pytest.approx(3.0)
    assert rows[96 + 54][AIR] == pytest.approx(16.25)  # half an hour later
    assert at_13[EXPOSURE] == pytest.approx(0.8) and at_13[CLOUD] == 4


def test_light_of_an_epw_hour_keeps_its_energy_and_the_night_stays_dark(program, tmp_path):
    (tmp_path / "year.epw").write_text(epw_text())
    rows, _ = history(program, tmp_path, "year.epw")
    day = rows[96:192]

    # 7 to 18 standard time are 12 hours of 500 and 90; every record stands for a quarter hour
    direct, diffuse = (day[:, [DIRECT, DIFFUSE]] * LANGLEY_PER_HOUR_W_M2 / 4).sum(axis=0)
    assert direct == pytest.approx(12 * 500, rel=0.02)
    assert diffuse == pytest.approx(12 * 90, rel=0.02)
    dark = (day[:, TIME] < 24 + 5.5) | (day[:, TIME] > 24 + 21.2)  # sun's day: 5.6 to 20.9 h
    assert (day[dark][:, DIRECT:DIFFUSE + 1] == 0).all()


def test_a_single_bright_hour_does_not_shine_into_its_neighbours(program, tmp_path):
    dull = {(23, hour): {"direct": 0, "diffuse": 50} for hour in range(1, 25)}
    dull[23, 12] = {"direct": 800, "diffuse": 50}  # 11 to 12 standard time, 12 to 13 by the clock
    (tmp_path / "year.epw").write_text(epw_text(change=dull))
    rows, _ = history(program, tmp_path, "year.epw")
    bright = rows[96:][rows[96:, DIRECT] > 0]

    assert bright[0, TIME] == 36.0 and bright[-1, TIME] == 37.0
    assert bright[[0, -1], DIRECT] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(400, rel=0.02)
    assert bright[1:-1, DIRECT] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(800, rel=0.02)


def test_measured_infrared_warms_like_the_sky_that_it_was_measured_from(program, tmp_path):
    change = {(day, hour): {"infrared": infrared, "direct": 0, "diffuse": 0}
              for day in (21, 22, 23, 24) for hour in range(1, 25) for infrared in (300,)}
    planes = []
    for infrared in (300, 360):
        for value in change.values():
            value["infrared"] = infrared
        (tmp_path / "year.epw").write_text(epw_text(change=change))
        planes.append(program.render(tmp_path, site=SITE, weather={"history": "year.epw"},
                                     material=[MATTER], render={"thermal": "therm"}
                                     ).planes["temperature_c"])

    # 60 W/m2 over h = 9 + 1.2 x 3 and 4 e s T^3 at the colder one's 11 C, less what is held back
    steady_k = 0.93 * 60 / (12.6 + 4 * 0.93 * 5.670374e-8 * 284.2**3)
    assert 0.95 * steady_k < (planes[1] - planes[0]).min() < steady_k


def test_rain_and_missing_infrared_of_an_epw(program, tmp_path):
    change = {(day, hour): {"infrared": 9999, "rain": 2.5} for day in (21, 22, 23, 24)
              for hour in range(1, 25)}
    (tmp_path / "year.epw").write_text(epw_text(change=change))
    rows, errors = history(program, tmp_path, "year.epw")

    assert "leaves out" not in errors
    assert rows[:, RAIN] == pytest.approx(0.25)  # cm/h


def test_a_typical_year_is_taken_by_month_and_day(program, tmp_path):
    (tmp_path / "year.epw").write_text(
        epw_text(change={(21, 1): {"year": 1988}}))  # years differ: made of several
    rows, errors = history(program, tmp_path, "year.epw", time="2024-06-23T15:00:00-04:00")

    assert rows[96 + 52][AIR] == pytest.approx(16.0) and "is the weather of" not in errors


def test_a_year_that_is_not_the_scene_s_is_warned_about(program, tmp_path):
    (tmp_path / "year.epw").write_text(epw_text())
    _, errors = history(program, tmp_path, "year.epw", time="2024-06-23T15:00:00-04:00")

    assert "year.epw: is the weather of 1992, the scene's year is 2024" in errors


def test_the_last_day_of_december_stands_before_new_year(program, tmp_path):
    text = epw_text(first=(1992, 12, 29), days=3)
    january = epw_text(first=(1992, 1, 1), days=3).split("\r\n")[8:]
    (tmp_path / "year.epw").write_text(
        "\r\n".join(text.split("\r\n")[:8] + january[:-1] + text.split("\r\n")[8:]))
    rows, _ = history(program, tmp_path, "year.epw", time="1992-01-01T15:00:00-05:00")

    assert rows[48][AIR] == pytest.approx(16.0)  # noon of 31 December


@pytest.mark.parametrize("name, text", [("year.epw", epw_text(place=(25.8, -80.3)))])
def test_weather_of_a_far_place_is_warned_about_by_its_name(program, tmp_path, name, text):
    (tmp_path / name).write_text(text)
    _, errors = history(program, tmp_path, name)

    assert "year.epw: is the weather of Rochester at latitude 25.8, longitude -80.3, 19" in errors


@pytest.mark.parametrize("old, new, message", [
    ("LOCATION,Rochester,NY", "LOCATION,Rochester", "year.epw:1: found 'LOCATION,Rochester,USA"),
    ("-5.0,169.0", "west,169.0", "year.epw:1:"),
    ("DATA PERIODS,1,1", "DATA PERIODS,1,7", "records an hour that divide 60"),
    ("1992,6,22,3,60", "1992,13,22,3,60", "year.epw:35: found '1992,13,22,3,60"),
    ("1992,6,22,3,60", "1992,6,22,25,60", "an hour from 0 to 24, not '25'"),
    ("1992,6,22,3,60", "1992,2,30,3,60", "a day of the month from 1 to 29, not '30'"),
    ("1992,6,22,3,60", "1992,6,31,3,60", "a day of the month from 1 to 30, not '31'"),
    ("1992,6,22,3,60,?9?9?9E0,11.5", "1992,6,22,3,60,?9?9?9E0,cold", "not 'cold'"),
    ("1992,6,22,3,60,?9?9?9E0,11.5", "1992,6,22,3\r\n", "year.epw:35:"),
])
def test_a_broken_epw_is_refused_at_its_line(program, tmp_path, old, new, message):
    text = epw_text()
    assert old in text
    (tmp_path / "year.epw").write_text(text.replace(old, new, 1))

    done = check(program, tmp_path, "year.epw")

    assert done.returncode == 1 and message in done.stderr
    assert not (tmp_path / "made.wth").exists()


def test_an_epw_without_the_scene_s_date_is_refused(program, tmp_path):
    (tmp_path / "year.epw").write_text(epw_text())

    done = check(program, tmp_path, "year.epw", time="1992-09-01T12:00:00-04:00")

    assert done.returncode == 1 and "year.epw: has no weather of the scene's date" in done.stderr


def test_hours_that_an_epw_lacks_are_named(program, tmp_path):
    gap = {(23, hour): {"wind": 999} for hour in (9, 10, 11)}
    (tmp_path / "year.epw").write_text(epw_text(change=gap))

    done = check(program, tmp_path, "year.epw")

    assert done.returncode == 1
    assert "year.epw: no wind at 33.25 h of the two days that end with the scene's" in done.stderr


def test_surfrad_s_utc_becomes_the_scene_s_clock(program, tmp_path):
    hours = lambda now: {"air": now.hour + now.minute / 60}
    (tmp_path / "roc.dat").write_text(surfrad_text(22, 23, 24, value=hours))
    rows, errors = history(program, tmp_path, "roc.dat")

    # noon is 16 UTC; samples are told by their end, their middles lie around it
    assert rows[96 + 48][AIR] == pytest.approx(16.0, abs=0.03)
    assert rows[96 + 48][PRESSURE] == pytest.approx(995.0)
    assert "covers" not in errors  # 20 h of the 21st to 20 h of the 24th


def test_an_edge_of_the_sun_between_two_records_stays_an_edge(program, tmp_path):
    # 14:07:30 local, halfway between records: 18:07:30 UTC; a sample ends at 18:06 and at 18:09
    until = datetime.datetime(1992, 6, 23, 18, 7, 30)
    cloud = lambda now: {"direct": 800.0 if now < until else 0.0}
    (tmp_path / "roc.dat").write_text(surfrad_text(22, 23, 24, value=cloud))
    rows, _ = history(program, tmp_path, "roc.dat")
    direct = rows[96:, DIRECT] * LANGLEY_PER_HOUR_W_M2

    assert direct[56] == pytest.approx(800.0, abs=0.01) and direct[57] == 0
    # The sun rises at 5.6 h: its first record is whole too.
    assert direct[22] == 0 and direct[23] == pytest.approx(800.0, abs=0.01)


def test_an_edge_elsewhere_keeps_its_energy(program, tmp_path):
    until = datetime.datetime(1992, 6, 23, 18, 3)
    cloud = lambda now: {"direct": 800.0 if now <= until else 0.0}
    (tmp_path / "roc.dat").write_text(surfrad_text(22, 23, 24, value=cloud))
    rows, _ = history(program, tmp_path, "roc.dat")

    # three of the five samples around 14:00 shine, the last from 14:00 to 14:03, and half a sample
    # begins before 13:52:30
    assert rows[96 + 56, DIRECT] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(800 * 4 / 5, abs=200)
    assert rows[96 + 57, DIRECT] == 0


def test_one_day_of_surfrad_stands_for_the_other_with_a_warning(program, tmp_path):
    (tmp_path / "roc.dat").write_text(surfrad_text(23, value=lambda now: {"air": now.hour}))
    rows, errors = history(program, tmp_path, "roc.dat")

    assert rows[48][AIR] == pytest.approx(rows[96 + 48][AIR])
    assert "roc.dat: covers 24 of the 48 hours" in errors


def test_missing_and_flagged_samples_are_left_out(program, tmp_path):
    def spoilt(now):
        return {"wind": -9999.9} if now.minute % 6 else {"air": 21.0}
    (tmp_path / "roc.dat").write_text(surfrad_text(22, 23, 24, value=spoilt))
    rows, _ = history(program, tmp_path, "roc.dat")

    assert rows[:, WIND] == pytest.approx(3.0)


def test_flag_one_makes_a_value_missing(program, tmp_path):
    flagged = lambda now: {"wind": 99.0, "flag": 1} if now.hour == 12 else {}
    (tmp_path / "roc.dat").write_text(surfrad_text(22, 23, 24, value=flagged))
    rows, _ = history(program, tmp_path, "roc.dat")

    assert rows[:, WIND] == pytest.approx(3.0)  # an hour is bridged


@pytest.mark.parametrize("old, new, message", [
    ("43.08  77.67  169", "43.08  west", "roc.dat:2:"),
    (" 1992 175 6 23 0 3", " 1992 175 6 23 24 3", "roc.dat:4:"),
    (" 1992 175 6 23 0 3", " 1e22 175 6 23 0 3", "roc.dat:4:"),
    (" 1992 175 6 23 0 3", " 1992 175 6 31 0 3", "roc.dat:4:"),
    (" 1992 175 6 23 0 3", " 1992 175 6 23.5 0 3", "roc.dat:4:"),
    (" 1992 175 6 23 0 3", " 1992 175 6 23 0 0", "a time after the one before"),
    ("3.0 0 180.0", "3.0 180.0", "roc.dat:3:"),
])
def test_a_broken_surfrad_day_is_refused_at_its_line(program, tmp_path, old, new, message):
    text = surfrad_text(23, step_min=15)
    text = text.replace(" 1992 175 6 23 0 15", " 1992 175 6 23 0 3", 1)
    assert old in text
    (tmp_path / "roc.dat").write_text(text.replace(old, new, 1))

    done = check(program, tmp_path, "roc.dat")

    assert done.returncode == 1 and message in done.stderr


def test_a_surfrad_day_of_another_date_is_refused(program, tmp_path):
    (tmp_path / "roc.dat").write_text(surfrad_text(10))

    done = check(program, tmp_path, "roc.dat")

    assert done.returncode == 1
    assert "roc.dat: goes from 1992-06-09T23:57:00" in done.stderr
    assert "the scene's day begins at 1992-06-23T04:00:00" in done.stderr


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_of_days_of_two_stations_the_nearest_are_taken(program, tmp_path, order):
    stations = [surfrad_text(22, 23, 24, value=lambda now: {"air": 15.0}),
                surfrad_text(22, 23, 24, value=lambda now: {"air": 25.0}, longitude="88.37")]
    (tmp_path / "roc.dat").write_text("".join(stations[i] for i in order))
    rows, errors = history(program, tmp_path, "roc.dat")

    assert rows[:, AIR] == pytest.approx(15.0)
    assert "roc.dat: has several places: Rochester at latitude 43.08, longitude -77.67 is the nearest" in errors


def test_radsig_thermal_takes_them_too(program, tmp_path):
    (tmp_path / "list.mat").write_text(
        "1\nslab\n1\n.22\n5.93\n2.114\n0\n.9\n.9\n-.5\nx.ems\nx.ext\n")
    (tmp_path / "year.epw").write_text(epw_text())

    done = program.run("thermal", "--materials", tmp_path / "list.mat", "--material", "slab",
                       "--weather", tmp_path / "year.epw", "--site", "43.083,-77.667", "--date",
                       "1992-06-23", "--utc-offset", "-4", "--thickness-cm", "5")

    assert done.returncode == 0, done.stderr
    assert len(done.stdout.splitlines()) == 194


def test_a_byte_order_mark_before_an_epw_changes_nothing(program, tmp_path):
    made = []
    for mark in ("", "\ufeff"):
        (tmp_path / "year.epw").write_text(mark + epw_text(), encoding="utf-8")
        made.append(history(program, tmp_path, "year.epw")[0])

    assert (made[0] == made[1]).all()
