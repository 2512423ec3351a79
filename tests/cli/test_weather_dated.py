"""Weather from tables with dates: TMY3, NSRDB, ERA5's points, PVGIS, and others with a column of times."""
import datetime
import re

import numpy as np
import pytest
from station_files import (AIR, DEW, DIFFUSE, DIRECT, LANGLEY_PER_HOUR_W_M2, PRESSURE, RAIN, SITE, WIND,
                           check, height, history, light, surfrad_text)

PLACE = (43.083, -77.667)
NOON = 96 + 52  # 13:00 by the scene's clock, 4 h behind UTC, is 12:00 standard time and 17:00 UTC


def hours(count=96, first=(1992, 6, 21), step_h=1.0):
    begin = datetime.datetime(*first)
    return [begin + datetime.timedelta(hours=i * step_h) for i in range(count)]


def weather(utc, middle):
    """Air by the hour of UTC; light of the sun at `middle`."""
    sun = light(middle, PLACE)
    return {"air": 10 + utc.hour / 2, "dew": 5.0, "rh": 60.0, "pressure": 995.0, "wind": 3.0, **sun,
            "global": round(sun["direct"] * max(0, height(middle, PLACE)) + sun["diffuse"])}


def read(program, folder, text, name="year.csv", **site):
    (folder / name).write_text(text, encoding="utf-8")
    return history(program, folder, name, **site)


TMY3_NAMES = ("Date (MM/DD/YYYY),Time (HH:MM),ETR (W/m^2),GHI (W/m^2),GHI source,DNI (W/m^2),DNI source,"
              "DHI (W/m^2),DHI source,OpqCld (tenths),Dry-bulb (C),Dry-bulb source,Dew-point (C),RHum (%),"
              "Pressure (mbar),Wspd (m/s),Lprecip depth (mm),Lprecip quantity (hr)")


def tmy3_text(change=None, first=(1992, 6, 21), years=None, place=PLACE):
    """Hours that end at 01:00 to 24:00, in standard time, 5 h behind UTC."""
    text = f'725290,"ROCHESTER, NY",NY,-5.0,{place[0]},{place[1]},169\n{TMY3_NAMES}\n'
    for start in hours(first=first):
        utc = start + datetime.timedelta(hours=6)
        v = {**weather(utc, utc - datetime.timedelta(minutes=30)), "cover": 2, "rain": "-9900", "rain_h": 1,
             **((change or {}).get((start.day, start.hour + 1), {}))}
        year = (years or {}).get(start.day, start.year)
        text += (f"{start.month:02}/{start.day:02}/{year},{start.hour + 1:02}:00,0,{v['global']},1,{v['direct']},"
                 f"1,{v['diffuse']},1,{v['cover']},{v['air']},A,{v['dew']},{v['rh']},{v['pressure']},{v['wind']},"
                 f"{v['rain']},{v['rain_h']}\n")
    return text


def test_a_tmy3_hour_stands_at_its_end(program, tmp_path):
    rows, errors = read(program, tmp_path, tmy3_text())

    assert rows[NOON][AIR] == pytest.approx(10 + 17 / 2) and rows[NOON][DEW] == pytest.approx(5.0)
    assert rows[NOON][PRESSURE] == pytest.approx(995.0) and rows[NOON][WIND] == pytest.approx(3.0)
    assert rows[NOON, DIRECT] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(
        light(hours(first=(1992, 6, 23))[17], PLACE)["direct"], rel=0.02)
    assert " fit" not in errors and "km from" not in errors


def test_flags_of_tmy3_are_gaps_and_rain_is_that_of_its_hours(program, tmp_path):
    whole, _ = read(program, tmp_path, tmy3_text())
    change = {(23, 9): {"air": -9900, "dew": -9900, "wind": -9900}}
    change |= {(day, hour): {"rain": 12, "rain_h": 6} for day in (22, 23, 24) for hour in range(1, 25)}
    rows, errors = read(program, tmp_path, tmy3_text(change))

    assert rows[:, [AIR, DEW, WIND]] == pytest.approx(whole[:, [AIR, DEW, WIND]], abs=0.01)
    assert rows[96:, RAIN] == pytest.approx(0.2) and "out of range" not in errors  # cm/h


def test_light_of_which_one_part_is_in_another_unit_is_told(program, tmp_path):
    _, plain = read(program, tmp_path, tmy3_text())
    _, errors = read(program, tmp_path, tmy3_text().replace("DNI (W/m^2)", "DNI (kJ/m^2)"))

    assert "year.csv: its global irradiance differs from its direct and diffuse light by" in errors
    assert "differs" not in plain


def test_months_of_tmy3_may_be_of_several_years(program, tmp_path):
    rows, errors = read(program, tmp_path, tmy3_text(years={21: 1988, 22: 1988, 23: 1975, 24: 1975}),
                        time="2024-06-23T15:00:00-04:00")

    assert rows[NOON][AIR] == pytest.approx(18.5) and "is the weather of" not in errors


def test_28_february_stands_for_the_29th_of_tmy3(program, tmp_path):
    rows, errors = read(program, tmp_path, tmy3_text(first=(1991, 2, 26)), time="2024-02-29T12:00:00-05:00")

    assert len(rows) == 193 and "year.csv: has no 29 February: 28 February stands for it" in errors


def nsrdb_text(step_h=0.5, units=("c", "mbar", "m/s"), change=None, head=True):
    """Times are those of the values, in standard time."""
    text = ("Source,Location ID,City,Latitude,Longitude,Time Zone,Elevation,Local Time Zone,Temperature Units,"
            "Pressure Units,Wind Speed Units,GHI Units,Version\n"
            f"NSRDB,401182,-,{PLACE[0]},{PLACE[1]},-5,169,-5,{','.join(units)},w/m2,v3.2.2\n") if head else ""
    text += "Year,Month,Day,Hour,Minute,DHI,GHI,DNI,Dew Point,Wind Speed,Temperature,Pressure,,,\n"
    for i, start in enumerate(hours(round(96 / step_h), step_h=step_h)):
        utc = start + datetime.timedelta(hours=5)
        v = {**weather(utc, utc), **((change or {}).get(i, {}))}
        text += (f"{start.year},{start.month},{start.day},{start.hour},{start.minute},{v['diffuse']},{v['global']},"
                 f"{v['direct']},{v['dew']},{v['wind']},{v['air']},{v['pressure']},,,\n")
    return text


@pytest.mark.parametrize("step_h", [1.0, 0.5, 0.25, 1 / 12])
def test_values_of_nsrdb_are_those_of_their_times(program, tmp_path, step_h):
    rows, errors = read(program, tmp_path, nsrdb_text(step_h))

    # means of the 15 minutes around, where times are closer than that
    assert rows[NOON][AIR] == pytest.approx(18.5, abs=0.3)
    assert rows[NOON, DIRECT] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(
        light(hours(first=(1992, 6, 23))[17], PLACE)["direct"], rel=0.02)
    assert " fit" not in errors and "no place" not in errors


def test_units_of_nsrdb_s_head_count(program, tmp_path):
    kelvin = {i: {"air": 290.15, "pressure": 99500} for i in range(192)}
    rows, _ = read(program, tmp_path, nsrdb_text(units=("K", "Pa", "km/h"), change=kelvin))

    assert rows[:, AIR] == pytest.approx(17.0) and rows[:, PRESSURE] == pytest.approx(995.0)
    assert rows[:, WIND] == pytest.approx(3 / 3.6, abs=1e-3)


def test_a_table_without_place_and_offset_is_the_scene_s(program, tmp_path):
    rows, errors = read(program, tmp_path, nsrdb_text(head=False), time="1992-06-23T15:00:00-05:00")

    assert rows[96 + 48][AIR] == pytest.approx(18.5)
    assert "its times state no offset from UTC: they are taken to be the scene's, UTC-5" in errors
    assert "names no place: it is taken to be the scene's" in errors


def era5_text(points=(PLACE,), change=None, names="valid_time,latitude,longitude,t2m,d2m,sp,u10,v10,ssrd,strd,tp"):
    """Hours that end at their times, UTC; sums in J/m2."""
    text = names + "\n"
    for utc in hours():
        for k, (latitude, longitude) in enumerate(points):
            v = weather(utc, utc - datetime.timedelta(minutes=30)) | (change or {}).get(k, {})
            text += (f"{utc:%Y-%m-%d %H:%M:%S},{latitude},{longitude},{v['air'] + 273.15},{v['dew'] + 273.15},"
                     f"{100 * v['pressure']},1.8,-2.4,{3600 * v['global']},{3600 * 330},0.001\n")
    return text


def test_era5_s_sums_and_kelvins_become_what_they_are(program, tmp_path):
    rows, errors = read(program, tmp_path, era5_text())

    assert rows[NOON][AIR] == pytest.approx(18.5, abs=1e-2) and rows[NOON][PRESSURE] == pytest.approx(995.0)
    assert rows[:, WIND] == pytest.approx(3.0, abs=1e-3)  # of 1.8 and 2.4
    assert rows[:, RAIN] == pytest.approx(0.1)  # cm/h
    assert re.search(r"direct and diffuse light of 3\d hours follow from the global irradiance", errors)
    whole = light(hours(first=(1992, 6, 23))[17], PLACE)
    level = rows[NOON][DIRECT] * height(hours(first=(1992, 6, 23))[17], PLACE) + rows[NOON][DIFFUSE]
    expected = whole["direct"] * height(hours(first=(1992, 6, 23))[17], PLACE) + whole["diffuse"]
    assert level * LANGLEY_PER_HOUR_W_M2 == pytest.approx(expected, rel=0.03)


def test_of_several_points_the_nearest_is_taken(program, tmp_path):
    points = [(43.0, -78.0), (43.0, -77.75), (43.25, -77.75)]
    rows, errors = read(program, tmp_path, era5_text(points, {1: {"pressure": 970.0}}))

    assert rows[:, PRESSURE] == pytest.approx(970.0)
    assert "year.csv: has several places: a point at latitude 43, longitude -77.75 is the nearest" in errors


def test_a_table_of_pvlib_s_names_with_times_and_offsets(program, tmp_path):
    text = ",temp_air,temp_dew,pressure,wind_speed,ghi,dni,dhi\n"
    for local in hours():
        utc = local + datetime.timedelta(hours=7)
        v = weather(utc, utc)
        text += (f"{local:%Y-%m-%d %H:%M:%S}-07:00,{v['air']},{v['dew']},{100 * v['pressure']},{v['wind']},"
                 f"{v['global']},{v['direct']},{v['diffuse']}\n")
    rows, errors = read(program, tmp_path, text)

    assert rows[NOON][AIR] == pytest.approx(18.5) and rows[NOON][PRESSURE] == pytest.approx(995.0)
    assert " fit" not in errors and "offset" not in errors


PVLIB_NAMES = "timestamp,temp_air,relative_humidity,pressure,wind,ghi,dni,dhi"


def pvlib_text(names=PVLIB_NAMES, change=None, form="%Y-%m-%dT%H:%M-05:00", more=""):
    """Hours by standard time, 5 h behind UTC; `more` stands behind them."""
    text = names + "\n"
    for local in hours():
        utc = local + datetime.timedelta(hours=5)
        v = {**weather(utc, utc), **(change or {})}
        text += f"{local.strftime(form)},{v['air']},{v['rh']},{v['pressure']},{v['wind']},{v['global']},{v['direct']},{v['diffuse']}\n"
    return text + more


@pytest.mark.parametrize("before", ["sep=,\n", "# logger 7\n# north roof\n"])
def test_a_spreadsheet_s_separator_and_comments_may_stand_above_the_names(program, tmp_path, before):
    plain, _ = read(program, tmp_path, pvlib_text())
    rows, _ = read(program, tmp_path, before + pvlib_text())

    assert (rows == plain).all()


def test_a_row_that_repeats_another_changes_nothing(program, tmp_path):
    plain, _ = read(program, tmp_path, pvlib_text())
    rows, _ = read(program, tmp_path, pvlib_text(more=pvlib_text().split("\n")[60] + "\n"))

    assert (rows == plain).all()


def pvgis_text():
    text = ("Latitude (decimal degrees): 43.083\nLongitude (decimal degrees): -77.667\nElevation (m): 169.0\n"
            "\nmonth,year\n6,2009\n7,2010\n\ntime(UTC),T2m,RH,G(h),Gb(n),Gd(h),IR(h),WS10m,WD10m,SP\n")
    for utc in hours(first=(2009, 6, 21)):
        v = weather(utc, utc)
        text += (f"{utc:%Y%m%d:%H%M},{v['air']},{v['rh']},{v['global']},{v['direct']},{v['diffuse']},330,3.0,5.0,"
                 f"{100 * v['pressure']}\n")
    return text + "\nT2m: 2-m air temperature (degree Celsius)\nRH: relative humidity (%)\nPVGIS (c) EU, 2001-2021\n"


def test_pvgis_is_read_between_its_texts(program, tmp_path):
    rows, errors = read(program, tmp_path, pvgis_text())

    assert rows[NOON][AIR] == pytest.approx(18.5) and rows[NOON][PRESSURE] == pytest.approx(995.0)
    assert rows[NOON, DIRECT] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(
        light(hours(first=(1992, 6, 23))[17], PLACE)["direct"], rel=0.02)
    assert "is the weather of 2009, the scene's year is 1992" in errors and " fit" not in errors


def test_a_table_of_hours_has_its_global_irradiance_split(program, tmp_path):
    text = "time [h],air_temperature [C],pressure [hPa],wind [m/s],dew_point [C],global [W/m2]\n"
    for i, utc in enumerate(hours(48, first=(1992, 6, 22))):
        v = weather(utc, utc + datetime.timedelta(hours=4))
        text += f"{i},20,1000,2,10,{v['global']}\n"
    rows, errors = read(program, tmp_path, text)
    noon = rows[24 + 13]

    assert "follow from the global irradiance, by the diffuse fraction of Erbs (1982)" in errors
    sun = height(hours(first=(1992, 6, 23))[17], PLACE)
    known = light(hours(first=(1992, 6, 23))[17], PLACE)
    assert (noon[DIRECT] * sun + noon[DIFFUSE]) * LANGLEY_PER_HOUR_W_M2 == pytest.approx(
        known["direct"] * sun + known["diffuse"], rel=0.01)
    assert noon[DIRECT] > noon[DIFFUSE] > 0


@pytest.mark.parametrize("text, message", [
    (tmy3_text().replace("06/23/1992,09:00", "06/31/1992,09:00"), "expected a date and a time such as 2019-01-31T12:30-07:00, not '06/31/1992'"),
    (tmy3_text().replace("06/23/1992,09:00", "06/23/1992,25:00"), "expected a date and a time"),
    (tmy3_text(place=(143.1, -77.7)), "year.csv:1: "),
    (nsrdb_text().replace("1992,6,23,9,0,", "1992,13,23,9,0,"), "a month from 1 to 12, not '13'"),
    (nsrdb_text().replace("Temperature,Pressure", "Temperature [W/m2],Pressure"),
     "another unit of air temperature, as C, not 'W/m2'"),
    (nsrdb_text().replace("Wind Speed,Temp", "Wind,Warmth,Temp", 1).replace(",Temperature,", ",Heat,"),
     "no air temperature"),
    (era5_text().replace("1992-06-23 09:00:00,43.083", "1992-06-23 09:00:00,north"), "a latitude and a longitude"),
    (pvlib_text(more="1992-06-23T12:00-05:00,60,60,995,3,0,0,0\n"), "year.csv: has two rows for 1992-06-23T13:00:00-04:00 which differ"),
    (pvlib_text(change={"rh": 0.6}), "year.csv: its relative humidity is at most 0.6 %: expected per cent, not fractions"),
    (pvlib_text(form="%m/%d/%Y %I:%M %p"), "year.csv:2: found '06/21/1992 12:00 AM"),
    (pvlib_text(form="%d.%m.%Y %H:%M"), "not '21.06.1992 00:00'"),
    (pvlib_text(PVLIB_NAMES.replace("relative_humidity", "temp_air")), "expected one column 'temp_air', not two"),
    (pvlib_text(change={"air": 68.0}), "air temperature from -90 to 60 C, not 68"),
    (pvlib_text(change={"air": "12,5"}), "8 fields, one for each name, not 9"),
    (pvlib_text()[:-30], "8 fields, one for each name, not"),
], ids=range(15))
def test_a_broken_table_is_refused_with_the_reason(program, tmp_path, text, message):
    (tmp_path / "year.csv").write_text(text)

    done = check(program, tmp_path, "year.csv")

    assert done.returncode == 1 and message in done.stderr and "year.csv" in done.stderr


def test_a_day_of_solrad_is_refused_with_the_reason(program, tmp_path):
    row = " 1992 175 6 23 0 {} 0.0 45.0 500 0 600 0 90 0 5 0 40 0 0.1 0.1 0.1 0.1\n"
    (tmp_path / "abq.dat").write_text(" Albuquerque\n 35.04 -106.62 1617 -7 version 1\n" +
                                      "".join(row.format(i) for i in range(60)))

    done = check(program, tmp_path, "abq.dat")

    assert done.returncode == 1
    assert "abq.dat: is a day of SOLRAD, which measures light alone: expected air temperature" in done.stderr


def test_a_day_of_surfrad_that_is_cut_is_refused_at_its_line(program, tmp_path):
    text = surfrad_text(23, 24)
    (tmp_path / "cut.dat").write_text(text[:-100])

    done = check(program, tmp_path, "cut.dat")

    assert done.returncode == 1 and f"cut.dat:{text.count(chr(10))}: " in done.stderr and "expected 48 numbers" in done.stderr


def test_a_name_of_another_ending_is_refused(program, tmp_path):
    (tmp_path / "june.txt").write_text("2 1\n")

    done = check(program, tmp_path, "june.txt")

    assert done.returncode == 1 and "expected one that ends with .wth, .csv, .epw or .dat" in done.stderr
    assert SITE["latitude_deg"] == PLACE[0] and np.isfinite(PLACE).all()
