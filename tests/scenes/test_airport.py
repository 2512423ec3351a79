"""The airport's geometry file: what the thesis prints of it, and what any sound geometry obeys."""

import collections
import pathlib
import subprocess
import sys
import tomllib

import numpy
import pytest

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
AIRPORT = SCENES / "airport"

# Places are printed with seven digits: .1 mm between 100 and 1000 m, and two roundings meet.
PRINTED_M = 2e-4

# Appendix A item 3: name, id, material, code, attribute, default temperature, thickness, power,
# vertices, area vector, slope, azimuth, last number.
PRINTED = [
    ("RUNWAY2_RUNWAY_1", "1-1-1", "concrete/roadway", 22, "runway", -1, 35.56, 0,
     [(60, -30, -1), (60, -60, -1), (360, -60, -1), (360, -30, -1)], (0, 0, -9000), 180, 0, 0),
    ("RUNWAY2_RUNWAY_2", "1-1-2", "concrete/roadway", 22, "runway", -1, 35.56, 0,
     [(60, -30, -.5), (60, -30, -1), (360, -30, -1), (360, -30, -.5)], (0, 150, 0), 90, 270, .25),
    ("GRASS_4", "24-1-4", "summergrass", 4, "grass", -1, .91, -3.5,
     [(1200, -850, -1), (1200, -850, -6), (-1300, -850, -6), (-1300, -850, -1)],
     (0, -12500, 0), 90, 90, .25),
    ("GRASS_5", "24-1-5", "summergrass", 4, "grass", -1, .91, -3.5,
     [(-1300, -850, -1), (-1300, -850, -6), (-1300, 2150, -6), (-1300, 2150, -1)],
     (-15000, 0, 0), 90, 180, .25),
]  # fmt: skip


class Facet:
    """One FACE of the file; fields keep their order in Appendix A."""

    def __init__(self, lines, at, part):
        self.name, self.id, self.material, code, self.attribute = lines[at + 1 : at + 6]
        self.temperature, self.thickness, self.power, _ = map(float, lines[at + 6 : at + 10])
        self.code, self.part, count = int(code), part, int(lines[at + 13])
        places = lines[at + 14 : at + 14 + count]
        self.vertices = numpy.array([place.split() for place in places], float)
        self.end = at + 18 + count
        self.area = numpy.array(lines[self.end - 4].split(), float)
        self.slope, self.azimuth, self.last = map(float, lines[self.end - 3 : self.end])


class Geometry:
    def __init__(self, path):
        self.objects, self.parts, self.facets = [], [], []
        lines, at = path.read_text().splitlines(), 0
        while at < len(lines):
            if lines[at] == "FACE":
                self.facets.append(Facet(lines, at, len(self.parts) - 1))
                at = self.facets[-1].end
            else:
                {"OBJECT": self.objects, "PART": self.parts}[lines[at]].append(
                    lines[at + 1 : at + 3]
                )
                at += 3

    def corners(self):
        """Shape (facet, 4, 3); a triangle repeats its last vertex."""
        return numpy.array([f.vertices[[0, 1, 2, -1]] for f in self.facets])


def run(script, *arguments):
    command = [sys.executable, "-B", str(script), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True)


def read_materials():
    lines = (SCENES / "library" / "materials.mat").read_text().splitlines()
    return [lines[i : i + 11] for i in range(1, len(lines), 11)]


@pytest.fixture(scope="module")
def airport(tmp_path_factory):
    path = tmp_path_factory.mktemp("airport") / "airport.gdb"
    done = run(AIRPORT / "make_geometry.py", path)
    assert done.returncode == 0, done.stderr
    return Geometry(path)


def by_object(airport):
    groups = collections.defaultdict(list)
    for i, facet in enumerate(airport.facets):
        groups[int(facet.id.split("-")[0])].append(i)
    return groups


def test_the_airport_has_the_thesis_counts(airport):
    counts = len(airport.objects), len(airport.parts), len(airport.facets)

    assert counts == (50, 661, 54545)  # Figure 3-2


@pytest.mark.parametrize("printed", PRINTED, ids=[row[0] for row in PRINTED])
def test_a_facet_that_appendix_a_prints_is_in_the_file_as_printed(airport, printed):
    facet = next(f for f in airport.facets if f.name == printed[0])

    fields = [facet.id, facet.material, facet.code, facet.attribute]
    numbers = [facet.temperature, facet.thickness, facet.power]
    assert fields == list(printed[1:5])
    assert numbers == list(printed[5:8])
    assert facet.vertices.tolist() == [list(map(float, vertex)) for vertex in printed[8]]
    assert facet.area == pytest.approx(printed[9])
    assert [facet.slope, facet.azimuth, facet.last] == pytest.approx(printed[10:])


def test_the_objects_that_appendix_a_prints_have_their_names(airport):
    assert airport.objects[0] == ["RUNWAY2_OBJ", "1-0-0"]
    assert airport.parts[0] == ["RUNWAY2_ATTS", "1-1-0"]


def test_numbers_of_objects_parts_and_faces_count_from_one(airport):
    expected, parts = [], []
    for i, (_, identity) in enumerate(airport.parts):
        faces = sum(1 for f in airport.facets if f.part == i)
        parts.append([int(n) for n in identity.split("-")])
        expected += [f"{parts[i][0]}-{parts[i][1]}-{k}" for k in range(1, faces + 1)]

    assert [f.id for f in airport.facets] == expected
    assert [o[1] for o in airport.objects] == [f"{i}-0-0" for i in range(1, 51)]
    for before, after in zip(parts, parts[1:]):
        assert after in ([before[0], before[1] + 1, 0], [before[0] + 1, 1, 0])


def test_every_name_is_there_once(airport):
    names = [f.name for f in airport.facets] + [n for n, _ in airport.objects + airport.parts]

    assert len(set(names)) == len(names)


def test_facets_have_three_or_four_sides(airport):
    assert {len(f.vertices) for f in airport.facets} == {3, 4}


def test_quads_are_planar(airport):
    p = airport.corners()
    across = numpy.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
    across /= numpy.linalg.norm(across, axis=1)[:, None]
    between_diagonals = numpy.abs(((p[:, 1] - p[:, 0]) * across).sum(1))

    assert between_diagonals.max() <= PRINTED_M


def test_quads_are_convex(airport):
    p = airport.corners()[[len(f.vertices) == 4 for f in airport.facets]]
    edge = numpy.roll(p, -1, 1) - p
    turn = numpy.cross(edge, numpy.roll(edge, -1, 1))
    normal = numpy.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
    # A vertex may lie on the line of its neighbours, give or take what was rounded.
    slack = PRINTED_M * numpy.linalg.norm(edge, axis=2).sum(1)

    assert (
        (turn * normal[:, None]).sum(2).min(1) >= -slack * numpy.linalg.norm(normal, axis=1)
    ).all()


def test_no_facet_is_degenerate(airport):
    area = numpy.linalg.norm([f.area for f in airport.facets], axis=1)

    assert area.min() >= 1e-6  # a square millimetre


def test_no_facet_is_there_twice(airport):
    seen = {tuple(sorted(map(tuple, f.vertices.tolist()))) for f in airport.facets}

    assert len(seen) == len(airport.facets)


def test_no_edge_has_more_than_two_facets(airport):
    edges = collections.Counter()
    for facet in airport.facets:
        places = list(map(tuple, facet.vertices.tolist()))
        edges.update(map(frozenset, zip(places, places[1:] + places[:1])))

    assert max(edges.values()) == 2


def test_vertices_run_clockwise_around_the_printed_area_vector(airport):
    p = airport.corners()
    right_handed = numpy.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]) / 2
    printed = numpy.array([f.area for f in airport.facets])

    numpy.testing.assert_allclose(printed, -right_handed, rtol=1e-9, atol=1e-9)


def test_slope_and_azimuth_follow_from_the_printed_area_vector(airport):
    north, west, up = numpy.array([f.area for f in airport.facets]).T
    size = numpy.sqrt(north**2 + west**2 + up**2)
    slope = numpy.radians([f.slope for f in airport.facets])
    azimuth = numpy.radians([f.azimuth for f in airport.facets])

    # Angles are printed with seven digits: 2e-6 rad at 360 degrees.
    numpy.testing.assert_allclose(numpy.cos(slope), up / size, atol=4e-6)
    numpy.testing.assert_allclose(numpy.sin(slope) * numpy.cos(azimuth), north / size, atol=4e-6)
    numpy.testing.assert_allclose(numpy.sin(slope) * numpy.sin(azimuth), -west / size, atol=4e-6)


def test_the_area_vectors_of_a_closed_object_cancel(airport):
    for number, members in by_object(airport).items():
        areas = numpy.array([airport.facets[i].area for i in members])
        left_over = numpy.linalg.norm(areas.sum(0)) / numpy.linalg.norm(areas, axis=1).sum()
        assert left_over < 1e-4, airport.objects[number - 1]  # edges of .1 m, rounded by .1 mm


def test_a_closed_object_holds_a_positive_volume(airport):
    for number, members in by_object(airport).items():
        centre = airport.facets[members[0]].vertices[0]
        flow = [
            airport.facets[i].area @ (airport.facets[i].vertices.mean(0) - centre) for i in members
        ]
        assert sum(flow) / 3 > 0, airport.objects[number - 1]  # the divergence theorem


def test_the_fighter_that_leaves_its_hangar_stands_on_the_view_target(airport):
    fighter = next(i for i, (name, _) in enumerate(airport.objects, 1) if name == "FOXBAT1_OBJ")
    members = by_object(airport)[fighter]
    places = numpy.concatenate([airport.facets[i].vertices for i in members])
    target = [float(n) for n in (AIRPORT / "foxbat.adv").read_text().split()[:2]]

    assert (places.min(0)[:2] < target).all() and (target < places.max(0)[:2]).all()


def test_every_facet_is_of_a_material_in_the_library(airport):
    codes = {(row[0], int(row[1])) for row in read_materials()}

    assert {(f.material, f.code) for f in airport.facets} <= codes


def test_every_facet_has_attribute_and_thickness_and_computes_its_temperature(airport):
    assert all(f.attribute and f.thickness > 0 and f.temperature == -1 for f in airport.facets)


def test_the_scene_file_states_the_view_of_the_1994_file():
    numbers = [float(n) for n in (AIRPORT / "foxbat.adv").read_text().split()]
    camera = tomllib.loads((AIRPORT / "scene.toml").read_text())["camera"]

    def enu(north, west, up):
        return [-west, north, up]

    assert camera["target_m"] == enu(*numbers[0:3])
    assert camera["position_m"] == enu(*numbers[3:6])
    assert camera["focal_length_mm"] == pytest.approx(numbers[9], abs=0.005)  # two decimals kept
    assert camera["pixels"] == [int(n) for n in numbers[10:12]]


def test_a_folder_that_is_not_there_is_named_without_a_traceback(tmp_path):
    done = run(AIRPORT / "make_geometry.py", tmp_path / "missing" / "airport.gdb")

    assert done.returncode == 1
    assert "missing" in done.stderr and "Traceback" not in done.stderr
