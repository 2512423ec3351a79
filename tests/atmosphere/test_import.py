"""radsig-atmosphere import: MODTRAN's own output; and show."""

import numpy
import pytest
import radiance_database

NU = numpy.arange(800, 1001, 50)
PATH_HEAD = "  FREQ   TOT TRANS  PTH THRML  THRML SCT  SURF EMIS   SOL SCAT  SING SCAT  GRND RFLT  DRCT RFLT  TOTAL RAD"
SUN_HEAD = "  FREQ    TRANS   SOL TR    SOLAR"


def tape7(head, *columns):
    rows = [f"{nu:8.2f}" + "".join(f"{column[i]:11.4E}" for column in columns) for i, nu in enumerate(NU)]
    return "\n".join(["F 2 3 2 1 card 1, repeated", " 0.0 card 2", head, *rows, " -9999."]) + "\n"


def path_tape7(tau, emitted, scattered, head=PATH_HEAD):
    nothing = 0 * NU
    return tape7(head, tau + nothing, emitted + nothing, nothing, nothing, scattered + nothing, nothing, nothing, nothing, nothing)


MANIFEST = """sensor_altitude_m = 10000.0
path_zenith_deg = [0.0, 30.0, 30.0]
path_range_m = [10000.0, 11540.0]
sky_step_deg = { zenith = 45, azimuth = 180 }
sun = "sun.tp7"
path = ["path_0.tp7", "path_30.tp7"]
sky = ["sky.tp7", "sky.tp7", "sky.tp7", "sky.tp7", "south.tp7"]
level_altitude_m = [0.0, 100000.0]
level_temperature_k = [300.0, 200.0]
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "manifest.toml").write_text(MANIFEST)
    (tmp_path / "sun.tp7").write_text(tape7(SUN_HEAD, 0.5 + 0 * NU, 1e-8 + 0 * NU, 2e-8 + 0 * NU))
    (tmp_path / "path_0.tp7").write_text(path_tape7(0.7, 1e-6, 1e-9))
    (tmp_path / "path_30.tp7").write_text(path_tape7(0.6, 2e-6, 1e-9, PATH_HEAD.replace("TOT TRANS", "TOT_TRANS").replace("PTH THRML", "PTH_THRML").replace("SOL SCAT", "SOL_SCAT")))
    (tmp_path / "sky.tp7").write_text(path_tape7(0.5, 3e-6, 1e-9))
    (tmp_path / "south.tp7").write_text(path_tape7(0.5, 4e-6, 1e-9))
    return tmp_path


def test_radiance_per_wavenumber_becomes_radiance_per_um(atmosphere, folder):
    atmosphere("import", folder / "manifest.toml", "-o", folder / "out.rad")
    result = radiance_database.read(folder / "out.rad")
    per_um = NU[::-1] ** 2 / 1e4  # d nu / d lambda

    assert result["wavenumber"].tolist() == NU[::-1].tolist()
    assert result["path"][0] == pytest.approx(numpy.array([0.7 + 0 * per_um, 1e-6 * per_um, 1e-9 * per_um]).T, rel=1e-6)
    assert result["path"][1][:, 1] == pytest.approx(2e-6 * per_um, rel=1e-6)
    assert result["sun"] == pytest.approx(2e-8 * per_um, rel=1e-6)
    assert result["tau1"] == pytest.approx(0.5)
    assert result["sky"][90, 180][:, 0] == pytest.approx(4e-6 * per_um, rel=1e-6)
    assert result["sky"][90, 360].tolist() == result["sky"][90, 0].tolist()


def test_what_was_imported_can_be_shown(atmosphere, folder):
    atmosphere("import", folder / "manifest.toml", "-o", folder / "out.radc")
    shown = atmosphere("show", folder / "out.radc").stdout

    assert "10 to 12.5 um, 5 points every 50 cm-1" in shown
    assert "path at 30 degrees, 11540 m: tau2 0.6000" in shown


@pytest.mark.parametrize("file, old, new, expected", [
    ("path_0.tp7", "PTH THRML", "SOMETHING", "expected a column PTH THRML"),
    ("sun.tp7", "SOLAR", "LUNAR", "expected a column SOLAR"),
    ("sky.tp7", "  FREQ", "  WAVELENGTH", "a head that starts with FREQ"),
    ("sky.tp7", " 850.00", " 851.00", "rise evenly"),
    ("sky.tp7", "1000.00", "       ", "columns of numbers"),
    ("manifest.toml", '"path_0.tp7", ', "", "path: found 1, expected 2"),
    ("manifest.toml", "sensor_altitude_m", "sensor_height_m", "sensor_altitude_m: missing"),
    ("manifest.toml", "south.tp7", "west.tp7", "west.tp7"),
])
def test_a_broken_import_is_explained(atmosphere, folder, file, old, new, expected):
    text = (folder / file).read_text()
    assert old in text
    (folder / file).write_text(text.replace(old, new))
    done = atmosphere("import", folder / "manifest.toml", "-o", folder / "out.rad", code=1)

    assert expected in done.stderr
    assert not (folder / "out.rad").exists()
