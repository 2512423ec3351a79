"""[materials.alias]: names that meshes give are led to the scene's materials."""
import pytest
from built_program import PLANE, radsig, write_scene

WALLS = [{"name": "concrete", "emissivity": 0.9, "temperature_k": 300.0},
         {"name": "brick", "emissivity": 0.8, "temperature_k": 300.0}]
LIBRARY = "1\ntile\n1\n.22\n5.93\n2.114\n0.0\n.93\n.93\n.40\nnull\nnull\n"


def check(tmp_path, names, aliases="", csv=None, code=0, **changes):
    """Checks a scene of one quad a name; returns `name: material` as told, and what was said."""
    quads = [PLANE.replace("wall", name).replace(" 0\n", f" {i}\n").replace("f 1 2 3 4", "f -4 -3 -2 -1") for i, name in enumerate(names)]
    scene = write_scene(tmp_path, {"plane.obj": "".join(quads)}, **{"material": WALLS, **changes})
    with scene.open("a") as file:
        if csv is not None:
            (tmp_path / "names.csv").write_bytes(csv if isinstance(csv, bytes) else csv.encode())
            file.write('[materials]\nalias_file = "names.csv"\n')
        if aliases:
            file.write(f"[materials.alias]\n{aliases}\n")
    done = radsig("check", scene)
    assert done.returncode == code, done.stderr
    told = [line.split(maxsplit=1)[1].split(" is ") for line in done.stdout.split("\n") if line.startswith("alias ")]
    return dict(told), done.stderr


@pytest.mark.parametrize("pattern, name", [
    ('"Material.001"', "Material.001"),
    ("Material.001", "Material.001"),  # to TOML a table in a table
    ('"Beton_*"', "Beton_hell"),
    ('"M?terial.[0-9]*"', "Material.001"),
    ('"Beton hell"', "Beton hell"),
    ('"Wall [1]"', "Wall [1]"),
    ('"Béton*"', "Béton clair"),
    ('"*"', "anything"),
])
def test_a_pattern_leads_a_name_to_its_material(tmp_path, pattern, name):
    assert check(tmp_path, [name], f'{pattern} = "concrete"') == ({name: "concrete"}, "")


@pytest.mark.parametrize("csv", [
    "pattern,material\nMaterial.001,concrete\nBeton_*,brick\n",
    "Pattern, Material\r\n\"Material.001\", \"concrete\"\r\nBeton_*,brick,\r\n",
    "pattern;material\nMaterial.001;concrete\nBeton_*;brick\n",
    "\ufeffpattern,material\nMaterial.001,concrete\nBeton_*,brick",
    "# of the model\npattern\tmaterial\nMaterial.001\tconcrete\nBeton_*\tbrick\n",
])
def test_a_file_holds_patterns_too(tmp_path, csv):
    told, said = check(tmp_path, ["Material.001", "Beton_hell"], csv=csv)

    assert told == {"Material.001": "concrete", "Beton_hell": "brick"}
    assert said == ""


@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
@pytest.mark.parametrize("mesh_encoding", ["utf-8", "latin-1"])
def test_names_are_the_same_in_either_encoding(tmp_path, encoding, mesh_encoding):
    (tmp_path / "some.mat").write_bytes(LIBRARY.replace("tile", "Dachfläche").encode(encoding))
    meshes = "".join(PLANE.replace("wall", name).replace(" 0\n", f" {z}\n").replace("1 2 3 4", "-4 -3 -2 -1")
                     for z, name in enumerate(["Dachfläche", "Béton_1"]))
    scene = write_scene(tmp_path, {"plane.obj": ""}, library={"materials": "some.mat"}, material=[
        *WALLS, {"name": "Dachfläche", "emissivity": 0.5, "temperature_k": 300.0}])
    (tmp_path / "plane.obj").write_bytes(meshes.encode(mesh_encoding))
    (tmp_path / "names.csv").write_bytes("pattern,material\nBéton*,concrete\n".encode(encoding))
    scene.write_text(scene.read_text() + '[materials]\nalias_file = "names.csv"\n', encoding="utf-8")
    done = radsig("check", scene, encoding="utf-8")

    assert (done.returncode, done.stderr) == (0, "")
    assert "alias       Béton_1 is concrete" in done.stdout
    assert "1 Dachfläche" in done.stdout


def test_the_first_that_fits_counts_and_the_table_comes_before_the_file(tmp_path):
    told, _ = check(tmp_path, ["Wall_a", "Wall_b"], '"Wall_a" = "brick"\n"Wall_*" = "concrete"', csv="pattern,material\nWall_?,brick\n")

    assert told == {"Wall_a": "brick", "Wall_b": "concrete"}


def test_a_known_name_is_replaced_by_its_very_own_alias_alone(tmp_path):
    assert check(tmp_path, ["brick", "other"], '"*" = "concrete"')[0] == {"other": "concrete"}
    assert check(tmp_path, ["brick"], '"brick" = "concrete"')[0] == {"brick": "concrete"}


def test_library_ground_and_the_geometry_s_material_take_aliases_as_well(tmp_path):
    (tmp_path / "some.mat").write_text(LIBRARY)
    tile = {"name": "tile", "emissivity": 0.5, "temperature_k": 300.0}
    told, _ = check(tmp_path, ["Ziegel"], '"Zieg*" = "tile"\n"Boden" = "brick"', material=[*WALLS, tile],
                    library={"materials": "some.mat"}, site={"ground_material": "Boden"})

    assert told == {"Ziegel": "tile"}
    scene = write_scene(tmp_path, {"plane.obj": PLANE.replace("usemtl wall\n", "")}, material=WALLS,
                        geometry=[{"file": "plane.obj", "material": "Dach"}])
    scene.write_text(scene.read_text() + '[materials.alias]\nDach = "brick"\n')
    assert "alias       Dach is brick" in radsig("check", scene).stdout


@pytest.mark.parametrize("names, aliases, csv, expected", [
    (["Beton_hell", "brick"], '"Beton_hel" = "concrete"\n"Beton*" = "concrete"', None, ["scene.toml:", "alias \"Beton_hel\": no material of the meshes has such a name (did you mean 'Beton_hell'?)"]),
    (["brick"], "", "pattern,material\nGlas*,concrete\n", ["names.csv:2: alias \"Glas*\": no material"]),
])
def test_a_pattern_that_fits_nothing_is_a_warning_with_the_nearest_name(tmp_path, names, aliases, csv, expected):
    said = check(tmp_path, names, aliases, csv)[1]

    assert [part for part in expected if part not in said] == []


@pytest.mark.parametrize("names, aliases, csv, expected", [
    (["conrete", "Glas"], '"Beton*" = "concrete"', None, ["material \"conrete\" is neither in the library nor a [[material]], and no alias matches it (did you mean 'concrete'?)", 'material "Glas" is neither']),
    (["a"], '"a" = "conrete"', None, ["scene.toml:", "alias \"a\": material \"conrete\" is neither in the library nor a [[material]] (did you mean 'concrete'?)"]),
    (["a"], "", "pattern,material\nb,concrete\na,bric\n", ["names.csv:3: alias \"a\": material \"bric\" is neither", "did you mean 'brick'?"]),
    (["a"], '"a" = 1', None, ["materials.alias.a"]),
    (["a"], "", "a,concrete\n", ["names.csv:1: found 'a,concrete', expected the names of the columns, pattern,material"]),
    (["a"], "", "pattern,material\na\n", ["names.csv:2: found 'a', expected a pattern and a material"]),
    (["a"], "", "pattern,material\na,concrete,brick\n", ["names.csv:2"]),
    (["a"], "", "", ["names.csv:1: the file ends, expected the names of the columns"]),
    (["a"], "", b"pattern,material\n\0", ["names.csv: is binary"]),
])
def test_what_leads_nowhere_is_refused_with_its_line(tmp_path, names, aliases, csv, expected):
    said = check(tmp_path, names, aliases, csv, code=1)[1]

    assert [part for part in expected if part not in said] == []


def test_the_file_may_stand_in_the_place_of_the_table(tmp_path):
    scene = write_scene(tmp_path, {"plane.obj": PLANE.replace("wall", "Beton")}, material=WALLS)
    (tmp_path / "names.csv").write_text("pattern,material\nBet*,concrete\n")
    scene.write_text(scene.read_text() + '[materials]\nalias = "names.csv"\n')

    assert "alias       Beton is concrete" in radsig("check", scene).stdout
    scene.write_text(scene.read_text() + 'alias_file = "names.csv"\n')
    assert "expected a table beside alias_file" in radsig("check", scene).stderr
    scene.write_text(scene.read_text().replace('alias_file = "names.csv"\n', "").replace('"names.csv"', "5"))
    assert "materials.alias: 5, expected" in radsig("check", scene).stderr
