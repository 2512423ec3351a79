"""The lobes of what a surface reflects, against quadrature in float64 numpy. Directions here have
z along the normal; the device sees them turned, so that the surface is tilted."""
import lobe_reference
import numpy as np
import probe
import pytest

COUNT = 1 << 17
NORMAL = np.array([0.0, 0, 1])
ROUGHNESS = [0.05, 0.6]
VIEW_DEG = [0.0, 65.0]
AXES = np.linalg.qr([[0.9, 0.3, 0.3], [-0.2, 0.8, -0.5], [0.4, 0.1, 0.8]])[0]


def vector(local):
    """A direction as the device has it."""
    return "{" + ", ".join(f"{x:.9e}f" for x in AXES @ local) + "}"


def towards(zenith_deg, azimuth_deg=0.0):
    z, a = np.radians(zenith_deg), np.radians(azimuth_deg)
    return np.stack(np.broadcast_arrays(np.sin(z) * np.cos(a), np.sin(z) * np.sin(a), np.cos(z)))


def device_lobe(opencl, function, roughness, view, from_):
    body = (f"const float v[3] = {vector(view)}, n[3] = {vector(NORMAL)};"
            "const float l[3] = {in0[i], in1[i], in2[i]};"
            f"out[0] = {function}({roughness!r}f, n, v, l);")
    return probe.probe(opencl, "lobe.h", body, AXES @ from_,
                       options="-DSPECTRUM_WIDTH=1")[0].astype(float)


def grid(mirror_deg):
    """Directions over the hemisphere, finer around one, and their solid angles."""
    edges = np.unique(np.concatenate([np.linspace(0, 90, 181), mirror_deg + np.linspace(-6, 6, 121)]))
    edges = edges[(edges >= 0) & (edges <= 90)]
    around = 180 * np.linspace(-1, 1, 361) ** 3
    zenith, azimuth = 0.5 * (edges[1:] + edges[:-1]), 0.5 * (around[1:] + around[:-1])
    band = np.cos(np.radians(edges[:-1])) - np.cos(np.radians(edges[1:]))
    solid = band[:, None] * np.radians(np.diff(around))
    z, a = np.meshgrid(zenith, azimuth, indexing="ij")
    return towards(z.ravel(), a.ravel()), solid.ravel()


@pytest.mark.parametrize("view_deg", VIEW_DEG)
@pytest.mark.parametrize("roughness", ROUGHNESS)
def test_the_specular_lobe_is_ggx_turned_up(opencl, roughness, view_deg):
    view = towards(view_deg, 180.0)
    from_ = grid(view_deg)[0][:, ::7]
    # Straight back and turned down, the half vector is 0: its direction is not told in float32.
    from_ = from_[:, np.linalg.norm(view[:, None] + from_ * [[1], [1], [-1]], axis=0) > 0.05]

    got = device_lobe(opencl, "lobe_specular", roughness, view, from_)

    # float32: the half vector of a grazing pair has three digits less.
    assert got == pytest.approx(lobe_reference.specular(roughness, NORMAL, view, from_), rel=1e-3, abs=1e-6)


@pytest.mark.parametrize("function", ["lobe_specular", "lobe_of_sun"])
@pytest.mark.parametrize("view_deg", VIEW_DEG)
@pytest.mark.parametrize("roughness", ROUGHNESS)
def test_the_specular_lobe_loses_nothing(opencl, function, roughness, view_deg):
    view = towards(view_deg, 180.0)
    from_, solid = grid(view_deg)

    got = device_lobe(opencl, function, roughness, view, from_)

    assert (got * solid).sum() == pytest.approx(1, abs=2e-3)  # steps of the grid


@pytest.mark.parametrize("view_deg", [0.0, 60.0])
def test_a_smooth_surface_shows_the_solar_disc(opencl, view_deg):
    view = towards(view_deg, 180.0)
    edge = np.degrees(lobe_reference.SUN_RADIUS)
    from_ = towards(view_deg + edge * np.array([-1.01, -0.99, 0, 0.99, 1.01]))

    got = device_lobe(opencl, "lobe_of_sun", 0.0, view, from_)

    disc = 1 / (np.pi * lobe_reference.SUN_RADIUS**2)
    assert got == pytest.approx([0, disc, disc, disc, 0], rel=1e-5)


def samples(opencl, roughness, view, count=64):
    """Directions of `count` rays of COUNT / count pixels, shape (3, COUNT)."""
    body = (f"const float v[3] = {vector(view)}, n[3] = {vector(NORMAL)};"
            f"lobe_ray({roughness!r}f, n, v, 7u, (uint)in0[i], (uint)in1[i], {count}u, out);")
    pixel, ray = np.divmod(np.arange(COUNT), count)
    out = probe.probe(opencl, "lobe.h", body, [pixel, ray], outputs=3, options="-DSPECTRUM_WIDTH=1")
    return AXES.T @ out.astype(float)


@pytest.mark.parametrize("view_deg", VIEW_DEG)
@pytest.mark.parametrize("roughness", ROUGHNESS)
def test_rays_have_the_density_of_the_lobe(opencl, roughness, view_deg):
    view = towards(view_deg, 180.0)
    from_, solid = grid(view_deg)
    weight = lobe_reference.specular(roughness, NORMAL, view, from_) * solid

    got = samples(opencl, roughness, view)

    assert np.linalg.norm(got, axis=0) == pytest.approx(1, abs=1e-5)
    assert np.all(got[2] > -1e-6)
    # 131072 rays: moments of numbers up to 1 err by .0014 (one sigma, at random) and 2e-3 of the grid.
    for power in (1, 2):
        expected = (weight * from_**power).sum(1)
        assert (got**power).mean(1) == pytest.approx(expected, abs=5e-3)
    for edge in (0.3, 0.6, 0.9):
        expected = weight[from_[2] > edge].sum()
        assert (got[2] > edge).mean() == pytest.approx(expected, abs=6e-3)


def test_a_smooth_lobe_s_rays_are_the_mirror_s(opencl):
    got = samples(opencl, 0.0, towards(40.0, 180.0))

    expected = np.broadcast_to(towards(40.0)[:, None], got.shape)
    assert got == pytest.approx(expected, abs=1e-6)


def test_rays_of_a_pixel_are_spread_evenly(opencl):
    """The mean over 64 rays of a lattice errs by less than a quarter of that of 64 random ones."""
    got = samples(opencl, 1.0, towards(0.0))

    means = (got[2] > 0.5).reshape(-1, 64).mean(1)
    fraction = means.mean()
    assert means.std() < 0.25 * np.sqrt(fraction * (1 - fraction) / 64)
