"""The clouds over fields: closed bodies, their shadows, and what they look like."""
import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest
import envi

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLOUD = ROOT / "scenes" / "cloud"


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


def render(out, name):
    subprocess.run([ROOT / "build/radsig", "render", CLOUD / f"{name}.toml", "-o", out, "--size",
                    "160x120"], check=True)
    stem = {"scene": "cloud"}.get(name, name)
    assert json.loads((out / f"{stem}.json").read_text())
    return {**envi.read(out / stem)[1], **envi.read(out / f"{stem}_truth")[1]}


@pytest.fixture(scope="module")
def planes(tmp_path_factory):
    return render(tmp_path_factory.mktemp("render"), "scene")


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


@pytest.fixture(scope="module")
def level(tmp_path_factory):
    return render(tmp_path_factory.mktemp("level"), "level")


def test_from_the_ground_the_horizon_lies_where_the_camera_s_tilt_puts_it(level):
    sky = level["interaction"] == 0

    # The camera looks up by the angle whose tangent is 248 / hypot(300, 1800); 24 mm, 36 mm wide.
    horizon = 60 + 248 / np.hypot(300, 1800) * 24 / 36 * 160
    assert sky[:int(horizon)].all() and not sky[int(horizon) + 1:].any()


def test_from_the_ground_the_sky_grows_warmer_and_brighter_towards_the_horizon(level):
    column = slice(80, 88)  # between the clouds

    warmth = level["apparent_temperature_lwir_c"][:74, column].mean(1)
    light = level["radiance_vis"][:74, column].mean(1)
    assert (np.diff(warmth) > 0).all() and warmth[-1] > warmth[0] + 25
    assert light[-1] > 1.2 * light[0]


def test_from_the_ground_clouds_are_warmer_than_the_sky_behind_them(level):
    warmth = level["apparent_temperature_lwir_c"]

    # Both at about the air's temperature at their height, 16.5 C at 1000 m and 20 C at 400 m.
    for row, column in (25, 102), (37, 57):
        assert 10 < warmth[row, column] < 22
        assert warmth[row, column] > warmth[row, 140] + 5
