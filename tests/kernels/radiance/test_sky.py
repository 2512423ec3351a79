import numpy as np
import probe
import pytest
from radiometry_reference import unit

ZENITHS, AZIMUTHS, SAMPLES = 7, 13, 3


@pytest.fixture(scope="module")
def table():
    """Random radiance; azimuth 360 is azimuth 0, and the zenith has no azimuth."""
    table = np.random.default_rng(11).uniform(0, 10, (ZENITHS, AZIMUTHS, SAMPLES))
    table[0] = table[0, :1]
    table[:, -1] = table[:, 0]
    return table.astype(np.float32)


def look(opencl, table, direction):
    """Radiance in directions (n, 3), shape (n, samples)."""
    zeniths, azimuths, count = table.shape
    frame = (f"radiometry_record f = {{0}}; f.sample_count = {count}; f.zenith_count = {zeniths};"
             f"f.azimuth_count = {azimuths};"
             f"f.zenith_step_deg = {90 / max(zeniths - 1, 1)}f;"
             f"f.azimuth_step_deg = {360 / max(azimuths - 1, 1)}f;")
    body = (frame + "const sky_lookup at = sky_find(f, in0[i], in1[i], in2[i]);"
            f"for (int k = 0; k < {count}; k++) out[k] = sky_radiance(in3, f, at, k);")
    x, y, z = np.atleast_2d(direction).T
    return probe.probe(opencl, "sky.h", body, [x, y, z, table.ravel()], count,
                       "-DSPECTRUM_WIDTH=1").T


def towards(zenith_deg, azimuth_deg):
    zenith, azimuth = np.radians(zenith_deg), np.radians(azimuth_deg)
    return np.stack(np.broadcast_arrays(np.sin(zenith) * np.sin(azimuth),
                                        np.sin(zenith) * np.cos(azimuth), np.cos(zenith)), -1)


def bilinear(table, zenith_deg, azimuth_deg):
    """eq. 2.4.1-1 to 2.4.1-3: along the zenith at both azimuths, then along the azimuth."""
    a, b = zenith_deg // 15, azimuth_deg // 30
    a, b = np.minimum(a, ZENITHS - 2).astype(int), np.minimum(b, AZIMUTHS - 2).astype(int)
    along = ((zenith_deg - 15 * a) / 15)[:, None]
    first = table[a, b] + along * (table[a + 1, b] - table[a, b])
    second = table[a, b + 1] + along * (table[a + 1, b + 1] - table[a, b + 1])
    return first + ((azimuth_deg - 30 * b) / 30)[:, None] * (second - first)


def test_directions_are_bilinear_between_the_table_s(opencl, table):
    random = np.random.default_rng(12)
    zenith, azimuth = random.uniform(1, 90, 2000), random.uniform(0, 360, 2000)

    radiance = look(opencl, table, towards(zenith, azimuth))

    # acos of a float32 cosine near 1 errs by .001 degree at 1 degree; steps are up to 10 per 15.
    assert abs(radiance - bilinear(table.astype(float), zenith, azimuth)).max() < 2e-3
    steep = zenith > 15
    assert abs(radiance - bilinear(table.astype(float), zenith, azimuth))[steep].max() < 1e-4


@pytest.mark.parametrize("direction, azimuth_deg", [
    ((0, 1, 0), 0), ((1, 0, 0), 90), ((0, -1, 0), 180), ((-1, 0, 0), 270)])
def test_azimuths_run_clockwise_from_north(opencl, table, direction, azimuth_deg):
    radiance = look(opencl, table, direction)[0]

    assert radiance == pytest.approx(table[-1, azimuth_deg // 30], abs=1e-5)  # roundings of 10


def test_the_sky_closes_at_north(opencl, table):
    west, east = look(opencl, table, towards(60.0, np.array([359.99999, 0.00001])))

    assert west == pytest.approx(east, abs=1e-5)
    assert east == pytest.approx(table[4, 0], abs=1e-5)


def test_a_direction_below_the_horizon_has_the_horizon_s_radiance(opencl, table):
    azimuth = np.array([10.0, 130.0, 250.0])

    below = look(opencl, table, towards(np.array([91.0, 120.0, 179.0]), azimuth))

    expected = bilinear(table.astype(float), np.full(3, 90.0), azimuth)
    assert below == pytest.approx(expected, abs=5e-3)  # 179 degrees: azimuth of a short float32


def test_straight_up_is_the_zenith(opencl, table):
    assert look(opencl, table, (0, 0, 1))[0] == pytest.approx(table[0, 0])


def test_a_sky_of_one_direction_is_the_same_everywhere(opencl):
    one = np.array([[[1.5, 2.5, 3.5]]], np.float32)
    directions = unit(np.random.default_rng(13).normal(size=(50, 3)))

    assert np.all(look(opencl, one, directions) == one[0])
