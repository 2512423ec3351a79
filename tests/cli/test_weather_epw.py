"""EPW years with several records an hour."""
import datetime

import numpy as np
import pytest
from station_files import AIR, DIFFUSE, DIRECT, LANGLEY_PER_HOUR_W_M2, check, epw_text, history, light

QUARTERS = (15, 30, 45, 60)
PLACE = (43.1, -77.7)


def sun_of(minutes):
    """Air that counts the quarters of a day, light of the sun in the middle of each record."""
    step = 60 // len(minutes)
    change = {}
    for day in range(21, 25):
        for hour in range(1, 25):
            for minute in minutes:
                end = datetime.datetime(1992, 6, day) + datetime.timedelta(hours=5 + hour - 1, minutes=minute)
                sun = light(end - datetime.timedelta(minutes=step / 2), PLACE)
                change[day, hour, minute] = {**sun, "air": round(10 + (hour - 1 + minute / 60) / 2, 3)}
    return change


def read(program, folder, text):
    (folder / "year.epw").write_text(text)
    return history(program, folder, "year.epw")


@pytest.mark.parametrize("minutes", [QUARTERS, (30, 60), (20, 40, 60), tuple(range(10, 61, 10))])
def test_records_of_an_hour_end_at_their_minutes(program, tmp_path, minutes):
    rows, errors = read(program, tmp_path, epw_text(change=sun_of(minutes), minutes=minutes))

    # the scene's clock is an hour ahead of the file's; of short spans a record has the mean around it
    for row in range(108, 180, 12):  # not at midnight, where the air falls by 12 C
        assert rows[row][AIR] == pytest.approx(10 + ((row - 96) / 4 - 1) / 2, abs=0.07)
    noon = 96 + 4 * 13
    middle = light(datetime.datetime(1992, 6, 23, 17), PLACE)
    assert rows[noon, DIRECT] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(middle["direct"], rel=0.01)
    assert rows[noon, DIFFUSE] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(middle["diffuse"], rel=0.02)
    assert " fit" not in errors


@pytest.mark.parametrize("text, expected", [
    (epw_text(minutes=(0, 15, 30, 45)), "expected hours 1 to 24, and minutes 15 to 60 by 15 at which records end"),
    (epw_text(minutes=(60,), an_hour=4), "year.epw: states 4 records an hour, and has one"),
    (epw_text(minutes=QUARTERS, an_hour=1, change={(23, 12, 15): {"air": 30}}), "year.epw: has two rows for 1992-06-23T13:00:00-04:00 which differ"),
    (epw_text(minutes=(7, 14, 21, 28, 35, 42, 49, 56)), "expected DATA PERIODS,1,1,... : records an hour that divide 60"),
    (epw_text(minutes=QUARTERS, change={(day, hour): {"infrared": 82} for day in range(21, 25) for hour in range(1, 25)}),
     "year.epw: its infrared radiation is at most 82: expected means in W/m2"),
], ids=["minutes that begin", "one alone", "more than one", "no part of an hour", "sums"])
def test_records_that_are_not_what_is_stated_are_refused(program, tmp_path, text, expected):
    (tmp_path / "year.epw").write_text(text)
    done = check(program, tmp_path, "year.epw")

    assert done.returncode == 1 and expected in done.stderr


def test_an_hour_in_quarters_is_the_hour(program, tmp_path):
    """The same values in four records as in one."""
    quarters, _ = read(program, tmp_path, epw_text(minutes=QUARTERS))
    hours, _ = read(program, tmp_path, epw_text())

    assert np.sum(quarters[96:192, DIRECT]) == pytest.approx(np.sum(hours[96:192, DIRECT]), rel=0.01)


@pytest.mark.parametrize("day", range(11, 19))
def test_quarters_around_sunrise_are_whole_on_every_day(program, tmp_path, day):
    """The middle of a record may lie before sunrise and the time that it is taken for behind; sunrise moves by 14 minutes."""
    (tmp_path / "year.epw").write_text(epw_text(first=(1992, 3, 10), days=10, minutes=QUARTERS))
    rows, _ = history(program, tmp_path, "year.epw", time=f"1992-03-{day}T15:00:00-05:00")

    assert np.isfinite(rows).all()
