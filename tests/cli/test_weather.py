"""radsig weather, and weather that does not belong to a scene."""
import pathlib

import numpy as np
import pytest

WEATHER = {"air_temperature_sunrise_c": 15.0, "air_temperature_peak_c": 29.0, "peak_time_h": 15.0,
           "relative_humidity_sunrise": 0.9, "wind_m_s": 2.0}
MATTER = {"name": "wall", "emissivity": 0.93, "density_kg_m3": 2114.0,
          "specific_heat_j_kg_k": 920.0, "conductivity_w_m_k": 0.689, "thickness_cm": 5.0,
          "exposed_area": -0.5}
SITE = {"latitude_deg": 43.083, "longitude_deg": -77.667, "time": "1992-06-23T15:00:00-04:00"}
JUNE = pathlib.Path(__file__).with_name("clear_june_1992.wth")


def scene(weather, **site):
    return {"site": {**SITE, **site}, "weather": weather, "material": [MATTER],
            "render": {"thermal": "therm"}}


def test_a_synthesis_is_written_and_read_back_as_the_same_temperature(program, tmp_path):
    direct = program.render(tmp_path, **scene(WEATHER)).planes["temperature_c"]
    done = program.run("weather", program.write_scene(tmp_path, **scene(WEATHER)), "-o",
                       tmp_path / "made.wth")

    assert done.returncode == 0, done.stderr
    again = program.render(tmp_path, **scene({"history": "made.wth"})).planes["temperature_c"]
    assert again == pytest.approx(direct, abs=0.02)  # three decimals of a degree, four of a ly/h


def test_the_first_line_tells_two_days_of_quarter_hours(program, tmp_path):
    program.run("weather", program.write_scene(tmp_path, **scene(WEATHER)), "-o",
                tmp_path / "made.wth")

    count, interval = (tmp_path / "made.wth").read_text().split()[:2]
    assert (int(count), float(interval)) == (193, 0.25)


def test_weather_of_its_own_date_and_place_is_no_cause_for_a_warning(program, tmp_path):
    done = program.run("check", program.write_scene(tmp_path, **scene({"history": str(JUNE)})))

    assert done.returncode == 0 and "sunlight" not in done.stderr


@pytest.mark.parametrize("change", [{"time": "1992-12-23T15:00:00-05:00"},
                                    {"longitude_deg": 100.0}])
def test_weather_of_another_date_or_place_is_warned_about_by_name(program, tmp_path, change):
    done = program.run("check",
                       program.write_scene(tmp_path, **scene({"history": str(JUNE)}, **change)))

    assert "clear_june_1992.wth: has sunlight in" in done.stderr


def test_a_scene_without_weather_has_none_to_write(program, tmp_path):
    done = program.run("weather", program.write_scene(tmp_path), "-o", tmp_path / "made.wth")

    assert done.returncode == 1 and "has no [weather]" in done.stderr
    assert not (tmp_path / "made.wth").exists()


def test_without_a_file_to_write_the_usage_is_wrong(program, tmp_path):
    assert program.run("weather", program.write_scene(tmp_path)).returncode == 2


def test_a_scene_takes_measured_weather_from_a_table(program, tmp_path):
    columns = {"time [h]": np.arange(96) / 2, "air_temperature [C]": 20.0, "pressure [hPa]": 1013.0,
               "relative_humidity [%]": 50.0, "wind [m/s]": 2.0, "direct [W/m2]": 0.0,
               "diffuse [W/m2]": 0.0, "longwave_down [W/m2]": 5.670374419e-8 * 293.15**4}
    table = np.array([np.broadcast_to(c, 96) for c in columns.values()]).T
    np.savetxt(tmp_path / "day.csv", table, "%.6g", ",", header=",".join(columns), comments="")

    planes = program.render(tmp_path, **scene({"history": "day.csv"})).planes

    assert planes["temperature_c"] == pytest.approx(20.0, abs=0.01)


@pytest.mark.parametrize("law", [{"sky_longwave": "berdahl-martin"}, {"sky_longwave": "brutsaert"},
                                 {"convection": "mcadams"}, {"convection": "tarp"},
                                 {"convection": "similarity", "roughness_length_m": 0.0005,
                                  "wind_height_m": 3.0}, {"diffuse": "hay-davies"}])
def test_laws_of_sky_and_air_are_chosen_in_the_scene(program, tmp_path, law):
    usual, other = (program.render(tmp_path, **scene({**WEATHER, **chosen})).planes["temperature_c"]
                    for chosen in ({}, law))

    assert (other != usual).any()
    # level ground gets the same light whatever its direction, skies differ by a few per cent, and
    # 5.7 + 3.8 V is 13.3 W m-2 K-1 at 2 m/s where 9 + 1.2 V is 11.4
    assert abs(other - usual).max() < {"diffuse": 0.01, "convection": 12}.get(next(iter(law)), 1.5)


def test_the_stated_defaults_are_the_defaults(program, tmp_path):
    stated = {"sky_longwave": "brunt", "convection": "therm", "diffuse": "isotropic"}
    one, other = (program.render(tmp_path, **scene({**WEATHER, **laws})).planes["temperature_c"]
                  for laws in ({}, stated))

    assert (one == other).all()


@pytest.mark.parametrize("law, text", [
    ({"sky_longwave": "swinbank"}, 'sky_longwave: found "swinbank", expected'),
    ({"convection": "dittus"}, 'convection: found "dittus", expected'),
    ({"roughness_length_m": 2.0}, "roughness_length_m: found 2, expected"),
    ({"wind_height_m": 0.5}, "wind_height_m: found 0.5, expected"),
    ({"diffuse": "perez"}, 'diffuse: found "perez", expected'),
])
def test_a_law_that_is_not_known_is_refused_at_its_line(program, tmp_path, law, text):
    done = program.run("check", program.write_scene(tmp_path, **scene({**WEATHER, **law})))

    assert done.returncode == 1 and text in done.stderr and "scene.toml:" in done.stderr
