"""radsig-atmosphere cloud: extinction of LOWTRAN's clouds."""

import numpy
import pytest


@pytest.fixture(scope="module")
def clouds(atmosphere, tmp_path_factory):
    folder = tmp_path_factory.mktemp("clouds")

    def read(name):
        atmosphere("cloud", name, "-o", folder / f"{name}.ext")
        lines = [line for line in open(folder / f"{name}.ext") if not line.startswith("#")]
        scattering = numpy.loadtxt(folder / f"{name}.scattering.csv", delimiter=",", skiprows=0, comments=("#", "w"))
        return float(lines[0]), numpy.array([[float(x) for x in line.split()] for line in lines[1:]]), scattering

    return {name: read(name) for name in ("cumulus", "altostratus", "stratus", "stratocumulus", "nimbostratus")}


# Layer depth over LOWTRAN's own optical depth of each cloud, per km, by another driver and method:
# 39850, 12350 and 950 cm-1
@pytest.mark.parametrize("name, ultraviolet, thermal", [
    ("cumulus", 84.59, 86.7), ("altostratus", 75.33, None), ("stratus", 40.15, None),
    ("stratocumulus", 30.96, None), ("nimbostratus", 64.57, None),
])
def test_the_extinction_is_the_layer_s_mean(clouds, name, ultraviolet, thermal):
    broad, rows, _ = clouds[name]

    assert rows.shape == (396, 2) and numpy.isfinite(rows).all() and (rows[:, 1] > 0).all()
    assert rows[0] == pytest.approx([39850, ultraviolet], rel=0.01)  # slices of 2 % of the layer
    if thermal:
        assert rows[rows[:, 0] == 950][0, 1] == pytest.approx(thermal, rel=0.01)
    inside = rows[(rows[:, 0] >= 4000) & (rows[:, 0] <= 25000), 1]
    assert inside.min() < broad < inside.max()


def test_droplets_scatter_light_and_absorb_heat(clouds):
    # LOWTRAN's EXTDTA, cumulus: absorption .55414 of 1.1516 at 6 um, none at .55 um, asymmetry .8658 there
    rows = clouds["cumulus"][2]
    visible = rows[numpy.argmin(abs(1e4 / rows[:, 0] - 0.55))]

    assert visible[1] == pytest.approx(1.0, abs=1e-4)
    assert visible[2] == pytest.approx(0.8658, abs=2e-4)
    at_6_um = rows[numpy.argmin(abs(1e4 / rows[:, 0] - 6.0))]
    assert at_6_um[1] == pytest.approx(1 - 0.55428 / 1.1542, abs=0.01)  # 1650 cm-1 is 6.06 um


def test_an_unknown_cloud_is_refused(atmosphere, tmp_path):
    assert "cirrus" in atmosphere("cloud", "cirrus", "-o", tmp_path / "x.ext", code=2).stderr
