"""radsig-atmosphere deck: several runs in one deck, told by IRPT on card 5."""

import lowtran_by_hand
import numpy
import pytest
import radiance_database

THERMAL = """    2    3    1    0    0    0    0    0    0    0    0    0    1   0.000   0.00
    5    0    0    1    0    0     0.000     0.000     0.000     0.000     0.000
     0.000     0.000    60.000     0.000     0.000     0.000    0
   800.000  1200.000    20.000
"""
STEEPER = "     0.000     0.000    30.000     0.000     0.000     0.000    0\n"
FINER = "   903.000  1001.000     7.000\n"  # on a later card 4 LOWTRAN does not round to multiples of 5
HAZE = """    3    2    2    1    0    0    0    0    0    0    0    0    1  -1.000   0.25
    4    0    0    1    0    0    12.000     0.000     0.000     0.000     0.200
     4.000     0.200   130.000     0.000     0.000     0.000    0
    2    2   20    0
    55.000    62.000     0.000     0.000     0.000     0.000     0.000     0.000
  2000.000  2600.000    20.000
"""
SUN = """    6    3    3    0    0    0    0    0    0    0    0    0    1   0.000   0.00
    1    0    0    1    0    0     0.000     0.000     0.000     0.000     0.000
     0.000     0.000    37.151  175          0.000    0     0.000
  2000.000  2600.000    20.000
"""
OWN = """    7    3    1    0    6    6    6    6    6    6    1    1    1   0.000   0.00
    1    0    0    1    0    0     0.000     0.000     0.000     0.000     0.000
    3    0    0 three levels
     0.000 1.013E+03 3.000E+02 1.000E+01 0.000E+00 0.000E+00AAC666666666666
     2.000 7.950E+02 2.850E+02 3.000E+00 0.000E+00 0.000E+00AAC666666666666
    50.000 8.000E-01 2.700E+02 1.000E-03 0.000E+00 0.000E+00AAC666666666666
     0.000     0.000    60.000     0.000     0.000     0.000    0
   800.000  1200.000    20.000
"""


DOWN = """    2    2    1    0    0    0    0    0    0    0    0    0    1   0.000   0.00
    1    0    0    1    0    0     0.000     0.000     0.000     0.000     0.000
     4.000     0.200   130.000     0.000     0.000     0.000    0
   800.000  1200.000    20.000
"""
UP = "     4.000     0.200    80.000     0.000     0.000     0.000    0\n"  # away from H2


def card_5(irpt):
    return f"{irpt:5d}\n"


@pytest.fixture
def run_chain(atmosphere, tmp_path):
    """Runs a deck; returns a database for each file."""
    def run(deck):
        (tmp_path / "chain.cdk").write_text(deck)
        atmosphere("deck", tmp_path / "chain.cdk", "-o", tmp_path / "out.runs")
        paths = sorted(tmp_path.glob("out*.runs"), key=lambda path: (len(path.name), path.name))
        return [radiance_database.read(path) for path in paths]

    return run


def test_runs_that_share_wavenumbers_share_a_file(run_chain, tmp_path):
    result, = run_chain(THERMAL + card_5(3) + STEEPER + card_5(0))
    by_hand = lowtran_by_hand.run(THERMAL + card_5(3) + STEEPER + card_5(0), tmp_path / "by_hand")

    assert sorted(result["sky"]) == [(30, 0), (60, 0)]
    assert result["sky"][30, 0][:, 0] == pytest.approx(by_hand[:, 2], rel=1e-6)  # seven digits are written


def test_the_last_run_of_a_chain_is_that_of_lowtran_by_hand(run_chain, tmp_path):
    chain = THERMAL + card_5(1) + HAZE + card_5(4) + FINER + card_5(0)
    last = run_chain(chain)[-1]
    by_hand = lowtran_by_hand.run(chain, tmp_path / "by_hand")
    by_hand = by_hand[by_hand[:, 0] < 1200][-len(last["wavenumber"]):]  # behind them points of earlier runs

    assert last["wavenumber"] == pytest.approx(numpy.arange(1005, 899, -7))  # 900 and up until 1005, every 7
    # A deck of its own would refract for its own wavenumbers: 2e-6 away.
    assert last["path"][0] == pytest.approx(by_hand[:, 1:], rel=1e-6)


def test_every_run_of_a_chain_is_that_of_lowtran_s_own_file(run_chain, tmp_path):
    chain = HAZE + card_5(1) + SUN + card_5(4) + FINER + card_5(1) + HAZE + card_5(4) + "  2200.000  2400.000    50.000\n" + card_5(0)
    files = run_chain(chain)
    lowtran_by_hand.run(chain, tmp_path / "by_hand")
    spectra = lowtran_by_hand.tape7_spectra(tmp_path / "by_hand")

    # run 1, 2 and 4 share wavenumbers; the sun's run gives tau1
    expected = [(files[0]["path"][0, :, 0], 0), (files[0]["tau1"], 1), (files[1]["tau1"], 2),
                (files[0]["path"][1, :, 0], 3), (files[2]["path"][0, :, 0], 4)]
    assert len(files) == 3 and len(spectra) == 5
    for transmission, number in expected:
        assert transmission == pytest.approx(spectra[number][:, 1], abs=6e-5)  # four decimals


def test_a_profile_may_be_kept_from_the_run_before(run_chain, tmp_path):
    # MODEL 7 with IM 0 reads no levels
    again = "".join(OWN.splitlines(True)[:2]).replace("1    1    1   0.000", "1    0    1   0.000") + STEEPER
    chain = OWN + card_5(1) + again + "   800.000  1200.000    20.000\n" + card_5(0)
    result, = run_chain(chain)
    by_hand = lowtran_by_hand.run(chain, tmp_path / "by_hand")

    assert result["sky"][30, 0][:, 0] == pytest.approx(by_hand[:, 2], rel=1e-6)
    assert (result["sky"][30, 0] != result["sky"][60, 0]).any()


def test_decks_with_further_cards_stand_in_chains(atmosphere, tmp_path):
    (tmp_path / "phase.txt").write_text("0 0.0795775\n180 0.0795775\n")
    (tmp_path / "sonde.csv").write_text("pressure_hpa,altitude_km,temperature_k\n1013,0,290\n900,1,285\n300,9,240\n")
    (tmp_path / "scene.toml").write_text("""name = "further"
[site]
latitude_deg = 40.0
longitude_deg = -84.0
time = 1987-06-24T12:00:00-05:00
[atmosphere.generate]
model = "midlatitude-summer"
radiosonde = "sonde.csv"
phase_function = "table"
phase_table = "phase.txt"
sensor_altitude_m = 1000.0
path_zenith_deg = [0.0, 30.0, 30.0]
wavenumber_cm1 = [15000.0, 16000.0]
wavenumber_step_cm1 = 500.0
sample_step_cm1 = 500.0
""")
    atmosphere("make", tmp_path / "scene.toml", "-o", tmp_path / "made.rad", "--keep-decks", tmp_path / "decks")
    decks = sorted((tmp_path / "decks").glob("*.cdk"))
    texts = [path.read_text() for path in decks]
    chain = "".join(text[: text.rindex("    0\n")] + "    1\n" for text in texts[:-1]) + texts[-1]
    (tmp_path / "chain.cdk").write_text(chain)
    atmosphere("deck", *decks, "-o", tmp_path / "one_by_one.runs")
    atmosphere("deck", tmp_path / "chain.cdk", "-o", tmp_path / "chain.runs")
    numbers = [[line for line in (tmp_path / name).read_text().splitlines() if line[0] != "#"]
               for name in ("one_by_one.runs", "chain.runs")]

    assert numbers[0] == numbers[1]


@pytest.mark.parametrize("deck, expected", [
    (THERMAL + card_5(2) + THERMAL + card_5(0), "chain.cdk:5: '2' stands there, expected card 5 with IRPT 0, 1, 3 or 4"),
    (HAZE + card_5(3) + STEEPER + card_5(0), "chain.cdk:7: '3' stands there, expected card 5 with IRPT 0, 1 or 4"),
    (THERMAL + card_5(3) + STEEPER.replace("30.000", "230.00") + card_5(0), "chain.cdk:6: "),
    (THERMAL + card_5(0) + THERMAL + card_5(0), "chain.cdk:6: "),
    (OWN[: OWN.index("    50.000")], "chain.cdk:6: the file ends, expected cards 2C1 to 2C3"),
    (OWN.replace("    7    3", "F   7    3", 1) + card_5(0), "chain.cdk:2: "),
    # LOWTRAN gives no spectrum, and that of the first run does not count
    (DOWN + card_5(3) + UP + card_5(0), "chain.cdk, run 2: LOWTRAN"),
])
def test_a_broken_chain_is_explained(atmosphere, tmp_path, deck, expected):
    (tmp_path / "chain.cdk").write_text(deck)
    done = atmosphere("deck", tmp_path / "chain.cdk", "-o", tmp_path / "out.rad", code=1)

    assert expected in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["chain.cdk"]
