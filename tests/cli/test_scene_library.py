"""Libraries: .mat and .toml files as one list of materials."""
import pytest

MAT = "1\ngrass\n4\n.30\n2.5\n.60\n0.0\n.80\n.95\n.16\nnull\nnull\n"
CURVE = "wavelength_um,emissivity\n7,0.9\n10,0.8\n14,0.9\n"
WALL = ('[[material]]\nname = "wall"\nspectrum_file = "wall.csv"\nspecular_share = 0.25\n'
        'temperature_k = 290\nlayers = [{ thickness_cm = 8, conductivity_w_m_k = 0.04, '
        'density_kg_m3 = 50, specific_heat_j_kg_k = 900 }]\n')


@pytest.fixture
def check(program, tmp_path):
    """Runs `radsig check` on a plane of `wall` with these files in the folder lib."""

    def run(materials, files, **changes):
        (tmp_path / "lib").mkdir(exist_ok=True)
        for name, text in files.items():
            (tmp_path / "lib" / name).write_text(text)
        return program.run("check", program.write_scene(
            tmp_path, library={"materials": materials}, material=changes.pop("material", []), **changes))

    return run


def test_a_material_of_a_toml_library_finds_its_files_beside_it(check):
    done = check("lib/a.toml", {"a.toml": WALL, "wall.csv": CURVE})

    assert done.returncode == 0, done.stderr
    assert "input       wall.csv" in done.stdout and "specular" in done.stdout
    assert "mean emissivity in lwir 0.8444" in done.stdout  # .8667 at 8 um, .8 at 10, .9 at 14: 5.0667 / 6


def test_files_of_materials_that_are_not_used_are_not_read(check):
    other = '[[material]]\nname = "other"\nspectrum_file = "absent.csv"\n'

    done = check("lib/a.toml", {"a.toml": WALL + other, "wall.csv": CURVE})

    assert done.returncode == 0, done.stderr


def test_the_scene_changes_a_material_of_a_toml_library(check):
    changed = [{"name": "wall", "specular_share": 0.0}]
    grey = [{"name": "wall", "emissivity": 0.5, "specular_share": 0.0}]

    done = check("lib/a.toml", {"a.toml": WALL, "wall.csv": CURVE}, material=changed)
    assert "diffuse" in done.stdout and "mean emissivity in lwir 0.8444" in done.stdout
    done = check("lib/a.toml", {}, material=grey)
    assert "thermal emissivity 0.50, diffuse" in done.stdout and "spectrum " not in done.stdout


def test_a_code_that_no_mat_has_is_found_by_its_name(program, check, tmp_path):
    """A .gdb names materials by code and name."""

    done = check(["lib/a.toml"], {"a.toml": WALL.replace('"wall"', '"brick"'), "wall.csv": CURVE},
                 geometry=[{"file": str(program.airport / "airport.gdb")}], render={"thermal": "fixed"})

    assert "(tar) is not in the library" in done.stderr and "(brick)" not in done.stderr


def test_numbers_of_toml_materials_follow_the_codes_of_all_mat_files(check):
    done = check(["lib/a.toml", "lib/b.mat"], {"a.toml": WALL, "wall.csv": CURVE, "b.mat": MAT})

    assert done.returncode == 0, done.stderr
    assert "material      5 wall" in done.stdout


@pytest.mark.parametrize("materials, files, expected", [
    (["lib/a.toml", "lib/b.toml"], {"a.toml": WALL, "b.toml": "\n" + WALL},
     ['lib/b.toml:2: ', 'lib/b.toml: material "wall" stands in ', "lib/a.toml too"]),
    (["lib/a.mat", "lib/b.mat"], {"a.mat": MAT, "b.mat": MAT}, ['b.mat: material "grass" stands in', "a.mat too"]),
    (["lib/a.mat", "lib/b.mat"], {"a.mat": MAT, "b.mat": MAT.replace("grass", "lawn")},
     ['code 4 of material "lawn" is that of "grass" in']),
    ("lib/a.toml", {"a.toml": "name = 1\n" + WALL}, ["lib/a.toml:1: name: found this, expected [[material]]"]),
    ("lib/a.toml", {"a.toml": "[[material]]\nemissivity = 1\n"}, ["a.toml:1: material.0: name is missing"]),
    ("lib/a.toml", {"a.toml": WALL + "colour = 1\n", "wall.csv": CURVE}, ["a.toml:7: material.0.colour: unknown key"]),
    ([], {}, ["found 0 files, expected 1 to 64"]),
])
def test_wrong_libraries_are_refused(check, materials, files, expected):
    done = check(materials, {**files, "wall.csv": CURVE})

    assert done.returncode == 1
    for text in expected:
        assert text in done.stderr
