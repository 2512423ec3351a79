"""radsig check on meshes as their writers leave them: what is left out is told, with the file."""
import struct

import pytest
from built_program import radsig, write_scene

CORNERS = "v -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\n"
FACE = "f 1 2 3 4\n"


def check(tmp_path, name, text, code=0):
    """Checks a scene of one mesh; returns what was said and how many facets there are."""
    scene = write_scene(tmp_path, {}, geometry=[{"file": name, "material": "wall"}])
    (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    done = radsig("check", scene)
    assert done.returncode == code, done.stderr
    facets = [line.split()[5] for line in done.stdout.split("\n") if line.startswith("geometry")]
    return done.stderr, int(facets[0]) if facets else None


def stl(count, facets, tail=b""):
    parts = [struct.pack("<12f", 0, 0, 1, 0, 0, i, 1, 0, i, 0, 1, i) + b"\0\0" for i in range(facets)]
    return b"exported".ljust(80) + struct.pack("<I", count) + b"".join(parts) + tail


@pytest.mark.parametrize("name, text, facets, expected", [
    ("a.obj", CORNERS + "surf 0 1 0 1 1 2 3 4\n" + FACE, 1, "a.obj: 1 free-form surfaces are left out"),
    ("a.obj", CORNERS + "l 1 2 3\n" + FACE, 1, "a.obj: 1 lines, curves and points"),
    ("a.stl", stl(0, 2), 2, "a.stl: 2 facets are there, the header promises 0"),
    ("a.stl", stl(2, 2, 16 * b" "), 2, "a.stl: 16 bytes follow the 2 facets"),
    ("a.off", "OFF4 1 0\n" + CORNERS.replace("v ", "") + "4 0 1 2 3\n", 1, "a.off: the number of vertices is glued"),
])
def test_an_oddity_of_a_mesh_is_a_warning_with_its_file(tmp_path, name, text, facets, expected):
    said, found = check(tmp_path, name, text)

    assert expected in said and said.count("warning") == 1
    assert found == facets


@pytest.mark.parametrize("name, text", [
    ("a.obj", CORNERS.replace("0\n", "0\t# corner\n") + "f 1 2 3 4# face\n"),
    ("A.OBJ", CORNERS + FACE),
    ("a.Stl", stl(2, 2)),
    ("a.obj", CORNERS + FACE + FACE.replace("1 2 3 4", "4 3 2 1")),
])
def test_what_leaves_no_doubt_is_taken_without_a_word(tmp_path, name, text):
    assert check(tmp_path, name, text)[0] == ""


def test_facets_that_face_the_same_way_hide_each_other(tmp_path):
    assert "1 facets repeat an earlier one" in check(tmp_path, "a.obj", CORNERS + FACE + "f 2 3 4 1\n" + "f 4 3 2 1\n")[0]


@pytest.mark.parametrize("name, text, expected", [
    ("a.obj", CORNERS + "surf 0 1 0 1 1 2 3 4\n", "a.obj: no faces, but 1 free-form surfaces"),
    ("a.stl", stl(3, 2), "a.stl: 184 bytes, expected 234 for the 3 facets"),
    ("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
     "a.ply: no faces, but 1 points"),
])
def test_what_leaves_no_surface_is_refused_with_the_reason(tmp_path, name, text, expected):
    assert expected in check(tmp_path, name, text, code=1)[0]
