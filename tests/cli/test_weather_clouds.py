"""Clouds of a synthesised history against Shapiro's three layers (AFGL-TR-82-0039), solved here as the
report states them: a system of equations for what goes up and down between the layers."""
import numpy as np
import pytest

WEATHER = {"air_temperature_sunrise_c": 15.0, "air_temperature_peak_c": 29.0, "peak_time_h": 15.0,
           "relative_humidity_sunrise": 0.9, "wind_m_s": 2.0}
SITE = {"latitude_deg": 43.083, "longitude_deg": -77.667, "time": "1992-06-23T15:00:00-04:00"}
MATTER = {"name": "wall", "emissivity": 0.93, "density_kg_m3": 2114.0,
          "specific_heat_j_kg_k": 920.0, "conductivity_w_m_k": 0.689, "thickness_cm": 5.0,
          "exposed_area": -0.5}
LANGLEY_PER_HOUR_W_M2 = 41840 / 3600

# Cubics in the cosine of the zenith angle (reflected, let through), as FASST and AGRMET carry them.
CLEAR = [((.12395, -.34765, .39478, -.14627), (.76977, .49407, -.44647, .11558)),
         ((.15325, -.39620, .42095, -.14200), (.69318, .68227, -.64289, .17910)),
         ((.15946, -.42185, .48800, -.18492), (.68679, .71012, -.71463, .22339))]
CLOUD = {"thin": ((.25674, -.18077, -.21961, .25272), (.63547, .35229, .08709, -.22902)),
         "thick": ((.60540, -.55142, -.23389, .43648), (.26458, .66829, .24228, -.49357)),
         "middle": ((.66152, -.14863, -.08193, .13442), (.19085, .32817, -.08613, -.08197)),
         "low": ((.71214, -.15033, .00696, .03904), (.13610, .29964, -.14041, .00952))}
WEIGHT = {"thin": (.675, -3.432, 1.929, .842, 2.693, -1.354),
          "thick": (1.552, -1.957, -1.762, 2.067, .448, .932),
          "middle": (1.429, -1.207, -2.008, .853, .324, 1.582),
          "low": (.858, -1.075, -.536, .750, .322, .501)}
LAYERS = {1: {0: "thin"}, 2: {0: "thick"}, 3: {1: "middle"}, 4: {1: "middle"}, 5: {2: "low"},
          6: {2: "low"}, 7: {1: "middle", 2: "low"}, 8: {2: "low"}}  # fog: stratus on the ground


def layers(kind, cover, m):
    """Rows of (reflected, let through), the highest first."""
    value = lambda pair: np.array([np.polyval(c[::-1], m) for c in pair])
    rows = [value(pair) for pair in CLEAR]
    for i, name in LAYERS.get(kind, {}).items():
        terms = np.array([1, m, cover, cover * m, m * m, cover * cover])
        share = 1.0 if cover == 1 else np.clip(cover * (terms @ WEIGHT[name]), 0, 1)
        rows[i] = rows[i] + share * (value(CLOUD[name]) - rows[i])
    return rows


def beam_and_level(rows, albedo=0.2):
    """Unknowns: down and up below each layer; above the first only what comes down is known, 1."""
    a, b = np.eye(6), np.zeros(6)
    for k, (reflected, passed) in enumerate(rows):
        down, up = 2 * k, 2 * k + 1
        a[down, up] -= reflected
        if k == 0:
            b[down] = passed
        else:
            a[down, down - 2] -= passed
        if k < 2:
            next_reflected, next_passed = rows[k + 1]
            a[up, down] -= next_reflected
            a[up, up + 2] -= next_passed
        else:
            a[up, down] -= albedo
    level = np.linalg.solve(a, b)[4]
    return np.prod([max(0, passed - reflected) for reflected, passed in rows]), level


def history(program, folder, **changes):
    path = program.write_scene(folder, site=SITE, weather={**WEATHER, **changes}, material=[MATTER],
                               render={"thermal": "therm"})
    done = program.run("weather", path, "-o", folder / "made.wth")
    assert done.returncode == 0, done.stderr
    return np.loadtxt(folder / "made.wth", skiprows=1)


@pytest.fixture(scope="module")
def clear_sky(program, tmp_path_factory):
    return history(program, tmp_path_factory.mktemp("clear"))


def cos_zenith(program, clock):
    done = program.run("sun", "--site", "43.083,-77.667", "--time", f"1992-06-23T{clock}:00-04:00")
    return np.cos(np.radians(float(done.stdout.splitlines()[1].split(",")[1])))


@pytest.mark.parametrize("kind, cover, clock, row", [
    (1, 1.0, "13:00", 148), (1, 0.4, "09:00", 132), (2, 0.7, "13:00", 148), (3, 0.5, "16:00", 160),
    (4, 1.0, "13:00", 148), (5, 0.8, "13:00", 148), (6, 1.0, "09:00", 132), (7, 1.0, "13:00", 148),
    (8, 1.0, "09:00", 132), (8, 0.3, "13:00", 148)])
def test_clouds_leave_the_share_of_shapiro_s_layers(program, tmp_path, clear_sky, kind, cover,
                                                    clock, row):
    cloudy = history(program, tmp_path, cloud_type=kind, sky_exposure=1 - cover)
    m = cos_zenith(program, clock)
    clear_beam, clear_level = beam_and_level(layers(0, 0, m))
    beam, level = beam_and_level(layers(kind, cover, m))
    before = clear_sky[row, 6:8] * LANGLEY_PER_HOUR_W_M2
    direct, diffuse = cloudy[row, 6:8] * LANGLEY_PER_HOUR_W_M2

    # four decimals of a ly/h in the file, 1e-3 W/m2
    assert direct == pytest.approx(before[0] * beam / clear_beam, abs=2e-3)
    assert direct * m + diffuse == pytest.approx(
        (before[0] * m + before[1]) * level / clear_level, abs=4e-3)


def test_an_overcast_of_stratus_leaves_less_than_one_of_cirrus(program, tmp_path, clear_sky):
    noon = [history(program, tmp_path, cloud_type=kind, sky_exposure=0.0)[148] for kind in (1, 4, 7)]

    assert noon[0][6] > 0.6 * clear_sky[148, 6]
    assert noon[1][6] == 0 and noon[2][6] == 0
    assert noon[0][6] * 0.94 + noon[0][7] > noon[1][7] > noon[2][7] > 0


def test_fog_hides_the_sun_and_leaves_a_fifth_to_a_half_of_the_light(program, tmp_path, clear_sky):
    """0.2 to 0.5 of the light on level ground, at most 0.05 of the beam: what fog is taken to leave."""
    fog = history(program, tmp_path, cloud_type=8, sky_exposure=0.0)
    hours = range(7, 20, 2)
    rows = [4 * (24 + hour) for hour in hours]
    upright = np.array([cos_zenith(program, f"{hour:02}:00") for hour in hours])
    level = lambda day: day[rows, 6] * upright + day[rows, 7]

    assert (fog[rows, 6] <= 0.05 * clear_sky[rows, 6]).all()
    assert (level(fog) >= 0.2 * level(clear_sky)).all()
    assert (level(fog) <= 0.5 * level(clear_sky)).all()


@pytest.mark.parametrize("mode, warns", [("exact", True), ("thesis", False)])
def test_clouds_without_a_type_are_told_to_be_altostratus(program, tmp_path, mode, warns):
    path = program.write_scene(tmp_path, site=SITE, weather={**WEATHER, "sky_exposure": 0.4},
                               material=[MATTER], render={"thermal": "therm", "mode": mode})

    done = program.run("check", path)

    assert done.returncode == 0, done.stderr
    assert ("longwave is that of altostratus (cloud type 4)" in done.stderr) == warns


def test_a_roof_under_clouds_without_a_type_is_warmer_at_night(program, tmp_path):
    night = {**SITE, "time": "1992-06-23T03:00:00-04:00"}
    clear, covered = (
        program.render(tmp_path, site=night, weather={**WEATHER, "sky_exposure": e, "relative_humidity_sunrise": 0.5},
                       material=[{**MATTER, "exposed_area": 0.5, "thickness_cm": 0.1}],
                       render={"thermal": "therm"}).planes["temperature_c"] for e in (1.0, 0.0))

    # a fifth more of 310 W/m2 over some 16 W m-2 K-1 of air and longwave
    assert (covered - clear).min() > 2.5


def test_the_stated_numbers_of_a_day_are_written(program, tmp_path):
    rows = history(program, tmp_path, sunrise_h=7.0, sunset_h=19.5, high_noon_transmission=0.6,
                   rain_mm_h=2.5, rain_temperature_c=12.0)

    assert rows[123, 6] == 0 and rows[124, 6] > 0  # 6:45 and 7:00 of the second day
    assert rows[149, 6] * LANGLEY_PER_HOUR_W_M2 == pytest.approx(0.6 * 1367 / 1.0163**2, abs=1)
    assert (rows[:, 10] == 1).all() and rows[:, 11] == pytest.approx(0.25)  # cm/h
    assert (rows[:, 12] == 12.0).all()


def test_a_sunrise_before_the_sun_s_is_warned_about(program, tmp_path):
    path = program.write_scene(tmp_path, site=SITE, weather={**WEATHER, "sunrise_h": 4.0},
                               material=[MATTER], render={"thermal": "therm"})

    done = program.run("check", path)

    assert done.returncode == 0
    assert "the stated sunrise, 4 h, comes before the site's of that day, 5.6" in done.stderr


def test_an_edited_history_drives_the_scene(program, tmp_path):
    rows = history(program, tmp_path)
    rows[132:, 6] *= 0.5  # from 9:00 of the day on half the beam, as a person's script would
    with open(tmp_path / "edited.wth", "w") as out:
        out.write("193 0.25\n")
        np.savetxt(out, rows, "%.4f %.3f %.2f %.4f %.3f %.3f %.4f %.4f %.3f %d %d %.5f %.3f")

    warm, cool = (program.render(tmp_path, site=SITE, weather={"history": name}, material=[MATTER],
                                 render={"thermal": "therm"}).planes["temperature_c"]
                  for name in ("made.wth", "edited.wth"))

    assert (cool < warm - 3).all()
