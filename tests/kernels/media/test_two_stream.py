"""Light in scattering layers, against collocation of the two streams' equations, limits and photons."""
import itertools

import numpy as np
import probe
import pytest
from cloud_reference import two_streams

FLUXES = """
const cloud_layer l = cloud_solve(in0[i], in1[i], in2[i], in3[i]);
out[0] = l.diffuse_back; out[1] = l.diffuse_through; out[2] = l.sun_back; out[3] = l.sun_through;
"""
SOURCE = """
const cloud_light light = {in5[i], in6[i], in7[i]};
out[0] = cloud_source(in0[i], in1[i], in2[i], in4[i], light, in3[i], 1u);
out[1] = cloud_source(in0[i], in1[i], in2[i], in4[i], light, in3[i], 0u);
"""


def fluxes(opencl, *rows):
    """Shape (4, cases): diffuse back, through, sun back, through without its direct part."""
    return probe.probe(opencl, "cloud.h", FLUXES, np.broadcast_arrays(*map(np.atleast_1d, rows)), 4,
                       "-DSPECTRUM_WIDTH=1").astype(float)


def sources(opencl, *rows):
    """Shape (2, cases): from above, from below. Arguments: depth, albedo, asymmetry, sun_up,
    black body, sun, sky, ground."""
    return probe.probe(opencl, "cloud.h", SOURCE, np.broadcast_arrays(*map(np.atleast_1d, rows)), 2,
                       "-DSPECTRUM_WIDTH=1").astype(float)


GRID = [case for case in itertools.product((.05, 1, 16, 100), (.3, .9, .999, 1), (0, .5, .87), (.1, .5, 1))]


def test_fluxes_solve_the_equations_of_the_two_streams(opencl):
    expected = np.array([two_streams(*case) for case in GRID]).T

    got = fluxes(opencl, *np.array(GRID).T)

    # float32: exp of up to 100 / .1 and differences of 1; an albedo of .999 is off by 3e-5 of .001
    assert got == pytest.approx(expected, abs=2e-4)


def test_where_the_formula_is_0_by_0_fluxes_are_those_beside(opencl):
    mu = 1 / np.sqrt(.4 * (.4 + 2 * .75 * .8))  # the eigenvalue of albedo .8, asymmetry 0

    got = fluxes(opencl, 3, .8, 0, np.array([mu - .01, mu, mu + .01]))

    assert got[2:, 1] == pytest.approx(got[2:, [0, 2]].mean(1), abs=2e-4)  # mu is .001 off there


def test_what_absorbs_nothing_sends_all_light_back_or_through(opencl):
    depth, asymmetry, mu = (np.ravel(v) for v in np.meshgrid([.01, .5, 4, 30, 300], [0, .5, .87], [.05, .4, 1]))

    back, through, sun_back, sun_through = fluxes(opencl, depth, 1, asymmetry, mu)

    assert back + through == pytest.approx(1, abs=1e-5)
    assert sun_back + sun_through + np.exp(-depth / mu) == pytest.approx(1, abs=2e-5)


def test_what_scatters_nothing_radiates_as_a_black_body(opencl):
    depth = np.array([1e-4, .1, 1, 10, 100])

    got = sources(opencl, depth, 0, .8, .7, 9, 500, 30, 60)

    # 1 - exp(-2 depth) of .002 at the least: float32 rounds 60 and 500 by 4e-6 and 3e-5 of it
    assert got == pytest.approx(9, rel=2e-3)
    assert got[:, 1:] == pytest.approx(9, rel=1e-5)


def test_a_layer_is_invisible_where_all_has_its_temperature(opencl):
    depth, albedo, asymmetry = (np.ravel(v) for v in np.meshgrid([1e-5, .1, 3, 90], [.2, .9, 1], [0, .86]))

    got = sources(opencl, depth, albedo, asymmetry, .7, 5, 0, 5, 5)

    assert got == pytest.approx(5, rel=1e-4)  # float32, 1 - exp(-2 depth) of .002


@pytest.mark.parametrize("sun_up", [.2, .9])
def test_a_thin_layer_scatters_once(opencl, sun_up):
    """Its source is albedo times the mean of what comes from all sides: half sky, half ground, and
    the sun by the phase function's fraction upwards or downwards, as far as it leaves the forward peak."""
    g, albedo = .8, .9
    back = (2 - 3 * g / (1 + g) * sun_up) / 4
    peak = g * g

    sun = sources(opencl, 1e-4, albedo, g, sun_up, 0, 100, 0, 0)[:, 0]

    up = albedo * (1 - peak) * back * 100 / (2 * np.pi)
    down = albedo * ((1 - peak) * (1 - back) + peak) * 100 / (2 * np.pi)
    assert sun == pytest.approx([up, down], rel=1e-2)  # depth .001 taken for 0, and its float32


def test_without_sun_there_is_no_sunlight(opencl):
    assert sources(opencl, 5, 1, .8, -.1, 0, 100, 0, 0) == pytest.approx(0)


def photons(depth, asymmetry, mu, count, random):
    """Share of the sun that a layer without absorption sends back; Henyey-Greenstein."""
    z, cosine = np.zeros(count), np.full(count, mu)
    alive, back = np.ones(count, bool), 0
    while alive.any():
        z[alive] += cosine[alive] * random.exponential(size=alive.sum())
        back += (alive & (z < 0)).sum()
        alive &= (z > 0) & (z < depth)
        u = random.random(alive.sum())
        s = (1 - asymmetry**2) / (1 - asymmetry + 2 * asymmetry * u)
        turn = (1 + asymmetry**2 - s**2) / (2 * asymmetry)
        about = np.cos(2 * np.pi * random.random(alive.sum()))
        old = cosine[alive]
        cosine[alive] = old * turn + np.sqrt(np.maximum(0, (1 - old**2) * (1 - turn**2))) * about
    return back / count


@pytest.mark.parametrize("depth, mu", [(1, .9), (4, .8), (16, .8), (16, .3), (60, .6)])
def test_clouds_are_as_white_as_photons_find_them(opencl, depth, mu):
    expected = photons(depth, .86, mu, 40000, np.random.default_rng(3))

    back = fluxes(opencl, depth, 1, .86, mu)[2, 0]

    # Two streams err by that much; the photons by .0025.
    assert back == pytest.approx(expected, abs=.03)
