"""The clouds over fields: closed bodies, their shadows, and what they look like."""
import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLOUD = ROOT / "scenes" / "cloud"

sys.path.append(str(ROOT / "tests" / "cli"))
import envi  # noqa: E402


@pytest.fixture(scope="module")
def meshes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cloud")
    subprocess.run([sys.executable, CLOUD / "make_geometry.py", folder], check=True)
    return folder


def read(path):
    lines = [line.split() for line in path.read_text().splitlines()]
    vertex = np.array([line[1:] for line in lines if line[0] == "v"], float)
    return vertex, [[int(i) - 1 for i in line[1:]] for line in lines if line[0] == "f"]


@pytest.mark.parametrize("name, half_m", [("cumulus", (280, 200, 90)), ("veil", (220, 160, 40))])
def test_clouds_are_closed_ellipsoids_that_face_outwards(meshes, name, half_m):
    vertex, faces = read(meshes / f"{name}.obj")
    edges = [(f[i - 1], f[i]) for f in faces for i in range(len(f))]
    volume = sum(np.dot(vertex[f[0]], np.cross(vertex[f[i]], vertex[f[i + 1]]))
                 for f in faces for i in range(1, len(f) - 1)) / 6

    assert len(set(edges)) == len(edges)
    assert {(b, a) for a, b in edges} == set(edges)
    # 24 rings and 48 sectors lie inside the ellipsoid by 1 %.
    assert volume == pytest.approx(4 / 3 * np.pi * np.prod(half_m), rel=.02)


@pytest.fixture(scope="module")
def planes(tmp_path_factory):
    out = tmp_path_factory.mktemp("render")
    subprocess.run([ROOT / "build/radsig", "render", CLOUD / "scene.toml", "-o", out, "--size",
                    "160x120"], check=True)
    assert json.loads((out / "cloud.json").read_text())
    return {**envi.read(out / "cloud")[1], **envi.read(out / "cloud_truth")[1]}


def test_the_shadows_of_the_clouds_are_as_dark_as_the_clouds_are_thick(planes):
    sunlit = planes["sunlit"]

    assert sunlit.min() < 1e-6  # 180 m of 87 per km
    of_veil = sunlit[85:]  # the cumulus and its shadow are further up
    # The sun is 37.15 degrees from the zenith; the longest chord of the ellipsoid so inclined:
    slant = np.radians(37.15)
    chord = 2 / np.sqrt((np.sin(slant) / 220) ** 2 + (np.cos(slant) / 40) ** 2)
    assert np.nanmin(of_veil) == pytest.approx(np.exp(-.008 * chord), abs=.03)  # sun 14 degrees off the axis


def test_ground_in_a_cloud_s_shadow_is_cooler(planes):
    soil = planes["material"] == 30

    shaded = planes["temperature_c"][soil & (planes["sunlit"] < .01)]
    clear = planes["temperature_c"][soil & (planes["sunlit"] == 1)]

    assert shaded.size > 10 and shaded.max() < np.median(clear) - .5


def test_the_dense_cloud_looks_colder_than_the_ground_and_than_its_own_air(planes):
    coldest = planes["apparent_temperature_lwir_c"].min()

    # The database's air has 16.55 C at 1000 m; colder air lies between there and the sensor.
    assert 10 < coldest < 16.55
    assert coldest < np.median(planes["apparent_temperature_lwir_c"]) - .5


def test_in_the_visible_the_dense_cloud_is_white_and_its_shadow_lies_away_from_the_sun(planes):
    radiance, grass = planes["radiance_vis"], planes["material"] == 4

    white = np.argwhere(radiance > 3 * np.median(radiance))
    shadow = np.argwhere(planes["sunlit"] < .01)

    assert len(white) > 100
    # Some 1000 W m-2 um-1 over .25 um, of which 16 in optical thickness sends back about .6.
    assert radiance.max() == pytest.approx(.6 * 1000 * .25 / np.pi, rel=.2)
    # The morning sun stands in the east, right in the picture; the cloud looks 800 m further back.
    assert np.median(shadow[:, 1]) < np.median(white[:, 1]) - 20
    # Soil is black in the visible: what is seen there is the air.
    of_grass = radiance - np.median(radiance[planes["material"] == 30])
    shaded, lit = (np.median(of_grass[grass & at]) for at in (planes["sunlit"] < .01, planes["sunlit"] == 1))
    assert shaded < .6 * lit
