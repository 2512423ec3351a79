import copy
import types

import numpy as np
import probe
import pytest
import radiometry_reference as reference
import records
from radiometry_reference import Case, Reference, planck
from records import DIFFUSE, MISSED, SPECULAR_BACKGROUND, SPECULAR_SKY

COUNT = 400
# 16 pixels a work-item and 16 samples at once, as on CPUs; single samples, the scalar twin; a pixel alone,
# as on GPUs.
WIDTHS = ["", "-DSPECTRUM_WIDTH=1", "-DRAY_LANES=1"]
# float32: Planck's exponent of up to 60 at .8 um costs 60 roundings of 6e-8, angles from acos near 1
# err by .02 degree, where the tables change by less than .001 of the whole.
BOUND = 2e-5


def ln_table(wavelength_um, weight):
    """Rows of ln of the radiance in band, and the temperatures, as kernels/records.h lays them out."""
    kelvin = records.BAND_LOWEST_K * (records.BAND_HIGHEST_K / records.BAND_LOWEST_K) ** (
        np.arange(records.BAND_TEMPERATURES) / (records.BAND_TEMPERATURES - 1))
    used = weight > 0
    x = reference.SECOND / (wavelength_um[used] * kelvin[:, None])
    terms = np.log(weight[used] * reference.FIRST / wavelength_um[used] ** 5) - x
    return kelvin, np.logaddexp.reduce(terms - np.log1p(-np.exp(-x)), axis=1)


def tables_of(opencl, case):
    """What band_planes looks up: mean emissivities, and ln of radiances."""
    own = [ln_table(case.wavelength_um[at], weight)[1] for at, weight in map(case.of_band, case.bands)]
    emissivity = np.empty((len(case.emissivity), len(case.bands)), np.float32)
    opencl.run("band_emissivity", emissivity.shape[::-1], sample_count=len(case.weight),
               band_count=len(case.bands), bands=case.bands, weights=case.weights,
               emissivity=case.emissivity, band_emissivity=emissivity)
    return emissivity, np.array(own, np.float32)


def run(opencl, case, options="", groups=None):
    """Planes of shape (bands, wanted planes, pixels); `groups` pixels' groups a launch, else all."""
    pixels, wants = len(case.hit), int(case.frame["wants"][0])
    all_groups = -(-pixels // records.PIXEL_GROUP)
    row = all_groups * records.PIXEL_GROUP
    emissivity, ln_radiance = tables_of(opencl, case)
    terms = {"emissivities": np.zeros((row, 2), records.EMISSIVITY),
             "terms": np.zeros((7, row, len(case.weight)), np.float32)}
    planes = np.zeros((len(case.bands), bin(wants).count("1"), row), np.float32)
    frame = case.frame.copy()
    is_alone = options == "-DRAY_LANES=1"
    for first in range(0, all_groups, groups or all_groups):
        frame["first_group"] = first
        size = (min(groups or all_groups, all_groups - first) * (records.PIXEL_GROUP if is_alone else 1),)
        opencl.run("radiometry", size, options=options, frame=frame, air=case.air, camera=case.camera,
                   **case.tables(), **terms)
        opencl.run("band_planes", size, options=options if is_alone else "", frame=frame, bands=case.bands, weights=case.weights,
                   band_emissivity=emissivity, ln_radiance=ln_radiance, planes=planes, **terms)
    return planes[..., :pixels]


@pytest.fixture(scope="module", params=[
    (0, False), (1, False), (0, True), (1, True), (0, True, "altitude"), (0, True, "range"),
    (0, False, "altitude range"), (1, True, "altitude range")],
    ids=["exact", "thesis", "exact with bodies", "thesis with bodies", "bodies among altitudes",
         "bodies among ranges", "altitudes, and ranges near level", "thesis takes no grids"])
def pixels(request):
    """Random pixels, what they are, and shape (pixels, bands, 3) of the reference's planes."""
    case = Case(4, COUNT, *request.param)
    kinds, planes = zip(*(Reference(case).planes(i) for i in range(COUNT)))
    return case, np.array(kinds), np.array(planes)


@pytest.mark.parametrize("options", WIDTHS)
@pytest.mark.parametrize("kind", [MISSED, DIFFUSE, SPECULAR_SKY, SPECULAR_BACKGROUND])
def test_radiance_equals_double_precision(opencl, pixels, kind, options):
    case, kinds, expected = pixels
    of_kind = kinds == kind

    planes = run(opencl, case, options)

    radiance = expected[of_kind, :, 0].T
    radiance[1] /= case.bands["width_um"][1]  # this band asks for its mean
    assert of_kind.sum() > 20
    assert planes[:, 0, of_kind] == pytest.approx(radiance, rel=BOUND)


@pytest.mark.parametrize("options", WIDTHS)
@pytest.mark.parametrize("plane", [3, 4], ids=["target", "background"])
def test_mean_emissivities_equal_double_precision(opencl, pixels, plane, options):
    case, _, expected = pixels

    planes = run(opencl, case, options)

    assert planes[:, plane] == pytest.approx(expected[:, :, plane - 2].T, rel=BOUND)


def test_counts_are_gain_times_radiance_in_band_and_offset(opencl, pixels):
    case, _, expected = pixels

    counts = run(opencl, case)[:, 1]

    gain, offset = case.bands["gain"][:, None], case.bands["offset"][:, None]
    assert counts == pytest.approx(gain * expected[:, :, 0].T + offset, rel=BOUND, abs=BOUND)


def test_apparent_temperature_is_that_of_the_black_body_with_the_same_radiance(opencl, pixels):
    case, _, expected = pixels

    celsius = run(opencl, case)[:, 2]

    for band, apparent, radiance in zip(case.bands, celsius, expected[:, :, 0].T):
        at, weight = case.of_band(band)
        wavelength = case.wavelength_um[at]
        black = (weight * planck(wavelength, 273.15 + apparent[:, None].astype(float))).sum(1)
        # The table's own step costs .001 K; 2e-5 of the radiance at 8-14 um is .001 K too.
        slope = (weight * planck(wavelength, 273.16 + apparent[:, None].astype(float))).sum(1)
        assert abs(black - radiance).max() < 0.4 * (slope - black).max()


def test_pixels_do_not_depend_on_tiles(opencl):
    case = Case(5, 100, 0)
    whole = run(opencl, case)

    part = copy.copy(case)
    part.frame = case.frame.copy()
    part.frame["first_pixel"] += 37
    part.frame["pixel_count"] = 30
    for name in ("hit", "background", "sunlit", "background_sunlit", "pixel_k", "incident"):
        setattr(part, name, getattr(case, name)[37:67])

    assert run(opencl, part).tobytes() == whole[..., 37:67].tobytes()


def test_pixels_do_not_depend_on_how_many_are_integrated_at_once(opencl):
    case = Case(5, 100, 0)

    assert run(opencl, case, groups=3).tobytes() == run(opencl, case).tobytes()


@pytest.mark.parametrize("wanted", [[0], [0, 2], [0, 1, 4], [0, 3, 7]])
def test_planes_do_not_depend_on_the_others_that_are_wanted(opencl, wanted):
    case = Case(5, 100, 1)
    case.frame["wants"] = records.ALL_PARTS
    expected = run(opencl, case)[:, wanted]

    case.frame["wants"] = sum(1 << plane for plane in wanted)

    assert run(opencl, case).tobytes() == expected.tobytes()


@pytest.mark.parametrize("options", WIDTHS)
@pytest.mark.parametrize("bodies", [False, True], ids=["clear", "bodies"])
@pytest.mark.parametrize("thesis", [0, 1], ids=["exact", "thesis"])
def test_parts_of_the_radiance_equal_double_precision_and_add_up(opencl, thesis, bodies, options):
    case = Case(6, 120, thesis, bodies)
    case.frame["wants"] = records.ALL_PARTS
    expected = np.array([Reference(case).part_planes(i) for i in range(120)]).transpose(1, 2, 0)

    planes = run(opencl, case, options)

    parts = planes[:, records.BAND_PARTS:records.BAND_PARTS + records.RADIANCE_PARTS]
    assert parts == pytest.approx(expected, rel=BOUND, abs=1e-12)
    assert parts[:, :5].sum(1) == pytest.approx(planes[:, 0], rel=2e-6)  # five float32 sums


# notes: monochromatic pixels computed by an independent script.
CLEAR = dict(tau1c=1, e_b=1, t_b=300, tau_sb=1, cos_b=0, tau_tb=1, t_tbe=300, tau2c=1, t_ste=300)
FOUR_PIXELS = {
    "diffuse at 10 um": dict(
        um=10, t_t=305, e_t=.93, e_s=.21, tau1=.70, cos_s=.80, f=.75, sky=1.902, e_b=.96, t_b=298,
        cos_b=.55, tau2=.62, path=2.403, expected=8.760984),
    "specular to the sky at 4 um": dict(
        um=4, t_t=300, e_t=.70, e_s=9.6, tau1=.85, tau1c=.5, cos_s=.60, f=1, sky=.42, tau2=.80,
        tau2c=.9, path=.07, t_ste=275, expected=.7171581),
    "specular to a background at 10 um": dict(
        um=10, t_t=290, e_t=.30, e_s=.21, tau1=.70, cos_s=.40, f=0, sky=0, e_b=.94, t_b=315,
        tau_sb=.8, cos_b=.30, tau_tb=.9, t_tbe=285, tau2=.62, path=2.403, expected=8.896212),
    "diffuse at .55 um": dict(
        um=.55, t_t=300, e_t=.60, e_s=1860, tau1=.62, cos_s=.75, f=.90, sky=55, e_b=.80, t_b=300,
        cos_b=.40, tau2=.78, path=18, expected=120.2558),
}
# Bodies of 100 m, whose transmission makes their extinction.
ONE_PIXEL = """
const float target = planck_radiance(in0[i], in1[i], in2[i]);
const float behind = planck_radiance(in0[i], in1[i], in8[i]);
const float before = planck_radiance(in0[i], in1[i], in16[i]);
const float body = planck_radiance(in0[i], in1[i], in18[i]);
const float tau1c = transmission_of(in13[i], 100.0f), tau_sb = transmission_of(in14[i], 100.0f);
const float tau_tb = transmission_of(in15[i], 100.0f), tau2c = transmission_of(in17[i], 100.0f);
const float background = transmission_through(
    background_radiance(in7[i], behind, sun_on_surface(in4[i] * tau_sb, 1.0f, in9[i])), tau_tb, before);
const float surface = surface_radiance(in3[i], target, sun_on_surface(in4[i] * tau1c, 1.0f, in5[i]),
                                       radiance_from_above(in6[i], in12[i], background));
out[0] = transmission_through(sensor_radiance(surface, in10[i], 0.0f), tau2c, body) + in11[i];
"""


@pytest.mark.parametrize("name", FOUR_PIXELS)
def test_the_terms_make_up_the_pixel(opencl, name):
    p = types.SimpleNamespace(**{**CLEAR, **FOUR_PIXELS[name]})
    # Thesis, below eq. 2.4-5: c, h, k.
    c, h, k = 2.99792458e8, 6.626176e-34, 1.380662e-23
    first, second = 2e24 * h * c**2 / p.um**5, 1e6 * h * c / (k * p.um)
    values = [first, second, p.t_t, p.e_t, p.e_s * p.tau1, p.cos_s, p.f, p.e_b, p.t_b, p.cos_b,
              p.tau2, p.path, p.sky, *-np.log([p.tau1c, p.tau_sb, p.tau_tb]) / 100, p.t_tbe,
              -np.log(p.tau2c) / 100, p.t_ste]

    radiance = probe.probe(opencl, "radiometry.h", ONE_PIXEL, [[v] for v in values],
                           options="-DSPECTRUM_WIDTH=1")[0, 0]

    assert radiance == pytest.approx(p.expected, rel=1e-5)  # seven digits given


def black_plane(low_um, high_um, temperature_k):
    """One pixel of a black, level plane straight below, in a vacuum; samples every 2 cm-1."""
    steps = int(np.ceil((1e4 / low_um - 1e4 / high_um) / 2))
    wavelength = 1e4 / np.linspace(1e4 / low_um, 1e4 / high_um, steps + 1)
    weight = 0.5 * (np.diff(wavelength, prepend=low_um) + np.diff(wavelength, append=high_um))
    pad = -len(weight) % 16
    case = Case(1, 1, 0)
    case.weight = np.pad(weight, (0, pad))
    case.weights = case.weight.astype(np.float32)
    case.wavelength_um = np.pad(wavelength, (0, pad), mode="edge")
    case.bands = np.zeros(1, records.BAND)
    case.bands[0] = (0, len(weight), 1, 0, high_um - low_um, 0, 0, 0)
    case.frame["band_count"], case.frame["sample_count"] = 1, len(case.weight)
    case.frame["path_count"] = case.frame["zenith_count"] = case.frame["azimuth_count"] = 1
    case.materials[:1]["specular_share"], case.materials[:1]["emissivity_angles"] = 0, 1
    case.materials["lobe_first"] = records.NONE
    case.facets["material"] = 0
    case.hit["facet"], case.hit["normal"] = 0, (0, 0, 1)
    case.background["facet"] = records.NONE
    case.pixel_k[:] = temperature_k
    case.frame["knot_count"], case.frame["knot_span"] = len(case.weight), 0
    case.incident = np.full((1, 2, len(case.weight)), 7, np.float32)
    case.emissivity = np.ones((1, len(case.weight)), np.float32)
    flat = np.ones(len(case.weight))
    case.air["first_row"] = 8
    case.spectra = np.array([
        case.weight, reference.FIRST / case.wavelength_um**5,
        reference.SECOND / case.wavelength_um, 9 * flat, 5 * flat, flat, 0 * flat, flat], np.float32)
    return case


@pytest.mark.parametrize("options", WIDTHS)
@pytest.mark.parametrize("low_um, high_um, temperature_k, expected", [
    (3, 5, 300, 1.8659562), (8, 14, 300, 54.933461), (7.5, 13, 300, 51.476982),
    (8, 14, 250, 22.29229), (3, 5, 350, 8.9743499), (8, 14, 350, 106.44447)])
def test_a_black_plane_radiates_planck_in_band(opencl, low_um, high_um, temperature_k, expected,
                                               options):
    radiance = run(opencl, black_plane(low_um, high_um, temperature_k), options)[0, 0, 0]

    # eq. 2.4-3 by trapezoids of 2 cm-1; float32 sums of 700 samples, the scalar twin one by one.
    assert radiance == pytest.approx(expected, rel=5e-6)


def test_a_black_body_at_300_k_radiates_9_924_at_10_um(opencl):
    radiance = probe.probe(opencl, "spectrum.h", "out[0] = planck_radiance(in0[i], in1[i], 300.0f);",
                           [[reference.FIRST / 1e5], [reference.SECOND / 10]],
                           options="-DSPECTRUM_WIDTH=1")[0, 0]

    assert radiance == pytest.approx(9.92403333, rel=1e-6)  # exponent 4.8 in float32


def test_a_negative_cosine_of_the_sun_adds_nothing(opencl):
    sun = probe.probe(opencl, "radiometry.h", "out[0] = sun_on_surface(10.0f, 1.0f, in0[i]);",
                      [[-0.5, 0.0, 1.0]], options="-DSPECTRUM_WIDTH=1")[0]

    assert sun == pytest.approx([0, 0, 10 / np.pi], rel=1e-6)
