
import numpy as np
import pytest
import records
from ray_world import NONE, RayWorld, points
from records import NO_VALUE

import cases

SLOTS, WORDS = 96, 3
UP = (0, 0, 1)


def a_day(nearest=0, since_min=0.0):
    day = np.zeros(1, records.SUN_DAY)
    day[0] = (SLOTS, WORDS, nearest, since_min, 15.0, WORDS, (0, 0))
    return day


def suns(elevation_deg):
    """Once round the horizon in a day, at a height for each slot; by night below it."""
    azimuth = np.radians(np.arange(SLOTS) * 360 / SLOTS)
    height = np.radians(np.broadcast_to(elevation_deg, SLOTS))
    sun = np.zeros((SLOTS, 4), np.float32)
    sun[:, 0], sun[:, 1] = np.cos(height) * np.sin(azimuth), np.cos(height) * np.cos(azimuth)
    sun[:, 2] = np.sin(height)
    return sun


def tower(opencl):
    """A level plane and a tower one metre wide and ten metres high at the origin."""
    return RayWorld(opencl, cases.join(cases.plane(50.0), cases.box((-.5, -.5, 0), (.5, .5, 10))))


def trace(opencl, world, sun, hits, normal=UP, two_sided=0, order=None, options=""):
    """Shape (points, slots); all points are of one facet record, the ground's among them."""
    facets = np.zeros(world.facet_count + 1, records.FACET)
    facets["normal"], facets["two_sided"] = normal, two_sided
    words = np.zeros((len(hits), WORDS), np.uint32)
    opencl.run("sun_history", (-(-len(hits) // world.bundle()), WORDS),
               options=f"-DRAY_LANES={world.lanes} {options}", count=len(hits), day=a_day(),
               tree=world.tree, facets=facets, sun=sun, hit=hits, order=order, lit=words)
    return (words[:, :, None] >> np.arange(32) & 1).reshape(len(hits), -1)


def times(opencl, lit, nearest, since_min=0.0, met=True):
    """Hours lit and minutes since the sun came or went; lit: (slots)."""
    words = np.packbits(lit.reshape(WORDS, 32), bitorder="little").view(np.uint32)
    hits = points((0, 0, 0), UP)
    hits["facet"] = 0 if met else NONE
    out = np.empty(2, np.float32)
    opencl.run("sun_times", (1,), count=1, first_plane=0, day=a_day(nearest, since_min), hit=hits,
               lit=words, planes=out)
    return out


def test_a_tower_hides_the_sun_while_the_sun_is_behind_it(opencl):
    lit = trace(opencl, tower(opencl), suns(30.0), points((0, 5.5, 0), UP))[0]

    # Seen from 5 m before its face, a metre of tower spans 5.7 degrees on either side of south;
    # slots are 3.75 degrees apart, south is slot 48.
    assert list(np.flatnonzero(lit == 0)) == [47, 48, 49]


def test_every_step_is_what_the_sun_of_that_step_alone_tells(opencl):
    world, sun = tower(opencl), suns(20 + 50 * np.sin(np.arange(SLOTS) / 9))
    random = np.random.default_rng(3)
    hits = points(np.c_[random.uniform(-15, 15, (200, 2)), np.zeros(200)], UP)

    lit = trace(opencl, world, sun, hits)

    assert lit.any() and not lit[:, sun[:, 2] > 0].all()
    for slot in range(SLOTS):
        assert (lit[:, slot] == world.sunlight(sun[slot, :3], hits)).all()


def test_packets_and_single_rays_tell_the_same(opencl):
    packets, single = tower(opencl), tower(opencl)
    single.lanes = 1
    random = np.random.default_rng(4)
    hits = points(np.c_[random.uniform(-15, 15, (203, 2)), np.zeros(203)], UP)

    assert (trace(opencl, packets, suns(40.0), hits)
            == trace(opencl, single, suns(40.0), hits)).all()


@pytest.mark.parametrize("spread_m", [15.0, 1.0])
@pytest.mark.parametrize("two_sided", [0, 1])
def test_beams_and_single_rays_tell_the_same(opencl, spread_m, two_sided):
    """Above a heap of triangles, of which a beam of far points meets more than it lists."""
    random = np.random.default_rng(4)
    place = np.c_[random.uniform(4, 4 + spread_m, (203, 2)), random.uniform(-1, 1, 203)]
    hits = points(place, (0.6, 0, 0.8))
    hits["facet"][::9] = NONE
    world = RayWorld(opencl, cases.triangle_soup(3000, seed=3))
    lit = []
    for world.lanes, options in ((16, ""), (16, "-DRAY_PORTABLE"), (1, "")):
        lit.append(trace(opencl, world, suns(20.0), hits, (0.6, 0, 0.8), two_sided,
                         options=options))

    assert 0.1 < lit[2].mean() < 0.9
    assert (lit[0] == lit[2]).all() and (lit[1] == lit[2]).all()


def test_the_order_of_points_changes_no_bit(opencl):
    random = np.random.default_rng(6)
    hits = points(np.c_[random.uniform(-15, 15, (203, 2)), np.zeros(203)], UP)
    order = random.permutation(203).astype(np.uint32)

    assert (trace(opencl, tower(opencl), suns(40.0), hits, order=order)
            == trace(opencl, tower(opencl), suns(40.0), hits)).all()


def test_no_sun_shines_at_night_or_on_a_missed_pixel(opencl):
    hits = points([(20, 20, 0), (20, 20, 0)], UP)
    hits["facet"][1] = NONE
    sun = suns(30.0)
    sun[10, 2] = 0

    lit = trace(opencl, tower(opencl), sun, hits)

    assert lit[0, 10] == 0 and lit[0].sum() == SLOTS - 1 and lit[1].sum() == 0


def test_a_facet_seen_from_behind_is_lit_from_its_front(opencl):
    """The tower's east face, met by a ray from within: its normal is turned towards that ray."""
    hits = points((.5, 0, 5), (-1, 0, 0))

    lit = trace(opencl, tower(opencl), suns(30.0), hits, normal=(1, 0, 0))[0]

    assert lit[1:48].all() and not lit[49:].any()  # at slots 0 and 48 the sun is edge on


def test_a_two_sided_facet_is_lit_from_either_side(opencl):
    world = RayWorld(opencl, cases.plane(50.0))
    hits = points((0, 0, 20), (1, 0, 0))  # a sheet in the air, no ray meets it

    one = trace(opencl, world, suns(30.0), hits, normal=(1, 0, 0))[0]
    two = trace(opencl, world, suns(30.0), hits, normal=(1, 0, 0), two_sided=1)[0]

    assert one[1:48].all() and not one[49:].any()  # at slots 0 and 48 the sun is edge on
    assert two[1:48].all() and two[49:].all()


def test_the_ground_plane_is_never_in_shadow(opencl):
    world = tower(opencl)
    world.world["ground_facet"] = world.facet_count
    hits = points((0, 5.5, 0), UP)
    hits["facet"] = world.facet_count

    assert trace(opencl, world, suns(30.0), hits)[0].all()


def test_lit_steps_add_up_to_hours(opencl):
    lit = np.zeros(SLOTS, np.uint8)
    lit[20:60] = 1

    assert times(opencl, lit, nearest=70)[0] == 10.0


@pytest.mark.parametrize("nearest, since_min, expected", [
    (65, 0, 5.5 * 15),      # the sun went between slots 59 and 60
    (65, 4, 5.5 * 15 + 4),  # and four minutes more have passed
    (30, -7, 10.5 * 15 - 7),
    (10, 0, 46.5 * 15)])    # the evening before
def test_the_sun_came_or_went_midway_between_two_steps(opencl, nearest, since_min, expected):
    lit = np.zeros(SLOTS, np.uint8)
    lit[20:60] = 1

    assert times(opencl, lit, nearest, since_min)[1] == expected


@pytest.mark.parametrize("value, met", [(0, True), (1, True), (1, False)])
def test_without_a_change_there_is_no_time_of_it(opencl, value, met):
    hours, minutes = times(opencl, np.full(SLOTS, value, np.uint8), 5, met=met)

    assert minutes == NO_VALUE
    assert hours == (24.0 * value if met else NO_VALUE)
