"""Weather whose clock is not the sun's: light by night, noon away from the highest sun."""
import datetime

import pytest
from station_files import check, epw_text, history, light, surfrad_text

PLACE = (43.1, -77.7)

def year_of_light(days, rows_h, cloud=lambda day, hour: False):
    """An EPW of June whose rows are `rows_h` from UTC; its header states -5."""
    change = {}
    for day in range(25 - days, 25):
        for hour in range(1, 25):
            middle = datetime.datetime(1992, 6, day) + datetime.timedelta(hours=hour - 0.5 - rows_h)
            change[day, hour] = {"direct": 0, "diffuse": 60 if light(middle)["direct"] else 0} \
                if cloud(day, hour) else light(middle)
    return epw_text(first=(1992, 6, 25 - days), days=days, change=change, place=PLACE)


def warnings_of(program, folder, text, **site):
    (folder / "year.epw").write_text(text)
    return history(program, folder, "year.epw", **site)[1]


@pytest.mark.parametrize("rows_h, shift, fits", [(0, "5 h earlier", "+0"), (-12, "7 h later", "-12"),
                                                 (-8, "3 h later", "-8"), (3, "8 h earlier", "+3")])
@pytest.mark.parametrize("days", [3, 20])
def test_an_epw_with_a_wrong_time_zone_is_warned_about_with_the_one_that_fits(program, tmp_path, rows_h,
                                                                            shift, fits, days):
    errors = warnings_of(program, tmp_path, year_of_light(days, rows_h))

    assert "year.epw: its light does not fit the sun at latitude 43.1, longitude -77.7" in errors
    assert f"% of it falls by night: times {shift} would fit, or {fits} h from UTC where it states -5" in errors


def test_rows_in_summer_time_are_an_hour_away_from_the_highest_sun(program, tmp_path):
    errors = warnings_of(program, tmp_path, year_of_light(20, -4))

    assert "times 1 h earlier would fit, or -4 h from UTC where it states -5" in errors


@pytest.mark.parametrize("days", [3, 20])
def test_a_clock_that_fits_is_no_cause_for_a_warning(program, tmp_path, days):
    assert " fit" not in warnings_of(program, tmp_path, year_of_light(days, -5))


@pytest.mark.parametrize("cloudy", [range(1, 13), range(13, 25), range(1, 10)])
def test_clouds_before_or_after_noon_are_no_wrong_clock(program, tmp_path, cloudy):
    text = year_of_light(3, -5, cloud=lambda day, hour: hour in cloudy)

    assert " fit" not in warnings_of(program, tmp_path, text)


def test_without_light_the_longitude_tells_that_an_offset_is_odd(program, tmp_path):
    dark = {(day, hour): {"direct": 0, "diffuse": 0} for day in range(21, 25) for hour in range(1, 25)}
    text = epw_text(change=dark)

    assert "time zone right" not in warnings_of(program, tmp_path, text)
    errors = warnings_of(program, tmp_path, text.replace("-5.0,169.0", "0,169.0"))
    assert "states +0 h from UTC, at longitude -77.7 the sun's time is -5.2 h from it" in errors


def test_a_surfrad_day_in_local_time_is_warned_about(program, tmp_path):
    local = lambda now: light(now + datetime.timedelta(hours=5))
    (tmp_path / "roc.dat").write_text(surfrad_text(22, 23, 24, value=local))
    _, errors = history(program, tmp_path, "roc.dat")

    assert "roc.dat: its light does not fit the sun" in errors and "times 5 h later would fit" in errors


def test_a_table_in_utc_is_warned_about_with_the_shift_that_fits(program, tmp_path):
    midnight = datetime.datetime(1992, 6, 22)
    rows = ["time [h],air_temperature [C],pressure [hPa],wind [m/s],dew_point [C],direct [W/m2],"
            "diffuse [W/m2]"]
    for i in range(96):
        value = light(midnight + datetime.timedelta(hours=i / 2))  # rows are UTC, read as the scene's -4
        rows.append(f"{i / 2},20,1000,2,10,{value['direct']},{value['diffuse']}")
    (tmp_path / "two.csv").write_text("\n".join(rows) + "\n")

    done = check(program, tmp_path, "two.csv")

    assert done.returncode == 0 and "two.csv: has sunlight in" in done.stderr
    assert "two.csv: its light would fit the sun if its times were 4 h earlier" in done.stderr
