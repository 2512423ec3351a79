"""Exact mode: light that goes from facet to facet, against its series at every depth."""

import numpy as np
import pytest

import cases

BAND = 2e-4
LWIR = (8.0, 14.0)

# Two plates of 200 x 200 m face each other, 1 m apart.
PLATES = """v -100 -100 0
v 100 -100 0
v 100 100 0
v -100 100 0
v -100 -100 1
v 100 -100 1
v 100 100 1
v -100 100 1
usemtl lower
f 1 2 3 4
usemtl upper
f 5 8 7 6
"""
BETWEEN = {"position_m": [0.0, 0.0, 0.9], "target_m": [0.0, 0.0, 0.0], "focal_length_mm": 100.0,
           "pixels": [4, 4]}


def lower_plate(black, emissivity, depth):
    """Radiance of the lower plate where light meets `depth` facets behind it, the last of them black."""
    radiance = list(black)
    for _ in range(depth - 1):
        radiance = [e * b + (1 - e) * other
                    for e, b, other in zip(emissivity, black, reversed(radiance))]
    return emissivity[0] * black[0] + (1 - emissivity[0]) * radiance[1]


def render_plates(program, folder, emissivity, **settings):
    plates = [{"name": n, "emissivity": e, "temperature_k": t}
              for n, e, t in zip(("lower", "upper"), emissivity, (300.0, 400.0))]
    got = program.render(folder, meshes={"plates.obj": PLATES}, geometry=[{"file": "plates.obj"}],
                         material=plates, camera=BETWEEN, render=settings)
    return got.planes["radiance_lwir"]


@pytest.mark.parametrize("depth", [1, 2, 5])
@pytest.mark.parametrize("emissivity", [(0.7, 0.9), (0.2, 0.2)])
def test_facing_plates_reflect_each_other_as_often_as_stated(program, radiance, tmp_path, emissivity,
                                                             depth):
    got = render_plates(program, tmp_path, emissivity, depth=depth)

    black = [radiance.band_planck(*LWIR, t) for t in (300, 400)]
    # Beyond depth 1 Planck's law is that of the middle of 32 cm-1: 2e-4 of what is reflected.
    assert got == pytest.approx(lower_plate(black, emissivity, depth), rel=2 * BAND)


@pytest.mark.parametrize("emissivity", [(0.9, 0.7), (0.7, 0.9), (0.2, 0.2), (0.05, 0.1), (0.01, 0.01)])
def test_facing_plates_reflect_each_other_until_nothing_is_left(program, radiance, tmp_path,
                                                                emissivity):
    got = render_plates(program, tmp_path, emissivity)

    black = [radiance.band_planck(*LWIR, t) for t in (300, 400)]
    (e1, e2), (b1, b2) = emissivity, black
    forever = (e1 * b1 + (1 - e1) * e2 * b2) / (1 - (1 - e1) * (1 - e2))
    assert got == pytest.approx(forever, rel=1e-3)


def cavity(opening):
    """A sphere of 1 m, seen from inside, open at the top: its share of the area."""
    corner, position = cases.icosphere(4, 1.0)
    text = ["usemtl wall"] + ["v %.7f %.7f %.7f" % tuple(p) for p in position]
    for corners in corner[:, :3]:
        middle = position[corners].mean(0)
        if middle[2] > 1 - 2 * opening:
            continue
        a, b, c = corners + 1
        out = np.dot(np.cross(*(position[corners[1:]] - position[corners[0]])), middle)
        text.append(f"f {a} {b} {c}" if out < 0 else f"f {a} {c} {b}")
    return "\n".join(text) + "\n"


@pytest.mark.parametrize("depth", [1, 2, 4, None])
def test_a_cavity_under_a_sky_shines_as_its_series_says(program, tmp_path, depth):
    """a f L sum (a (1 - f))^k: every point of a sphere sees its opening by the same share f."""
    albedo, opening, sky = 0.7, 0.25, 8.0
    camera = {"position_m": [0.0, 0.0, 0.3], "target_m": [0.3, 0.2, -1.0], "focal_length_mm": 18.0,
              "pixels": [24, 20]}
    steps = {"zenith": 5.0, "azimuth": 10.0}

    got = program.render(tmp_path, meshes={"cavity.obj": cavity(opening)},
                         geometry=[{"file": "cavity.obj"}], camera=camera,
                         material=[{"name": "wall", "emissivity": 1 - albedo, "temperature_k": 1.0}],
                         atmosphere={"uniform": {**program.vacuum, "sky_radiance_w_m2_sr_um": sky}},
                         render={"hemisphere_step_deg": steps, **({"depth": depth} if depth else {})})

    q = albedo * (1 - opening)
    series = (1 - q ** (depth + 1)) / (1 - q) if depth else 1 / (1 - q)
    expected = albedo * opening * sky * 6 * series
    # 648 rays find the opening's share to .5 % each, and the flat facets' rim is not the circle's.
    assert got.planes["radiance_lwir"].mean(dtype=float) == pytest.approx(expected, rel=1e-2)


def test_facing_plates_with_a_narrow_line_reflect_each_other_at_every_wavelength(program, radiance, tmp_path):
    """A line of 12 cm-1; light deeper than one facet is computed at the middle of 4 knots: a third of what it brings here."""
    nu = np.array([700.0, 1001.0, 1007.0, 1013.0, 1300.0])
    e = np.array([0.9, 0.9, 0.3, 0.9, 0.9])
    rows = "".join(f"{x!r},{y}\n" for x, y in zip(nu.tolist(), e.tolist()))
    (tmp_path / "line.csv").write_text("wavenumber_cm1,emissivity\n" + rows)
    edges = 1e4 / np.array([1040.0, 1030.0, 1010.0, 1000.0, 980.0])
    plates = [{"name": "lower", "emissivity": 0.5, "temperature_k": 300.0},
              {"name": "upper", "spectrum_file": "line.csv", "temperature_k": 400.0}]

    got = program.render(tmp_path, meshes={"plates.obj": PLATES}, geometry=[{"file": "plates.obj"}],
                         material=plates, camera=BETWEEN,
                         band=[{"name": f"b{i}", "wavelength_um": [float(a), float(b)]}
                               for i, (a, b) in enumerate(zip(edges, edges[1:]))])

    for i, (low, high) in enumerate(zip(edges, edges[1:])):
        um = np.linspace(low, high, 20001)
        upper = np.interp(1e4 / um, nu, e)
        lower_b, upper_b = radiance.planck(um, 300.0), radiance.planck(um, 400.0)
        whole = (0.5 * lower_b + 0.5 * upper * upper_b) / (1 - 0.5 * (1 - upper))
        assert got.planes[f"radiance_b{i}"] == pytest.approx(np.trapz(whole, um), rel=5e-3)
