"""Weather with values that are missing, out of range, or can be derived."""
import datetime

import numpy as np
import pytest
from station_files import (AIR, DEW, DIFFUSE, DIRECT, LANGLEY_PER_HOUR_W_M2, PRESSURE, TIME,
                           check, epw_text, history, surfrad_text)

HOURS = range(1, 25)
DAYS = (21, 22, 23, 24)


def everywhere(**values):
    return {(day, hour): values for day in DAYS for hour in HOURS}


def of_epw(program, folder, text=None, **site):
    (folder / "year.epw").write_text(text or epw_text())
    return history(program, folder, "year.epw", **site)


def record_at(rows, hour):
    """The record of the scene's day at an hour of standard time, 5 h behind UTC; its clock is 4 h behind."""
    return rows[96 + round(4 * (hour + 1))]


@pytest.mark.parametrize("quantity, field", [("direct", DIRECT), ("diffuse", DIFFUSE)])
def test_a_missing_hour_of_light_is_bridged(program, tmp_path, quantity, field):
    whole, _ = of_epw(program, tmp_path)
    rows, _ = of_epw(program, tmp_path, epw_text(change={(23, 12): {quantity: 9999}}))

    # 500 and 90 W/m2 in all hours: shares of the clear sky's, which hardly moves around noon
    assert rows[:, field] == pytest.approx(whole[:, field], rel=0.01, abs=0.01)


@pytest.mark.parametrize("quantity, name", [("direct", "direct sun"), ("diffuse", "diffuse light")])
def test_more_hours_of_light_that_are_missing_are_refused_by_name_and_hour(program, tmp_path, quantity,
                                                                           name):
    gap = {(23, hour): {quantity: 9999} for hour in (12, 13)}
    (tmp_path / "year.epw").write_text(epw_text(change=gap))

    done = check(program, tmp_path, "year.epw")

    assert done.returncode == 1 and not (tmp_path / "made.wth").exists()
    # 11 to 13 standard time is 12 to 14 by the clock; the record between two hours needs both
    assert f"year.epw: no {name} at 36.00 h of the two days" in done.stderr
    assert "until 38.00 h" in done.stderr


def test_light_that_is_missing_by_night_is_none(program, tmp_path):
    night = {(day, hour): {"direct": 9999, "diffuse": 9999} for day in DAYS for hour in (1, 2, 3, 23, 24)}
    whole, _ = of_epw(program, tmp_path)
    rows, _ = of_epw(program, tmp_path, epw_text(change=night))

    assert (rows == whole).all()


@pytest.mark.parametrize("change", [{"air": 99.9}, {"wind": 999}, {"pressure": 999999}, {"dew": 99.9},
                                    {"air": -99.9}, {"air": ""}, {"wind": 9999.0}, {"dew": 999.9},
                                    {"dew": -999}, {"wind": "NaN"}, {"pressure": "-"}])
def test_a_single_missing_hour_is_bridged(program, tmp_path, change):
    whole, _ = of_epw(program, tmp_path)
    rows, _ = of_epw(program, tmp_path, epw_text(change={(23, 9): change}))

    assert rows == pytest.approx(whole, abs=0.02)


def test_a_row_that_is_absent_is_bridged_like_a_missing_hour(program, tmp_path):
    whole, _ = of_epw(program, tmp_path)
    lines = [line for line in epw_text().split("\r\n") if not line.startswith("1992,6,23,9,")]
    rows, _ = of_epw(program, tmp_path, "\r\n".join(lines))

    # 500 W/m2 in all hours are a share of the clear sky's that bends: 2.4 % at 9 h
    assert rows == pytest.approx(whole, rel=0.03, abs=0.02)


@pytest.mark.parametrize("change", [{"direct": 1903}, {"diffuse": -1845}, {"wind": 140}, {"air": 75}])
@pytest.mark.parametrize("day", [21, 23])
def test_a_value_out_of_range_counts_as_missing_with_a_warning(program, tmp_path, change, day):
    whole, _ = of_epw(program, tmp_path)
    rows, errors = of_epw(program, tmp_path, epw_text(change={(day, 12): change}))

    # 500 W/m2 in all hours are a share of the clear sky's that bends: 2.4 % at 9 h
    assert rows == pytest.approx(whole, rel=0.03, abs=0.02)
    line = 8 + 24 * (day - 21) + 12
    assert f"year.epw: counts as missing what is out of range: line {line}: " in errors
    assert f"not {next(iter(change.values()))}" in errors


def test_many_values_out_of_range_are_one_warning(program, tmp_path):
    _, errors = of_epw(program, tmp_path, epw_text(change={(21, hour): {"direct": 1903}
                                                          for hour in (9, 10, 11)}))

    assert errors.count("counts as missing") == 1
    assert "counts as missing 3 values that are out of range, the first in line 17" in errors


def test_a_bad_value_of_a_surfrad_day_does_not_spoil_the_next(program, tmp_path):
    bad = datetime.datetime(1992, 6, 22, 17)
    spoilt = lambda now: {"rh": 110.5, "air": 99.9} if now == bad else {}
    (tmp_path / "roc.dat").write_text(surfrad_text(22, 23, 24, value=spoilt))
    rows, errors = history(program, tmp_path, "roc.dat")

    assert rows[:, AIR] == pytest.approx(20.0)
    assert "relative humidity from 0 to 110 %, not 110.5" in errors


def test_the_dew_point_follows_from_relative_humidity(program, tmp_path):
    rows, errors = of_epw(program, tmp_path, epw_text(change=everywhere(dew=99.9, rh=50, air=20.0)))

    assert rows[:, DEW] == pytest.approx(9.27, abs=0.02)  # Magnus, WMO-No. 8: 50 % at 20 C
    assert "year.epw: the dew point of 48 hours follows from the relative humidity" in errors


def test_without_dew_point_and_relative_humidity_there_is_no_humidity(program, tmp_path):
    (tmp_path / "year.epw").write_text(epw_text(change=everywhere(dew=99.9)))

    done = check(program, tmp_path, "year.epw")

    assert done.returncode == 1 and "year.epw: no humidity at 0.00 h" in done.stderr


def test_the_pressure_follows_from_the_elevation(program, tmp_path):
    text = epw_text(change=everywhere(pressure=999999)).replace("-5.0,169.0", "-5.0,1600.0")
    rows, errors = of_epw(program, tmp_path, text)

    assert rows[:, PRESSURE] == pytest.approx(835.24, abs=0.05)  # ISO 2533 at 1600 m, in hPa
    assert "the pressure of 48 hours is that of the standard atmosphere at 1600 m" in errors


def erbs(clearness):
    k = clearness
    return np.where(k <= 0.22, 1 - 0.09 * k,
                    np.where(k <= 0.8, 0.9511 - 0.1604 * k + 4.388 * k**2 - 16.638 * k**3 + 12.336 * k**4,
                             0.165))


def test_direct_and_diffuse_follow_from_the_global_irradiance(program, tmp_path):
    change = {(day, hour): {"global": 400 if 9 <= hour <= 17 else 0, "direct": 9999, "diffuse": 9999}
              for day in DAYS for hour in HOURS}
    rows, errors = of_epw(program, tmp_path, epw_text(change=change))
    noon = record_at(rows, 12.5)  # within the hour 12 to 13

    # 12:30 standard time is 12:17 by the sun: 19.9 degrees from the zenith; 1.0163 au
    beyond = 1367 / 1.0163**2 * np.cos(np.radians(19.9))
    diffuse = 400 * erbs(400 / beyond)
    assert noon[DIFFUSE] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(diffuse, rel=0.02)
    assert noon[DIRECT] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(
        (400 - diffuse) / np.cos(np.radians(19.9)), rel=0.02)
    assert "follow from the global irradiance, by the diffuse fraction of Erbs (1982)" in errors


def test_diffuse_light_is_what_the_beam_leaves_of_the_global_irradiance(program, tmp_path):
    change = {(23, hour): {"global": 600, "direct": 500, "diffuse": 9999} for hour in (12, 13)}
    rows, errors = of_epw(program, tmp_path, epw_text(change=change))
    noon = record_at(rows, 12.5)

    assert noon[DIFFUSE] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(
        600 - 500 * np.cos(np.radians(19.9)), rel=0.02)
    assert "direct or diffuse light of 2 hours is what the other leaves" in errors


def test_a_global_irradiance_that_does_not_fit_the_hours_around_bridges_nothing(program, tmp_path):
    whole, _ = of_epw(program, tmp_path)
    change = {(day, hour): {"global": 200} for day in DAYS for hour in range(9, 17)}
    change[23, 12] = {"global": 200, "direct": 9999}
    rows, _ = of_epw(program, tmp_path, epw_text(change=change))

    assert rows[:, DIRECT] == pytest.approx(whole[:, DIRECT], rel=0.01, abs=0.01)


# Typical years have no 29 February.
@pytest.mark.parametrize("date, day_before, day", [("02-28", 27, 28), ("02-29", 28, 28), ("03-01", 28, 1)])
def test_28_february_stands_for_the_29th_of_a_typical_year(program, tmp_path, date, day_before, day):
    text = epw_text(first=(2023, 2, 25), days=7,
                    change={(d, hour): {"air": d} for d in (25, 26, 27, 28, 1, 2, 3) for hour in HOURS})
    rows, errors = of_epw(program, tmp_path, text, time=f"2024-{date}T12:00:00-05:00")

    assert rows[48][AIR] == day_before and rows[96 + 48][AIR] == day
    assert ("has no 29 February: 28 February stands for it" in errors) == (date != "02-28")


def test_29_february_of_a_file_that_has_it_is_taken(program, tmp_path):
    text = epw_text(first=(2020, 2, 26), days=5,
                    change={(d, hour): {"air": d} for d in (26, 27, 28, 29, 1) for hour in HOURS})
    leap, errors = of_epw(program, tmp_path, text, time="2024-02-29T12:00:00-05:00")
    other, _ = of_epw(program, tmp_path, text, time="2023-03-01T12:00:00-05:00")

    assert leap[96 + 48][AIR] == 29 and "stands for it" not in errors
    assert other[48][AIR] == 28 and other[96 + 48][AIR] == 1


def two_years(first, second):
    rows = [epw_text(first=(year, 6, 21), change={(day, hour): {"air": air} for day in DAYS for hour in HOURS})
            for year, air in ((first, 10), (second, 20))]
    return rows[0] + "\r\n".join(rows[1].split("\r\n")[8:])


@pytest.mark.parametrize("year, air", [(1991, 10), (1992, 20)])
def test_of_several_years_that_of_the_scene_is_taken(program, tmp_path, year, air):
    rows, _ = of_epw(program, tmp_path, two_years(1991, 1992), time=f"{year}-06-23T15:00:00-04:00")

    assert rows[:, AIR] == pytest.approx(air)


def test_several_years_without_the_scene_s_are_refused_with_their_list(program, tmp_path):
    (tmp_path / "year.epw").write_text(two_years(2001, 1992))

    done = check(program, tmp_path, "year.epw", time="2024-06-23T15:00:00-04:00")

    assert done.returncode == 1
    assert "year.epw: has several years of the scene's day" in done.stderr
    assert "in one of them: 1992 2001" in done.stderr


# 28 September at 40 N, 105 W: the sun rises at 5:57 standard time, so the hour that ends at 6 has its
# last minutes alone.
SPIKE = {"latitude_deg": 40.0, "longitude_deg": -105.0, "time": "2023-09-28T12:00:00-07:00"}


def of_sunrise(program, folder, light):
    change = {(day, hour): {"direct": light.get(hour, 0), "diffuse": 0} for day in (26, 27, 28, 29)
              for hour in HOURS}
    text = epw_text(first=(2023, 9, 26), change=change, place=(40.0, -105.0)).replace("-5.0,", "-7.0,", 1)
    return of_epw(program, folder, text, **SPIKE)[0]


def test_light_of_a_sunrise_hour_is_no_flash_and_keeps_its_energy(program, tmp_path):
    light = {6: 100, 7: 346, 8: 506, 9: 587, 10: 638, 11: 669, 12: 680, 13: 669, 14: 638, 15: 587,
             16: 506, 17: 346, 18: 100}
    day = of_sunrise(program, tmp_path, light)[96:192]
    direct = day[:, DIRECT] * LANGLEY_PER_HOUR_W_M2

    assert direct.sum() / 4 == pytest.approx(sum(light.values()), rel=1e-3)
    # Bird's clear sky at 8.2 degrees, air mass 6.6, has some 580 W/m2; a tenth more is allowed
    assert direct.max() < 720 and direct[day[:, TIME] < 24 + 6.1].max() < 120


def test_light_of_an_hour_before_sunrise_goes_to_the_first_that_has_sun(program, tmp_path):
    rows = of_sunrise(program, tmp_path, {5: 20, 6: 0, 7: 100, 8: 300})
    day = rows[96:192]

    assert (day[day[:, TIME] < 24 + 5.9, DIRECT] == 0).all()
    assert day[:, DIRECT].sum() * LANGLEY_PER_HOUR_W_M2 / 4 == pytest.approx(420, rel=1e-3)


def test_wind_that_is_missing_for_longer_is_told_from_hour_to_hour(program, tmp_path):
    (tmp_path / "year.epw").write_text(
        epw_text(change={(23, hour): {"wind": 999} for hour in (9, 10, 11)}))

    done = check(program, tmp_path, "year.epw")

    # 8 h and 12 h of standard time have wind: 33 and 37 h by the clock
    assert "no wind at 33.25 h of the two days that end with the scene's, until 36.75 h" in done.stderr


def test_relative_humidity_in_fractions_is_refused(program, tmp_path):
    (tmp_path / "year.epw").write_text(epw_text(change=everywhere(dew=99.9, rh=0.55)))

    done = check(program, tmp_path, "year.epw")

    assert done.returncode == 1
    assert "year.epw: its relative humidity is at most 0.55 %: expected per cent, not fractions" in done.stderr


def test_dew_points_above_the_air_are_told(program, tmp_path):
    rows, errors = of_epw(program, tmp_path, epw_text(change=everywhere(air=15.0, dew=18.0)))
    _, noise = of_epw(program, tmp_path, epw_text(change=everywhere(air=15.0, dew=15.4)))

    assert rows[:, DEW] == pytest.approx(15.0)
    assert "year.epw: the dew point of 48 hours lies above the air's temperature, which is taken for it" in errors
    assert "lies above" not in noise
