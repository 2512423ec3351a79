"""`radsig material`: libraries listed, materials shown, spectra converted."""
import pytest

CURVE = "wavelength_um,reflectance\n0.25,0.2\n2.5,0.2\n8,0.1\n14,0.1\n"
LIBRARY = ('[[material]]\nname = "wall"\nspectrum_file = "wall.csv"\n[[material]]\nname = "grey"\n'
           'emissivity = 0.5\n[[material]]\nname = "smoke"\nextinction_per_km = 3\n')


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "wall.csv").write_text(CURVE)
    (tmp_path / "a.toml").write_text(LIBRARY)
    return tmp_path


def test_list_names_all_materials_of_all_libraries(program, folder):
    done = program.run("material", "list", folder / "a.toml",
                       program.root / "scenes" / "library" / "materials.mat")

    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) == 3 + 45
    assert "wall" in lines[0] and "1 - reflectance (Kirchhoff)" in lines[0]
    assert "grey" in lines[1] and "solar 0.500 thermal 0.500" in lines[1]
    assert "transmissive" in lines[2]


def test_show_tells_what_the_spectrum_comes_to(program, folder):
    done = program.run("material", "show", "wall", folder / "a.toml")

    assert done.returncode == 0, done.stderr
    assert "absorptance 0.800 for heat" in done.stdout  # up to 2.5 um; the last 1 % of sunlight hardly more
    assert "emissivity      0.4 to 0.7 um 0.8000" in done.stdout
    assert "emissivity      8 to 14 um 0.9000" in done.stdout
    assert "at 10 um, 0 30 60 75 85 degrees 0.9000 0.9000" in done.stdout


def test_show_states_by_how_much_heat_and_radiance_differ(program, folder):
    text = LIBRARY.replace('"wall.csv"', '"wall.csv"\nsolar_absorptance = 0.7')
    (folder / "a.toml").write_text(text)

    done = program.run("material", "show", "wall", folder / "a.toml")

    assert "absorptance 0.700 for heat; the spectrum over sunlight 0.800, +0.100" in done.stdout


def test_an_unknown_material_is_refused_with_the_nearest_name(program, folder):
    done = program.run("material", "show", "wal", folder / "a.toml")

    assert done.returncode == 1 and "did you mean 'wall'?" in done.stderr


def test_a_converted_spectrum_is_a_library(program, folder):
    done = program.run("material", "convert", folder / "wall.csv", "-o", folder / "b.toml", "--angular", "rough")

    assert done.returncode == 0, done.stderr
    text = (folder / "b.toml").read_text()
    assert 'name = "wall"\nspectrum_file = "wall.csv"\nangular = "rough"\n' in text
    shown = program.run("material", "show", "wall", folder / "b.toml")
    assert "0.9000 0.9000 0.893" in shown.stdout  # .9 (1 - .12 (1 - .5)^4) at 60 degrees


def test_a_converted_ems_holds_the_spectrum_at_its_wavenumbers(program, folder):
    done = program.run("material", "convert", folder / "wall.csv", "-o", folder / "b.ems")

    assert done.returncode == 0, done.stderr
    lines = (folder / "b.ems").read_text().splitlines()
    assert len(lines) == 91 * 397
    assert lines[0] == "0" and lines[1] == "39850 0.800000" and lines[396] == "350 0.900000"


def test_an_ems_beyond_the_data_is_refused_and_not_written(program, folder):
    (folder / "lwir.csv").write_text("wavelength_um,emissivity\n8,0.9\n10,0.9\n14,0.9\n")

    done = program.run("material", "convert", folder / "lwir.csv", "-o", folder / "b.ems")

    assert done.returncode == 1 and "found nothing near 0.2509 um, expected --outside" in done.stderr
    assert not (folder / "b.ems").exists()


@pytest.mark.parametrize("arguments, expected", [
    ([], "expected list, show or convert"), (["shew"], "found shew"),
    (["convert", "x.csv", "-o", "x.txt"], "ends with .toml or .ems")])
def test_wrong_use_is_told(program, folder, arguments, expected):
    done = program.run("material", *arguments, cwd=folder)

    assert done.returncode != 0 and expected in done.stderr


def test_pictures_are_drawn(program, folder):
    done = program.run("material", "show", "wall", folder / "a.toml", "--plot", folder / "s.png",
                       "--plot-angle", folder / "a.png")

    assert done.returncode == 0, done.stderr
    for name in ("s.png", "a.png"):
        assert (folder / name).read_bytes().startswith(b"\x89PNG")
