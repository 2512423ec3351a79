import numpy as np
import pytest
import records
from records import DIFFUSE, MISSED, NO_VALUE, NONE, SPECULAR_BACKGROUND, SPECULAR_SKY

NAMES = ["material", "background_material", "sunlit", "background_sunlit", "temperature_c",
         "background_temperature_c", "interaction", "view_angle_deg", "shape_factor", "range_m",
         "facet"]
DULL, MIRROR = 0, 1
GROUND = 3  # behind the three real facets


def look_down(columns):
    """From 100 m up straight down, with 1 m between pixels; pixel (0, 0) is straight below."""
    camera = np.zeros(1, records.CAMERA)
    camera["position"], camera["corner"] = (0, 0, 100), (-0.5, 0.5, -100)
    camera["across"], camera["down"] = (1, 0, 0), (0, -1, 0)
    frame = np.zeros(1, records.RADIOMETRY)
    frame["columns"] = columns
    return frame, camera


def scene():
    facets, materials = np.zeros(4, records.FACET), np.zeros(2, records.MATERIAL)
    facets["material"] = (DULL, MIRROR, DULL, DULL)
    materials["number"], materials["specular_share"] = (22, 34), (0, 1)
    ids = np.array([17, 1 << 24, 17, NONE], np.uint32)
    return facets, ids, materials, np.float32([273.15, 300.0, 250.0, 310.0])


def run(opencl, hit, background, sunlit, background_sunlit, *, columns=8, first=0):
    """The planes by name."""
    frame, camera = look_down(columns)
    frame["first_pixel"], frame["pixel_count"] = first, len(hit)
    facets, ids, materials, facet_k = scene()
    kelvin = np.where(hit["facet"] == NONE, 0, facet_k[hit["facet"] % len(facet_k)])
    planes = np.empty((records.TRUTH_PLANES, len(hit)), np.float32)
    opencl.run("truth", (64,), frame=frame, camera=camera,
               surface={"facets": facets, "materials": materials, "facet_temperature_k": facet_k},
               facet_id=ids,
               pixel={"hit": hit, "background": background, "temperature_k": np.float32(kelvin),
                      "sunlit": np.float32(sunlit), "background_sunlit": np.float32(background_sunlit)},
               planes=planes)
    return dict(zip(NAMES, planes))


def one(opencl, facet, background=None, **how):
    """A level target straight below at 100 m. background: fields of its record."""
    hit, behind = np.zeros(1, records.HIT), np.zeros(1, records.BACKGROUND)
    hit[0] = ((0, 0, 0), 100.0, facet, (0, 0, 1))
    behind["shape_factor"], behind["facet"], behind["material"] = 1.0, NONE, NONE
    for name, value in (background or {}).items():
        behind[name] = value
    return {k: v[0] for k, v in run(opencl, hit, behind, [0.75], [0.25], **how).items()}


BEHIND = {"facet": 2, "material": MIRROR, "shape_factor": 0.6, "mean_temperature_k": 283.15}


def test_a_diffuse_target_before_a_background_has_every_value(opencl):
    planes = one(opencl, 0, BEHIND)

    assert planes == pytest.approx({
        "material": 22, "background_material": 34, "sunlit": 0.75, "background_sunlit": 0.25,
        "temperature_c": 0, "background_temperature_c": 10, "interaction": DIFFUSE,
        "view_angle_deg": 0, "shape_factor": 0.6, "range_m": 100, "facet": 17},
        abs=2e-5)  # a float32 at 283 K


def test_a_missed_ray_has_no_value_but_its_interaction(opencl):
    planes = one(opencl, NONE, BEHIND)

    assert planes.pop("interaction") == MISSED
    assert all(value == NO_VALUE for value in planes.values())


def test_a_target_alone_under_the_sky_has_no_value_for_its_background(opencl):
    planes = one(opencl, 0)

    behind = {name: planes[name] for name in planes if name.startswith("background")}
    assert len(behind) == 3 and all(value == NO_VALUE for value in behind.values())
    assert planes["shape_factor"] == 1 and planes["interaction"] == DIFFUSE


@pytest.mark.parametrize("background, interaction", [
    (None, SPECULAR_SKY), (dict(BEHIND, shape_factor=0), SPECULAR_BACKGROUND)])
def test_a_mirror_sees_the_sky_or_a_background(opencl, background, interaction):
    assert one(opencl, 1, background)["interaction"] == interaction


def test_the_highest_facet_id_is_kept(opencl):
    assert one(opencl, 1)["facet"] == 1 << 24


def test_the_ground_plane_has_a_material_and_no_facet(opencl):
    planes = one(opencl, GROUND)

    assert planes["facet"] == NO_VALUE
    assert planes["material"] == 22
    assert planes["temperature_c"] == pytest.approx(36.85, abs=2e-5)


def test_the_view_angle_is_that_of_the_pixel_s_ray(opencl):
    hit, behind = np.zeros(24, records.HIT), np.zeros(24, records.BACKGROUND)
    hit["normal"] = (0, 0, 1)
    behind["facet"] = NONE

    planes = run(opencl, hit, behind, np.ones(24), np.ones(24), columns=8, first=16)

    column, row = np.arange(24) % 8, 2 + np.arange(24) // 8
    # acos of a float32 cosine near 1: .02 degree at 0, less beside it.
    assert planes["view_angle_deg"] == pytest.approx(
        np.degrees(np.arctan(np.hypot(column, row) / 100)), abs=5e-3)
