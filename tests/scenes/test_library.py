"""The material library: Table D-1, the printed records, and the generated emissivity files."""

import importlib.util
import pathlib
import subprocess
import sys

import numpy
import pytest

LIBRARY = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "library"

# Table D-1: density, specific heat, conductivity, visible and thermal emissivity, exposed area.
TABLE_D1 = {
    "asphalt": (2.114, 0.22, 5.93, 0.93, 0.93, 0.40),
    "blue_wood": (0.60, 0.67, 0.86, 0.60, 0.78, -0.77),
    "bumper": (7.833, 0.1111, 464.4, 0.88, 0.44, 0.69),
    "car_roof": (7.833, 0.1111, 464.4, 0.88, 0.44, 0.53),
    "car_side": (7.833, 0.1111, 464.4, 0.88, 0.44, 1.0),
    "concrete": (2.28, 0.1601, 15.48, 0.73, 0.94, 0.39),
    "front_black": (0.60, 0.67, 0.86, 0.90, 0.78, -0.77),
    "front_white": (0.60, 0.67, 0.86, 0.20, 0.78, -0.77),
    "green_wood": (0.60, 0.67, 0.86, 0.55, 0.78, -0.77),
    "grey_1": (0.60, 0.67, 0.86, 0.50, 0.78, -0.77),
    "grey_2": (0.60, 0.67, 0.86, 0.60, 0.78, -0.77),
    "grey_3": (0.60, 0.67, 0.86, 0.70, 0.78, -0.77),
    "grey_4": (0.60, 0.67, 0.86, 0.80, 0.78, -0.77),
    "grey_5": (0.60, 0.67, 0.86, 0.72, 0.87, -0.55),
    "red": (0.60, 0.67, 0.86, 0.65, 0.78, -0.77),
    "sand": (1.52, 0.1911, 2.84, 0.76, 0.90, 0.39),
    "windshield": (1.0, 0.52, 12.04, 0.61, 0.61, 0.52),
    "shingles": (1.3, 0.35, 6.36, 0.74, 0.91, -0.66),
    "specular": (0.60, 0.67, 0.86, 0.72, 0.87, -0.45),
    "tire": (1.198, 0.2986, 1.3, 0.93, 0.90, -0.82),
    "water_1992": (1.0, 1.0, 11.0, 0.09, 0.0, -0.57),
    "window": (1.0, 0.52, 12.04, 0.61, 0.61, 0.95),
}

# Appendix A item 10: code, specific heat, conductivity, density, specularity, visible and thermal
# emissivity, exposed area of the records that are printed whole.
PRINTED = {
    "cloud": (0, 1.0, 5.0, 1.0, 0.0, 0.5, 0.96, -0.5),
    "painted_steel_roof": (1, 0.1111, 464.4, 7.833, 1.0, 0.60, 0.90, 0.50),
    "water": (2, 1.0, 5.13, 1.0, 1.0, 0.50, 0.96, -0.40),
    "pine_tree": (45, 1.0, 0.0, 1.0, 0.0, 0.9, 0.96, 0.17),
    "corn_field": (46, 1.0, 0.0, 1.0, 0.0, 0.9, 0.96, 0.17),
    "scrub_oak": (47, 1.0, 0.0, 1.0, 0.0, 0.9, 0.96, 0.17),
}


@pytest.fixture(scope="module")
def materials():
    lines = (LIBRARY / "materials.mat").read_text().splitlines()
    rows = [lines[i : i + 11] for i in range(1, len(lines), 11)]
    assert len(rows) == int(lines[0])
    return {row[0]: row for row in rows}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("emissivity")
    command = [sys.executable, "-B", str(LIBRARY / "make_emissivity.py"), str(path)]
    subprocess.run(command, check=True, capture_output=True)
    return path


@pytest.fixture(scope="module")
def generator():
    spec = importlib.util.spec_from_file_location("make_emissivity", LIBRARY / "make_emissivity.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def read_emissivity(path):
    """Values of shape (91, 396), with the angles and wavenumbers checked on the way."""
    lines = path.read_text().splitlines()
    assert len(lines) == 91 * 397
    assert [int(angle) for angle in lines[::397]] == list(range(91))
    del lines[::397]
    rows = numpy.array([line.split() for line in lines], float).reshape(91, 396, 2)
    assert (rows[:, :, 0] == numpy.arange(39850, 349, -100)).all()
    return rows[:, :, 1]


def column(wavenumber):
    return (39850 - wavenumber) // 100


@pytest.mark.parametrize("name", TABLE_D1)
def test_a_row_of_table_d1_is_in_the_library(materials, name):
    _, _, heat, conductivity, density, _, visible, thermal, exposed = materials[name][:9]

    found = [float(n) for n in (density, heat, conductivity, visible, thermal, exposed)]
    assert found == list(TABLE_D1[name])


@pytest.mark.parametrize("name", PRINTED)
def test_a_record_that_appendix_a_prints_keeps_its_numbers(materials, name):
    assert [float(n) for n in materials[name][1:9]] == list(PRINTED[name])


def test_every_code_is_there_once(materials):
    assert len({row[1] for row in materials.values()}) == len(materials)


def test_every_named_emissivity_file_is_generated_and_no_other(materials, folder):
    assert {path.name for path in folder.iterdir()} == {row[9] for row in materials.values()}


def test_new_asphalt_is_the_printed_sample(folder):
    values = read_emissivity(folder / "new_asphalt.ems")
    printed = slice(column(1250), column(750) + 1)
    outside = numpy.delete(values, numpy.r_[printed], axis=1)

    assert (values[0, printed] == 0.961).all()
    assert (values[90, printed] == 0.0).all()
    assert (outside == 1.0).all()


def test_all_values_lie_between_0_and_1_and_measured_ranges_end_at_0(folder):
    for path in folder.iterdir():
        values = read_emissivity(path)
        measured = values[45] != 1.0
        assert values.min() >= 0.0 and values.max() <= 1.0, path.name
        assert (values[90, measured] == 0.0).all(), path.name
        assert (values[:, ~measured] == 1.0).all(), path.name


def test_the_smooth_function_is_fresnel_for_an_index_of_1_5(generator):
    # Closed form: 1 - ((n - 1)/(n + 1))^2 at the normal; at 80 degrees mean of both polarisations.
    angles = numpy.array([0, 80])

    assert generator.dielectric(0.96, angles) == pytest.approx([0.96, 0.612296], abs=1e-6)


def test_the_rough_function_is_flat_to_60_degrees_and_ends_at_0(generator):
    values = generator.rough(0.9, numpy.arange(91))

    assert (values[:61] == 0.9).all()
    assert (numpy.diff(values[60:]) < 0).all() and values[90] == 0.0
