"""radsig-atmosphere import: the layouts in which MODTRAN writes its tables, and files of several runs."""

import numpy
import pytest
import radiance_database

NU = [2050.0, 2051.0, 2052.0]
PER_UM = numpy.array(NU[::-1]) ** 2 / 1e4  # d nu / d lambda, as wavelength rises
CARDS = "T F 6    3    2    0    6    6    6    6    6    6    1    0    0   0.000   0.00\n"
NAMES = ["TOT_TRANS", "PTH_THRML", "THRML_SCT", "SURF_EMIS", "SOL_SCAT", "SING_SCAT", "GRND_RFLT", "DRCT_RFLT", "TOTAL_RAD"]
EDGES = [8, 19, 30, 41, 52, 63, 74, 85, 96, 107, 116, 125, 133]  # where the columns end
SUN_HEAD = "    FREQ   TRANS     SOL TR  SOLAR\n"


def line(fields, edges=EDGES):
    """Right-aligned at the edges, as Fortran writes; None is blank."""
    text = ""
    for field, edge in zip(fields, edges):
        text += ("" if field is None else field).rjust(edge - len(text))
    return text.rstrip() + "\n"


def radiance(tau=0.5, thermal="1.0000E-06", scattered="2.0000E-09", names=NAMES, tail=("REF_SOL", "SOL@OBS", "DEPTH"), night=False):
    light = None if night else "0.0000E+00"
    small = None if night else "0.00E+00"
    rows = [line([f"{nu:.2f}", f"{tau:.8f}", thermal, None, "0.0000E+00", None if night else scattered, light, "0.0000E+00", light, "1.0000E-06", small, small, "0.100"])
            for nu in NU]
    return CARDS + line(["FREQ", *names, *tail]) + "".join(rows) + " -9999.\n"


def sun(depth=True):
    return CARDS.replace("3    2    0", "3    3    0") + SUN_HEAD + "".join(
        f"{nu:8.2f}  0.9000 1.80E-07 2.00E-07" + 62 * " " * depth + "1.050E-01" * depth + "\n" for nu in NU) + " -9999.\n"


UM = [4.0 + i / 8 for i in range(9)]
SCANNED_NAMES = "  TRANS  PTH THRML  THRML SCT  SURF EMIS   SOL SCAT  SING SCAT  GRND RFLT  DRCT RFLT  TOTAL RAD  REF SOL  SOL@OBS   DEPTH\n"


def scanned(kind, um=UM):
    """A file that MODTRAN's filter writes by wavelength: values are per um, here linear in it."""
    if kind == "sun":
        head = "WAVLEN MCRN  TRANS    SOL TR     SOLAR\n"
        rows = [f"{x:12.6f} 0.9000 {1e-3 * x:.4E} {2e-4 * x:.4E}\n" for x in um]
    else:
        head = "WAVLEN MCRN" + SCANNED_NAMES
        rows = [f"{x:12.6f} {.1 * x:.4f} {1e-5 * x:.4E}            0.0000E+00 {2e-6 * x:.4E} 0.0000E+00 0.0000E+00 0.0000E+00 1.0000E-05 0.00E+00 0.00E+00   0.100\n"
                for x in um]
    return head + "".join(rows) + " -9999.\n"


def transmission():
    return (CARDS.replace("3    2    0", "3    0    0") + "    FREQ COMBIN    H2O   UMIX\n    CM-1  TRANS  TRANS  TRANS\n"
            + "".join(f"{nu:8.2f} 0.5000 0.6000 0.7000\n" for nu in NU) + " -9999.\n")


@pytest.fixture
def imported(atmosphere, tmp_path):
    def run(code=0, sun_name="sun.tp7", path_name="path.tp7", sky_name="sky.tp7", **files):
        for stem, text in {"sun": sun(), "path": radiance(), "sky": radiance(), **files}.items():
            (tmp_path / f"{stem}.tp7").write_text(text)
        (tmp_path / "manifest.toml").write_text(f"""sensor_altitude_m = 10000.0
path_zenith_deg = [0.0, 0.0, 1.0]
path_range_m = [10000.0]
sky_step_deg = {{ zenith = 45, azimuth = 180 }}
sun = "{sun_name}"
path = ["{path_name}"]
sky = {str(5 * [sky_name]).replace("'", '"')}
level_altitude_m = [0.0, 100000.0]
level_temperature_k = [300.0, 200.0]
""")
        done = atmosphere("import", tmp_path / "manifest.toml", "-o", tmp_path / "out.rad", code=code)
        return done.stderr if code else (radiance_database.read(tmp_path / "out.rad"), done.stderr)
    return run


@pytest.mark.parametrize("path", [
    radiance(),
    radiance(names=[name.replace("_", " ") for name in NAMES]),                       # version 4
    radiance(names=[name.replace("_", " ") for name in NAMES], tail=("REF SOL", "SOL@OBS", "DEPTH")),
    radiance().replace("\n", "\r\n"),
    radiance().replace("  0.100\n", "  0.100 1.0000 9.6338E-07    243.796\n").replace("DEPTH\n", "DEPTH DIR_EM    TOA_SUN BBODY_T[K]\n"),  # 5 and 6
])
def test_a_radiance_table_of_each_version_gives_its_three_columns(imported, path):
    result, said = imported(path=path)

    assert result["path"][0] == pytest.approx(numpy.array([0.5 + 0 * PER_UM, 1e-6 * PER_UM, 2e-9 * PER_UM]).T, rel=1e-6)
    assert said == ""


def test_the_optical_depth_behind_a_sun_table_is_no_column_of_it(imported):
    result, _ = imported(sun=sun())
    without, _ = imported(sun=sun(depth=False))

    assert result["sun"] == pytest.approx(2e-7 * PER_UM, rel=1e-6)
    assert result["tau1"] == pytest.approx(0.9)
    assert without["sun"].tolist() == result["sun"].tolist()


def test_a_run_without_sunlight_scatters_nothing_and_says_so(imported):
    result, said = imported(path=radiance(night=True))

    assert result["path"][0] == pytest.approx(numpy.array([0.5 + 0 * PER_UM, 1e-6 * PER_UM, 0 * PER_UM]).T, rel=1e-6)
    assert "SOL SCAT is blank in 1 files" in said


def test_a_run_without_heat_emits_nothing_and_says_so(imported):
    result, said = imported(path=radiance(thermal=None))

    assert result["path"][0][:, 1].tolist() == [0, 0, 0]
    assert result["path"][0][:, 2] == pytest.approx(2e-9 * PER_UM, rel=1e-6)
    assert "PTH THRML is blank in 1 files" in said


def test_an_exponent_of_three_digits_has_lost_its_letter(imported):
    result, _ = imported(path=radiance(scattered="2.0000-009"))

    assert result["path"][0][:, 2] == pytest.approx(2e-9 * PER_UM, rel=1e-6)


def test_a_file_of_several_runs_is_read_run_by_run(imported):
    runs = sun() + radiance(tau=0.25) + radiance(tau=0.75)
    result, _ = imported(all=runs, sun_name="all.tp7#1", path_name="all.tp7#3", sky_name="all.tp7#2")

    assert result["path"][0][:, 0] == pytest.approx(0.75)
    assert result["tau1"] == pytest.approx(0.9)


def test_a_filtered_table_by_wavelength_is_put_onto_even_wavenumbers(imported):
    result, said = imported(**{stem: scanned(stem) for stem in ("sun", "path", "sky")})
    um = 1e4 / numpy.linspace(2000.0, 2500.0, 11)[::-1]  # the rows lie 50 cm-1 apart at 5 um

    assert said == ""
    assert result["wavelength"] == pytest.approx(um, rel=1e-6)
    assert result["path"][0] == pytest.approx(numpy.array([.1 * um, 1e-5 * um, 2e-6 * um]).T, rel=2e-4)  # four digits are printed
    assert result["sun"] == pytest.approx(2e-4 * um, rel=2e-4)


@pytest.mark.parametrize("names, files, expected", [
    ({}, {"path": radiance() + radiance(tau=0.75)}, ['path.tp7: holds 2 runs', '"path.tp7#2"', "1 (line 2, 3 rows from 2050 to 2052)", "2 (line 8,"]),
    ({"path_name": "path.tp7#3"}, {"path": radiance() + radiance()}, ["path.tp7: has no run 3", "2 (line 8,"]),
    ({}, {"path": transmission()}, ["path.tp7: expected a column PTH THRML"]),
    ({}, {"sun": transmission()}, ["sun.tp7: expected a column SOLAR"]),
    ({}, {"path": radiance(tau=0.5).replace("0.50000000", "          ")}, ["path.tp7", "numbers below TOT TRANS"]),
    ({}, {"path": radiance().replace("2.0000E-09", "          ", 1)}, ["path.tp7:4", "in all rows or in none"]),
    ({}, {"path": radiance()[:-100]}, ["path.tp7:5", "in all rows or in none"]),
    ({}, {"path": radiance().replace("1.0000E-06", "**********", 1)}, ["path.tp7:3", "columns of numbers"]),
    ({}, {"path": scanned("path", um=NU)}, ["path.tp7:", "wavelengths from 0.1 to 1000 um"]),
    ({}, {"path": radiance().replace("    FREQ", " WAVLEN NANO")}, ["path.tp7:2", "WAVLEN MCRN, whose radiances are per um"]),
    ({}, {"path": scanned("path", um=[4.0, 4.1, 4.3])}, ["path.tp7:", "wavelengths that rise evenly"]),
    ({}, {"path": scanned("path")}, ["path.tp7: 11 points from 2000 to 2500 cm-1, expected 3 from 2050 to 2052"]),
    ({}, {"path": "MODTRAN said nothing\n"}, ["path.tp7: expected a head that starts with FREQ"]),
    ({}, {"path": ""}, ["path.tp7: expected a head that starts with FREQ"]),
])
def test_what_cannot_be_told_is_refused_with_the_reason(imported, names, files, expected):
    said = imported(code=1, **names, **files)

    assert [part for part in expected if part not in said] == []


def test_a_file_without_its_last_mark_is_warned_about(imported):
    _, said = imported(path=radiance().replace(" -9999.\n", ""))

    assert "path.tp7: does not end with -9999." in said
