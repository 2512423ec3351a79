"""Soundings: the layouts in which people have them, their gaps, and several in a file."""

import math

import pytest

SCENE = """name = "s"
[site]
latitude_deg = 35.2
longitude_deg = -97.4
time = {time}
[atmosphere.generate]
model = "midlatitude-summer"
radiosonde = "{file}"
ground_altitude_m = 350
sensor_altitude_m = 5000
wavenumber_cm1 = [800, 1000]
wavenumber_step_cm1 = 100
sample_step_cm1 = 100
sky_step_deg = {{ zenith = 45, azimuth = 180 }}
path_zenith_deg = [0, 0, 1]
"""
SCENE = SCENE.replace("[atmosphere.generate]", '[camera]\nposition_m = [0, 0, 5000]\ntarget_m = [0, 0, 0]\nfocal_length_mm = 50\npixels = [8, 8]\n[atmosphere.generate]')

# hPa, m, C, C
LEVELS = [(960.0, 350, 20.0, 12.0), (900.0, 920, 17.0, 9.0), (850.0, 1450, 14.0, 6.0), (700.0, 3050, 4.0, -6.0),
          (500.0, 5700, -15.0, -30.0), (300.0, 9350, -43.0, -55.0)]


@pytest.fixture
def levels_of(atmosphere, tmp_path):
    """The levels that LOWTRAN gets of a sounding: hPa, m, C, C (None: the model's water); and what was said."""
    def run(text, time="2011-05-22T12:00:00Z", code=0, file="sounding"):
        (tmp_path / file).write_bytes(text if isinstance(text, bytes) else text.encode())
        (tmp_path / "scene.toml").write_text(SCENE.format(time=time, file=file))
        decks = tmp_path / "decks"
        done = atmosphere("make", tmp_path / "scene.toml", "-o", tmp_path / "o.rad", "--keep-decks", decks, code=code)
        if code:
            return done.stderr
        rows = [row for row in (decks / "sun.cdk").read_text().split("\n") if row[60:62] == "AA"]
        return [(float(row[10:20]), 1e3 * float(row[:10]), float(row[20:30]) - 273.15, float(row[30:40]) if row[62] == "G" else None)
                for row in rows], done.stderr
    return run


def same(found, expected=LEVELS):
    assert [level[3] is None for level in found] == [level[3] is None for level in expected]
    assert [value for level in found for value in level[:3]] == pytest.approx([value for level in expected for value in level[:3]], abs=0.6)
    assert [level[3] or 0.0 for level in found] == pytest.approx([level[3] or 0.0 for level in expected], abs=0.06)


def pages(title="72357 OUN Norman Observations at 12Z 22 May 2011", levels=LEVELS, foot=""):
    rule = 77 * "-"
    return "\n".join([title, "", rule, "   PRES   HGHT   TEMP   DWPT   RELH   MIXR   DRCT   SKNT   THTA   THTE   THTV",
                      "    hPa     m      C      C      %    g/kg    deg   knot     K      K      K ", rule, " 1000.0     15",
                      *("".join(7 * " " if v is None else f"{v:7.1f}" for v in level) + "     60   5.00    200     10  300.0  310.0  301.0" for level in levels),
                      "</PRE><H3>Station information and sounding indices</H3>", foot, ""])


def csv(head="pressure_hpa,altitude_m,temperature_c,dew_point_c", levels=LEVELS, separator=","):
    return "\n".join([head, *(separator.join("" if v is None else str(v) for v in level) for level in levels)]) + "\n"


def archive_csv(levels=LEVELS, time="2011-05-22 11:30:00"):
    head = ("time,longitude,latitude,pressure_hPa,geopotential height_m,temperature_C,dew point temperature_C,ice point temperature_C,"
            "relative humidity_%,humidity wrt ice_%,mixing ratio_g/kg,wind direction_degree,wind speed_m/s")
    return "\n".join([head, *(f"{time},-97.4000,35.2000,{p:6.1f},{z:5},{t:5.1f},{d:5.1f},{d:5.1f}, 60, 60, 5.00,200, 9.3" for p, z, t, d in levels)]) + "\n"


def igra(levels=LEVELS, hour="12", day="22", station="USM00072357", place=" 352000  -974000", heights=True):
    rows = [f"21 -9999 {round(100 * p):6d} {z if heights or i == 0 else -9999:5d} {round(10 * t):5d}B-9999 {-9999 if d is None else round(10 * (t - d)):5d} -9999 -9999"
            for i, (p, z, t, d) in enumerate(levels)]
    return "\n".join([f"#{station} 2011 05 {day} {hour} 1130 {len(rows):4d} ncdc-gts ncdc-gts {place}", *rows]) + "\n"


@pytest.mark.parametrize("text", [
    pages(),
    pages(title="<H2>72357 OUN Norman, OK Observations at 12Z 22 May 2011</H2>\n<PRE>", foot='<script>f("a", "b"); g("c,d");</script>'),
    pages().replace("\n", "\r\n"),
    csv(),
    csv("Pressure (hPa), Altitude [m], Temperature (°C), Dew Point [°C]"),
    csv("Pressure (hPa);Altitude [m];Temperature (\xb0C);Dew Point [\xb0C]", separator=";").encode("latin-1"),
    csv('"pressure_mb","height_m","temp_C","dewpoint_C"'),
    csv("dew_point_k,temperature_k,altitude_km,pressure_pa", [(d + 273.15, t + 273.15, z / 1e3, 100 * p) for p, z, t, d in LEVELS]),
    csv("pressure_hpa;altitude_m;temperature_c;dew_point_c", separator=";").replace(".", ","),
    "\ufeff" + csv(),
    csv(";pressure_hpa;altitude_m;temperature_c;dew_point_c;", [("", *map(str, level), "") for level in LEVELS], ";"),
    csv("Pressure mbar\tAltitude (ft)\tTemperature deg F\tDew Point °F", [(p, z / .3048, 1.8 * t + 32, 1.8 * d + 32) for p, z, t, d in LEVELS], "\t"),
    csv("pressure_hpa,altitude_m,temperature_c,dew_point_c,wind_kt", [(*level, "") for level in LEVELS]),
    csv("pressure_mb,height_m,tmpc,dwpc"),
    csv("P,HeightMSL,Temp,Dewp\nhPa,m,°C,°C").replace("HeightMSL", "Height"),
    archive_csv(),
    igra(),
])
def test_every_layout_gives_the_same_levels(levels_of, text):
    found, said = levels_of(text)

    same(found)
    assert said == ""


def test_relative_humidity_gives_the_dew_point(levels_of):
    es = lambda c: math.exp(17.625 * c / (243.04 + c))  # Alduchov and Eskridge (1996)
    found, _ = levels_of(csv("pressure_hpa,altitude_m,temperature_c,relative humidity_%",
                             [(p, z, t, 100 * es(d) / es(t)) for p, z, t, d in LEVELS]))

    assert [level[3] for level in found] == pytest.approx([level[3] for level in LEVELS], abs=0.3)


@pytest.mark.parametrize("flag", ["-999", "-9999", "-9999.0", "-999.9", "-99.9", "-99", "999.9", "9999", "99999", "-8888", "-32768", "1e20", "", "NaN", "--", "null", "//", "***"])
def test_a_value_that_is_missing_lies_between_its_neighbours(levels_of, flag):
    # 1.4 km between two levels, so that the dew point may be bridged
    levels = [(960.0, 350, 20.0, 12.0), (900.0, 920, 17.0, flag), (850.0, 1450, 14.0, 6.0), (500.0, 5700, -15.0, -30.0)]
    found, said = levels_of(csv(levels=levels))

    same(found, [*levels[:1], (900.0, 920, 17.0, 12.0 - 6.0 * 570 / 1100), *levels[2:]])
    assert ("1 numbers such as -999 stand for missing values" in said) == (flag[-1:].isdigit())


def test_a_dew_point_that_is_missing_over_more_is_the_model_s(levels_of):
    found, _ = levels_of(csv(levels=[*LEVELS[:4], (*LEVELS[4][:3], "-999"), LEVELS[5]]))

    same(found, [*LEVELS[:4], (*LEVELS[4][:3], None), LEVELS[5]])


@pytest.mark.parametrize("column", [0, 2])
def test_a_level_without_pressure_or_temperature_is_passed_over(levels_of, column):
    level = list(LEVELS[2])
    level[column] = "-9999"
    found, _ = levels_of(csv(levels=[*LEVELS[:2], tuple(level), *LEVELS[3:]]))

    same(found, [*LEVELS[:2], *LEVELS[3:]])


@pytest.mark.parametrize("text", [
    csv(levels=[*LEVELS[:2], (850.0, None, 14.0, 6.0), *LEVELS[3:]]),
    igra(levels=[*LEVELS[:2], (850.0, -9999, 14.0, 6.0), *LEVELS[3:]]),
])
def test_a_missing_height_follows_from_the_others(levels_of, text):
    found, said = levels_of(text)
    low, high = 17.0 + 273.15, 4.0 + 273.15
    lower = (low + 287.15) / 2 * math.log(900 / 850)  # hypsometric equation
    upper = (287.15 + high) / 2 * math.log(850 / 700)

    same(found, [*LEVELS[:2], (850.0, 920 + 2130 * lower / (lower + upper), 14.0, 6.0), *LEVELS[3:]])
    assert "1 heights are missing" in said


def test_heights_that_only_the_ground_has_follow_from_the_air(levels_of):
    found, said = levels_of(igra(heights=False))
    dry = 350 + sum(287.05 / 9.80665 * ((a[2] + b[2]) / 2 + 273.15) * math.log(a[0] / b[0]) for a, b in zip(LEVELS[:4], LEVELS[1:5]))

    assert found[4][1] == pytest.approx(dry, abs=1)  # 30 m below the humid air of LEVELS
    assert "5 heights are missing" in said


def test_levels_that_repeat_or_fall_a_little_are_passed_over(levels_of):
    found, said = levels_of(csv(levels=[LEVELS[0], LEVELS[0], LEVELS[1], (901.0, 912, 17.1, 9.0), *LEVELS[2:]]))

    same(found)
    assert "2 levels repeat one or fall a little below it" in said


@pytest.mark.parametrize("join", [
    lambda *days: "".join(pages(f"72357 OUN Norman Observations at {hour}Z {day} May 2011", levels) for hour, day, levels in days),
    lambda *days: "".join(igra(levels, hour, day) for hour, day, levels in days),
    lambda *days: "".join(archive_csv(levels, f"2011-05-{day} {hour}:00:00") for hour, day, levels in days),
    lambda *days: "\n".join([archive_csv().split("\n")[0], *(row for hour, day, levels in days for row in archive_csv(levels, f"2011-05-{day} {hour}:00:00").split("\n")[1:] if row)]) + "\n",
])
def test_of_several_soundings_the_nearest_hour_s_is_taken(levels_of, join):
    warmer = [(p, z, t + 5.0, d) for p, z, t, d in LEVELS]
    text = join(("00", "22", warmer), ("12", "22", LEVELS), ("00", "23", warmer))
    found, said = levels_of(text, time="2011-05-22T10:00:00-05:00")  # 15 Z

    same(found)
    assert "of 3 soundings" in said and "2011-05-22T12:00:00" in said
    same(levels_of(text, time="2011-05-22T22:00:00Z")[0], warmer)
    refused = levels_of(text, time="2012-05-22T12:00:00Z", code=1)
    assert "holds 3 soundings, expected one, or one within 6 h of the scene's time" in refused
    assert all(f"2011-05-{day}:00:00" in refused for day in ("22T00", "22T12", "23T00"))


@pytest.mark.parametrize("text, time, expected", [
    (pages(), "2011-05-23T12:00:00Z", "72357 2011-05-22T12:00:00Z (line 4) is 24 h from the scene's time"),
    (archive_csv(time="1999-05-04 00:00:00"), "2011-05-22T12:00:00Z", "h from the scene's time"),
    (igra(place=" 712889 -1567833"), "2011-05-22T12:00:00Z", "km from the scene's place"),
    (igra(), "2011-05-22T23:00:00Z", ""),
])
def test_a_sounding_of_another_day_or_country_is_told(levels_of, text, time, expected):
    assert levels_of(text, time=time)[1].count("\n") == bool(expected)
    assert expected in levels_of(text, time=time)[1]


def test_of_several_stations_the_nearest_is_taken(levels_of):
    warmer = [(p, z, t + 5.0, d) for p, z, t, d in LEVELS]

    same(levels_of(igra(warmer, station="USM00072456", place=" 390700  -956300") + igra())[0])
    # in a page without places nothing tells which
    assert "holds 2 soundings" in levels_of(pages() + pages("72456 TOP Topeka Observations at 12Z 22 May 2011"), code=1)
    assert "holds 2 soundings" in levels_of(pages() + pages(), code=1)


@pytest.mark.parametrize("text, expected", [
    (csv(levels=[*LEVELS[:2], (850.0, 1450, 14.0, -150), *LEVELS[3:]]), "sounding:4: found '850.0,1450,14.0,-150', expected a dew point from -123 C"),
    (csv(levels=[*LEVELS[:2], (850.0, 1450, "warm", 6.0), *LEVELS[3:]]), "sounding:4"),
    (csv(levels=[*LEVELS[:2], (850.0, 1450), *LEVELS[3:]]), "4 fields, one for each name, not 2"),
    (csv("pressure_hpa,altitude_m,temperature_c,relative humidity_%", [(p, z, t, .5) for p, z, t, _ in LEVELS]),
     "sounding: its relative humidity is at most 0.5 %: expected per cent, not fractions"),
    (csv(levels=[(p, z / .3048, t, d) for p, z, t, d in LEVELS]), "sounding: its heights rise by 2.953e+04 m, which is 3.31 times what pressure and temperature give"),
    (pages().replace("920.0   17.0", "920.0\t17.0"), "expected columns of seven characters, without tabs"),
    (csv(levels=[("960,0", 350, "20,0", "12,0"), *LEVELS[1:]]), "4 fields, one for each name, not 7"),
    (csv("pressure_hpa,altitude_m,temperature,dew_point_c"), "columns with units"),
    (csv("P,Height,Temp,Dewp\nhPa,m,°R,°R"), "columns with units"),
    (csv("pressure_hpa,altitude_m,temperature_hpa,dew_point_c"), "columns with units"),
    (csv(levels=[(p, "-9999", t, d) for p, _, t, d in LEVELS]), "no level has a height"),
    (csv(levels=LEVELS[::-1]), "sounding:3"),
    (igra().replace("  -150", "  -15x"), "a level in the columns of IGRA 2"),
    (igra()[:300], "a level"),
    (igra().replace("\n21 -", "\n   -"), "a level in the columns of IGRA 2"),
    ("", "the file ends"),
    ("Unable to retrieve the data for ABC.\n", "sounding:1: found 'Unable to retrieve the data for ABC.', expected the head PRES HGHT TEMP DWPT"),
])
def test_a_sounding_that_cannot_be_told_is_refused_with_the_reason(levels_of, text, expected):
    assert expected in levels_of(text, code=1)
