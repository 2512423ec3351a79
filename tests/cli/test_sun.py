import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RADSIG = ROOT / os.environ.get("RADSIG", "build/radsig")


def sun(*arguments):
    return subprocess.run([RADSIG, "sun", *arguments], capture_output=True, text=True, timeout=60)


def rows(*arguments):
    done = sun(*arguments)
    assert done.returncode == 0, done.stderr
    heading, *lines = done.stdout.splitlines()
    assert heading == "time,zenith_deg,azimuth_deg,distance_au"
    return [line.split(",") for line in lines]


def test_the_worked_example_of_spa():
    (row,) = rows("--site", "39.742476,-105.1786", "--time", "2003-10-17T12:30:30-07:00")

    assert row[0] == "2003-10-17T12:30:30-07:00"
    # NREL/TP-560-34302, Table A5.1: elevation 39.872046 before refraction; PSA is good to .01
    assert float(row[1]) == pytest.approx(90 - 39.872046, abs=0.01)
    assert float(row[2]) == pytest.approx(194.340241, abs=0.01)
    assert float(row[3]) == pytest.approx(0.9965423, abs=1e-4)


def test_a_time_at_another_offset_is_the_same_sun():
    site = ("--site", "39.742476,-105.1786")

    assert (rows(*site, "--time", "2003-10-17T12:30:30-07:00")[0][1:]
            == rows(*site, "--time", "2003-10-17T19:30:30Z")[0][1:])


def test_steps_reach_the_last_time():
    table = rows("--site", "-33.9,18.4", "--time", "2003-12-21T06:00:00+02:00",
                 "--until", "2003-12-21T07:00:00+02:00", "--step-min", "20")

    assert [row[0][11:16] for row in table] == ["06:00", "06:20", "06:40", "07:00"]
    assert [float(row[1]) for row in table] == sorted((float(r[1]) for r in table), reverse=True)


@pytest.mark.parametrize("arguments, text", [
    (["--site", "40,-80"], "needs --time ISO"),
    (["--site", "40", "--time", "2003-10-17T12:00:00Z"], "LAT,LON"),
    (["--site", "91,0", "--time", "2003-10-17T12:00:00Z"], "'91,0'"),
    (["--site", "40,-80", "--time", "2003-10-17T12:00:00"], "2003-10-17T12:00:00"),
    (["--site", "40,-80", "--time", "2003-10-17T12:00:00Z", "--step-min", "5"], "go together"),
    (["--site", "40,-80", "--time", "2003-10-17T12:00:00Z", "--until", "2003-10-18T12:00:00Z",
      "--step-min", "0"], "--step-min: found '0'"),
    (["--site", "40,-80", "--time", "2003-10-17T12:00:00Z", "--until", "2003-10-16T12:00:00Z",
      "--step-min", "5"], "before"),
    (["--no-such-option"], "unknown option '--no-such-option'"),
    (["--site"], "--site needs a value"),
    (["extra"], "'extra'"),
])
def test_wrong_usage_exits_2_and_says_why(arguments, text):
    done = sun(*arguments)

    assert done.returncode == 2 and done.stdout == ""
    assert text in done.stderr


def test_help_goes_to_stdout():
    assert sun("--help").stdout.startswith("usage: radsig sun")
