"""radsig thermal --sensitivity, against closed forms and the thesis' Tables 3.1.1-1 and 3.1.2-1."""
import math
import pathlib

import pytest
import table_d1

HERE = pathlib.Path(__file__).resolve().parent

JUNE = HERE / "clear_june_1992.wth"
PLACE = ["--site", "43.083,-77.667", "--date", "1992-06-23", "--utc-offset", "-4"]
WIND_M_S, POWER_W_M2 = 5.0, 200.0


def study(program, folder, *options, weather=JUNE):
    done = program.run("thermal", "--sensitivity", "--materials", folder / "list.mat", "--weather",
                       weather, *PLACE, *options)
    return done


def rows_of(done):
    """Per input: rmse_c, sigma_c, thesis_rmse_c."""
    assert done.returncode == 0, done.stderr
    lines = [line for line in done.stdout.splitlines() if not line.startswith("#")]
    assert lines[0] == "input,error,unit,rmse_c,sigma_c,thesis_rmse_c,ratio"
    table = [line.split(",") for line in lines[1:]]
    return {name: tuple(map(float, values[:3])) for name, _, _, *values in table}


@pytest.fixture(scope="module")
def heated(program, tmp_path_factory):
    """A sheet that neither shines nor absorbs, in still weather: T = air + power / h."""
    folder = tmp_path_factory.mktemp("heated")
    (folder / "list.mat").write_text("1\nheater\n1\n.1\n464.4\n7.8\n0\n0\n0\n.5\nx.ems\nx.ext\n")
    record = f"20 1013 .5 -1 {WIND_M_S} 0 0 1 0 0 0 0"
    (folder / "still.wth").write_text(
        "49 1\n" + "".join(f"{hour} {record}\n" for hour in range(49)))
    return rows_of(study(program, folder, "--thickness-cm", "0.1", "--power-w-m2", POWER_W_M2,
                         "--runs", "400", weather=folder / "still.wth"))


# An offset evenly distributed between -d and d has mean size d / 2 and standard deviation d / sqrt 3;
# 400 runs, one from each part of the range, leave less than 1e-3 of that.
def test_the_air_moves_a_heated_sheet_by_as_much(heated):
    rmse, sigma, _ = heated["air temperature"]

    assert rmse == pytest.approx(0.1, rel=3e-3)
    assert sigma == pytest.approx(0.2 / math.sqrt(3), rel=3e-3)


def test_power_moves_a_heated_sheet_in_proportion(heated):
    rise = 0.1 * POWER_W_M2 / (9 + 1.2 * WIND_M_S)
    rmse, sigma, _ = heated["self-generated power"]

    assert rmse == pytest.approx(rise / 2, rel=3e-3)
    assert sigma == pytest.approx(rise / math.sqrt(3), rel=3e-3)


def test_wind_moves_a_heated_sheet_by_the_mean_over_its_error(heated):
    winds = [WIND_M_S + 1.111 * (2 * (i + 0.5) / 4000 - 1) for i in range(4000)]
    rises = [POWER_W_M2 / (9 + 1.2 * w) - POWER_W_M2 / (9 + 1.2 * WIND_M_S) for w in winds]
    rmse, sigma, _ = heated["wind speed"]

    assert rmse == pytest.approx(sum(map(abs, rises)) / 4000, rel=3e-3)
    assert sigma == pytest.approx(math.sqrt(sum(r * r for r in rises) / 4000), rel=3e-3)


@pytest.mark.parametrize("name", ["direct insolation", "diffuse insolation", "visible emissivity",
                                  "azimuth", "density", "thickness", "sky exposure"])
def test_what_does_not_reach_a_sheet_does_not_move_it(heated, name):
    assert heated[name][0] < 1e-4


def test_the_sums_are_roots_of_sums_of_squares(heated):
    of_weather = list(heated.values())[:8]
    for column in (0, 1, 2):
        sum_c = math.sqrt(sum(row[column] ** 2 for row in of_weather))
        assert heated["root sum of squares: weather"][column] == pytest.approx(sum_c, abs=2e-4)


def test_the_thesis_own_sums_follow_from_its_rows(heated):
    # Tables 3.1.1-1 and 3.1.2-1, their last rows
    assert heated["root sum of squares: weather"][2] == pytest.approx(0.3276, abs=1e-4)
    assert heated["root sum of squares: passive object"][2] == pytest.approx(0.5137, abs=1.1e-4)
    assert heated["root sum of squares: active object"][2] == pytest.approx(0.5142, abs=1e-4)


@pytest.fixture(scope="module")
def june(program, tmp_path_factory):
    """The materials of Table D-1 on the clear day."""
    folder = tmp_path_factory.mktemp("june")
    (folder / "list.mat").write_text(table_d1.material_file_text())
    watts = table_d1.LANGLEY_PER_HOUR_W_M2
    (folder / "objects.csv").write_text(
        "material,thickness_cm,slope_deg,azimuth_deg,power_w_m2\n" + "".join(
            f"{r.name},{r.thickness_cm},{r.slope_deg},{r.azimuth_deg},{r.power_ly_h * watts}\n"
            for r in table_d1.ROWS))
    return folder


def test_ten_or_more_inputs_are_within_a_factor_of_two_of_the_thesis(program, june):
    rows = rows_of(study(program, june, "--objects", june / "objects.csv", "--runs", "20"))
    of_inputs = list(rows.values())[:18]

    # expected of a clear day with the thesis' materials, not tuned: its cloudiness is not known
    assert sum(0.5 <= rmse / thesis <= 2 for rmse, _, thesis in of_inputs) >= 10


def test_the_same_seed_gives_the_same_bytes_and_another_one_others(program, june):
    texts = [study(program, june, "--objects", june / "objects.csv", "--runs", "2", "--seed",
                   seed).stdout for seed in (7, 7, 8)]

    assert texts[0].startswith("# 22 objects, 2 runs of each input, seed 7\n")
    assert texts[0] == texts[1]
    assert texts[0].split("\n")[1:] != texts[2].split("\n")[1:]


def test_without_objects_every_material_of_the_list_is_studied(program, june, tmp_path):
    done = study(program, june, "--thickness-cm", "2", "--runs", "1", "--plot",
                 tmp_path / "s.png")

    assert done.stdout.startswith("# 22 objects, 1 runs")
    assert (tmp_path / "s.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


@pytest.mark.parametrize("line, text", [
    ("Asphalt,2.4,0,0", "a material's name and four numbers"),
    ("Tar,2.4,0,0,0", "a material of the list, not 'Tar'"),
    ("Asphalt,0,0,0,0", "a thickness from 1e-4"),
    ("Asphalt,2.4,190,0,0", "a slope from 0 to 180"),
    ("Asphalt,2.4,0,400,0", "an azimuth from -360"),
    ("Asphalt,2.4,0,0,-1", "a power from 0"),
    ("", "objects behind the header"),
])
def test_a_broken_list_of_objects_is_refused_at_its_line(program, june, tmp_path, line, text):
    (tmp_path / "o.csv").write_text(
        f"material,thickness_cm,slope_deg,azimuth_deg,power_w_m2\n{line}\n")

    done = study(program, june, "--objects", tmp_path / "o.csv")

    assert done.returncode == 1 and done.stdout == ""
    assert "o.csv:" in done.stderr and text in done.stderr


def test_objects_are_separated_values_like_any_other(program, june, tmp_path):
    head = ["material", "thickness_cm", "slope_deg", "azimuth_deg", "power_w_m2"]
    row = ["Asphalt", "2.4", "0", "0", "0"]
    texts = []
    for head_text, row_text in ((",".join(head), ",".join(row)), ("; ".join(head), " ; ".join(row)),
                                ('","'.join(head).join('""'), '","'.join(row).join('""') + ",,")):
        (tmp_path / "o.csv").write_bytes(f"\ufeff{head_text}\r\n{row_text}\r\n".encode())
        texts.append(study(program, june, "--objects", tmp_path / "o.csv", "--runs", "2").stdout)

    assert texts[0].startswith("# 1 objects") and texts[1:] == texts[:1] * 2


def test_objects_without_their_header_are_refused(program, june, tmp_path):
    (tmp_path / "o.csv").write_text("Asphalt,2.4,0,0,0\n")

    done = study(program, june, "--objects", tmp_path / "o.csv")

    assert "o.csv:1: found 'Asphalt,2.4,0,0,0', expected the header" in done.stderr


@pytest.mark.parametrize("options, text", [
    (["--thickness-cm", "2", "--runs", "0"], "--runs: found '0'"),
    (["--thickness-cm", "2", "--seed", "1.5"], "--seed: found '1.5'"),
    ([], "needs --thickness-cm"),
    (["--objects", "x.csv", "--slope", "3"], "--objects and --slope exclude each other"),
])
def test_wrong_options_of_a_study_exit_2(program, june, options, text):
    done = study(program, june, *options)

    assert done.returncode == 2 and text in done.stderr


def test_options_of_a_study_need_it(program, june):
    done = program.run("thermal", "--materials", june / "list.mat", "--weather", JUNE, *PLACE,
                       "--material", "Asphalt", "--thickness-cm", "2", "--runs", "3")

    assert done.returncode == 2 and "--runs needs --sensitivity" in done.stderr
