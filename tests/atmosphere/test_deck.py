"""radsig-atmosphere deck: LOWTRAN 7 as a deck stands."""

import itertools

import lowtran_by_hand
import numpy
import printed
import pytest
import radiance_database

# A path down from 4 km through maritime haze on a winter afternoon; printed nowhere.
UNPRINTED = """    3    2    2    1    0    0    0    0    0    0    0    0    1  -1.000   0.25
    4    0    0    1    0    0    12.000     0.000     0.000     0.000     0.200
     4.000     0.200   130.000     0.000     0.000     0.000    0
    2    2   20    0
    55.000    62.000     0.000     0.000     0.000     0.000     0.000     0.000
  2000.000  2600.000    20.000
    0
"""


def run_deck(atmosphere, folder, *decks):
    paths = []
    for i, text in enumerate(decks):
        paths.append(folder / f"{i}.cdk")
        paths[-1].write_text(text)
    atmosphere("deck", *paths, "-o", folder / "out.runs")
    return radiance_database.read(folder / "out.runs")


@pytest.mark.parametrize("direction", printed.SKY)
def test_the_printed_deck_gives_the_printed_directional_sky(atmosphere, tmp_path, direction):
    result = run_deck(atmosphere, tmp_path, printed.deck(*direction))

    # 1e-5: seven digits are printed, float32 sums differ in the sixth
    assert result["sky"][direction] == pytest.approx(numpy.array(printed.SKY[direction]), rel=1e-5)


def test_the_printed_decks_of_all_directions_give_the_printed_integrated_sky(atmosphere, tmp_path):
    directions = itertools.product(range(0, 91, 15), range(0, 361, 30))
    result = run_deck(atmosphere, tmp_path, *(printed.deck(z, a) for z, a in directions))

    assert len(result["sky"]) == 91
    assert result["integrated"][-2:] == pytest.approx(numpy.array(printed.INTEGRATED), rel=1e-5)


def test_a_deck_agrees_with_a_run_of_lowtran_by_hand(atmosphere, tmp_path):
    result = run_deck(atmosphere, tmp_path, UNPRINTED)
    by_hand = lowtran_by_hand.run(UNPRINTED, tmp_path / "by_hand")

    assert result["wavenumber"] == pytest.approx(by_hand[:, 0])
    assert result["path"][0] == pytest.approx(by_hand[:, 1:], rel=1e-6)  # seven digits are written
    assert result["range"][0] == pytest.approx(3.8 / numpy.cos(numpy.radians(50)), rel=1e-2)  # flat earth


def test_a_deck_spaced_freely_and_one_in_columns_are_the_same(atmosphere, tmp_path):
    first = run_deck(atmosphere, tmp_path, UNPRINTED)
    second = run_deck(atmosphere, tmp_path, "\n".join(" ".join(line.split()) for line in UNPRINTED.splitlines()))

    assert (first["path"] == second["path"]).all()


@pytest.mark.parametrize("old, new, expected", [
    ("  -1.000   0.25", "  -1.000   1.25", "0.cdk:1:"),
    ("    2    2   20    0", "    2    2  banana", "0.cdk:4:"),
    ("  2600.000", "  1600.000", "V1 below V2"),
    ("    0\n", "    1\n", "0.cdk:8: the file ends, expected card 1"),
    ("130.000", " 80.000", "LOWTRAN"),  # looks up, away from H2 below
])
def test_a_broken_deck_is_explained(atmosphere, tmp_path, old, new, expected):
    path = tmp_path / "0.cdk"
    path.write_text(new.join(UNPRINTED.rsplit(old, 1)))
    done = atmosphere("deck", path, "-o", tmp_path / "out.rad", code=1)

    assert expected in done.stderr
    assert not (tmp_path / "out.rad").exists()


def test_a_decimal_comma_in_a_profile_is_refused(atmosphere, tmp_path):
    (tmp_path / "sounding.csv").write_text("pressure_hpa,altitude_m,temperature_c\n1000,100,20\n800,2000,10\n500,5700,-15\n")
    (tmp_path / "scene.toml").write_text("""name = "s"
[site]
latitude_deg = 40
longitude_deg = -80
time = 1992-06-21T12:00:00Z
[atmosphere.generate]
model = "midlatitude-summer"
radiosonde = "sounding.csv"
ground_altitude_m = 100
sensor_altitude_m = 5000
wavenumber_cm1 = [800, 1000]
wavenumber_step_cm1 = 100
sample_step_cm1 = 100
sky_step_deg = { zenith = 45, azimuth = 180 }
path_zenith_deg = [0, 0, 1]
""")
    atmosphere("make", tmp_path / "scene.toml", "-o", tmp_path / "o.rad", "--keep-decks", tmp_path / "decks")
    deck = (tmp_path / "decks/sun.cdk").read_text()
    (tmp_path / "comma.cdk").write_text(deck.replace("   800.000", "   800,000", 1))
    done = atmosphere("deck", tmp_path / "comma.cdk", "-o", tmp_path / "out.txt", code=1)

    assert "comma.cdk:5: found" in done.stderr and "cards 2C1 to 2C3 of each level, decimal points in them, not commas" in done.stderr


def test_a_deck_that_ends_early_is_explained(atmosphere, tmp_path):
    path = tmp_path / "0.cdk"
    path.write_text("\n".join(UNPRINTED.splitlines()[:4]))
    done = atmosphere("deck", path, "-o", tmp_path / "out.rad", code=1)

    assert "0.cdk" in done.stderr


def test_decks_of_a_whole_sky_and_one_path_make_a_database(atmosphere, tmp_path):
    # the printed sky, and the printed deck as a path from 10 km straight down
    path = printed.deck(180, 0).replace("F  2   3   2", "F  2   2   2").replace(
        "   0.000   0.000 180.000", "  10.000   0.000 180.000")
    decks = [printed.deck(z, a) for z, a in itertools.product(range(0, 91, 15), range(0, 361, 30))]
    paths = []
    for i, text in enumerate([path, *decks]):
        paths.append(tmp_path / f"{i}.cdk")
        paths[-1].write_text(text)

    atmosphere("deck", *paths, "-o", tmp_path / "out.rad")

    assert "1 paths from zenith angle 0 to 0 degrees" in atmosphere("show", tmp_path / "out.rad").stdout


def test_decks_that_fill_no_database_make_no_rad(atmosphere, tmp_path):
    (tmp_path / "0.cdk").write_text(UNPRINTED)
    done = atmosphere("deck", tmp_path / "0.cdk", "-o", tmp_path / "out.rad", code=1)

    assert "out.rad:" in done.stderr and "the decks do not fill a radiance database" in done.stderr
    assert not (tmp_path / "out.rad").exists()


@pytest.mark.parametrize("count", ["1e22", "1.5", "-99999999"])
def test_a_field_that_counts_cards_is_a_whole_number_of_its_columns(atmosphere, tmp_path, count):
    (tmp_path / "0.cdk").write_text(UNPRINTED.replace("    3    2    2    1", "    7    2    2    1").replace(
        "    0    1  -1.000", "    1    1  -1.000").replace(" 4.000     0.200   130", f"{count} 0 0\n 4.000     0.200   130"))
    done = atmosphere("deck", tmp_path / "0.cdk", "-o", tmp_path / "out.rad", code=1)

    assert "0.cdk:3: " in done.stderr and "of them whole" in done.stderr


def test_wrong_usage_exits_with_2(atmosphere, tmp_path):
    for arguments in (["deck"], ["deck", "x.cdk"], ["deck", "x.cdk", "--frobnicate"], ["frobnicate"], []):
        atmosphere(*arguments, code=2)
