"""Exact mode: how surfaces reflect, against closed forms and quadrature in float64 numpy."""
import numpy as np
import pytest

BAND = 2e-4
LWIR = (8.0, 14.0)
ANGLES = np.arange(91.0)
NOON = {"latitude_deg": 0.0, "longitude_deg": 0.0}


def emits(angle_deg):
    """An emissivity that falls as that of water does: .96 along the normal, 0 at 90 degrees."""
    cosine = np.cos(np.radians(angle_deg))
    return 0.96 * (1 - (1 - cosine) ** 5)


def write_emissivity(folder, of_angle):
    """The same at all wavenumbers."""
    lines = []
    for angle in ANGLES:
        lines.append(f"{angle:.0f}")
        lines += [f"{cm1} {of_angle(angle):.7f}" for cm1 in range(39850, 349, -100)]
    (folder / "angular.ems").write_text("\n".join(lines) + "\n")
    return {"name": "wall", "emissivity_file": "angular.ems", "temperature_k": 300.0}


def reflects(angle_deg, of_angle=emits):
    """1 - e, linear between degrees."""
    return np.interp(angle_deg, ANGLES, 1 - of_angle(ANGLES))


def hemisphere(of_angle=emits, low_deg=0.0, high_deg=90.0):
    """Integral of (1 - e) 2 cos sin over angles from the normal."""
    angle = np.linspace(low_deg, high_deg, 100001)
    weight = np.sin(np.radians(2 * angle))
    return np.trapz(reflects(angle, of_angle) * weight, np.radians(angle))


def seen_from(angle_deg, azimuth_deg=0.0):
    """A camera 9 km away that sees a speck of the plane at one angle."""
    z, a = np.radians(angle_deg), np.radians(azimuth_deg)
    at = 9e3 * np.array([np.sin(z) * np.sin(a), np.sin(z) * np.cos(a), np.cos(z)])
    return {"position_m": at.tolist(), "target_m": [0.0, 0.0, 0.0], "focal_length_mm": 1e5,
            "pixels": [2, 2]}


def sun_angles(program, time):
    line = program.run("sun", "--site=0,0", "--time", time).stdout.splitlines()[1]
    return [float(x) for x in line.split(",")[1:3]]


def sun_reflected(program, folder, view_deg, time):
    """The part of the radiance, 8 to 14 um, of a sun of 50 W m-2 um-1."""
    uniform = {**program.vacuum, "sun_irradiance_w_m2_um": 50.0}
    got = program.render(folder, "--planes", "reflected_sun_lwir",
                         material=[write_emissivity(folder, emits)],
                         site={**NOON, "time": time}, camera=seen_from(view_deg),
                         atmosphere={"uniform": uniform})
    return got.planes["reflected_sun_lwir"].mean(dtype=float)


def test_sunlight_is_reflected_by_a_lobe_that_is_the_same_both_ways(program, tmp_path):
    """Seen from where the sun stood, with the sun where the camera was, the plane reflects as much of
    the irradiance; 40 and 78 degrees, on either side."""
    low, high = "1992-03-20T09:27:00+00:00", "1992-03-20T06:55:00+00:00"
    angles = [sun_angles(program, time)[0] for time in (low, high)]
    lobe = np.prod([reflects(a) for a in angles]) / (np.pi * hemisphere())
    for name, view, sun, time in (("a", angles[1], angles[0], low), ("b", angles[0], angles[1], high)):
        folder = tmp_path / name
        folder.mkdir()

        got = sun_reflected(program, folder, view, time)

        irradiance = 6 * 50 * np.cos(np.radians(sun))
        assert got / irradiance == pytest.approx(lobe, rel=2e-4)  # angles to .001 degree, .ems linear
    assert abs(angles[0] - angles[1]) > 30


@pytest.mark.parametrize("view_deg", [0.0, 60.0, 85.0])
def test_what_a_plane_does_not_emit_it_reflects(program, radiance, tmp_path, view_deg):
    """Kirchhoff: e B(T) + (1 - e) L under a sky of L all round."""
    got = program.render(tmp_path, material=[write_emissivity(tmp_path, emits)],
                         camera=seen_from(view_deg),
                         atmosphere={"uniform": {**program.vacuum, "sky_radiance_w_m2_sr_um": 8.0}})

    rho = reflects(view_deg)
    expected = (1 - rho) * radiance.band_planck(*LWIR, 300) + rho * 6 * 8
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def shaft(high_m):
    """A floor of 2 m at the foot of a round shaft of 1 m radius: 384 sides."""
    around = np.radians(np.arange(384) * 360 / 384)
    lines = ["usemtl wall", "v -1 -1 0", "v 1 -1 0", "v 1 1 0", "v -1 1 0", "f 1 2 3 4",
             "usemtl shaft"]
    for z in (-0.1, high_m):
        lines += [f"v {np.cos(a):.7f} {np.sin(a):.7f} {z}" for a in around]
    lines += [f"f {5 + (i + 1) % 384} {5 + i} {389 + i} {389 + (i + 1) % 384}" for i in range(384)]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("elevation_deg", np.degrees(np.arcsin(np.sqrt([1 / 3, 2 / 3]))))  # between rings
def test_the_lobe_shares_out_what_comes_from_low_and_from_high(program, radiance, tmp_path,
                                                               elevation_deg):
    """The middle of the floor sees black walls at 350 K up to an elevation, a sky above."""
    floor = {**write_emissivity(tmp_path, emits), "temperature_k": 1.0}
    walls = {"name": "shaft", "emissivity": 1.0, "temperature_k": 350.0}
    camera = {"position_m": [0.0, 0.0, 1e3], "target_m": [0.0, 0.0, 0.0], "focal_length_mm": 1e7,
              "pixels": [2, 2]}

    got = program.render(tmp_path, "--planes", "reflected_sky_lwir,reflected_background_lwir",
                         meshes={"shaft.obj": shaft(np.tan(np.radians(elevation_deg)))},
                         geometry=[{"file": "shaft.obj"}], material=[floor, walls], camera=camera,
                         atmosphere={"uniform": {**program.vacuum, "sky_radiance_w_m2_sr_um": 8.0}})

    share = hemisphere(high_deg=90 - elevation_deg) / hemisphere()
    # The shaft is 3e-5 narrower between its corners, and the camera's pixels see a patch of 3.6 mm.
    assert got.planes["reflected_sky_lwir"] == pytest.approx(0.04 * share * 6 * 8, rel=1e-3)
    expected = 0.04 * (1 - share) * radiance.band_planck(*LWIR, 350)
    assert got.planes["reflected_background_lwir"] == pytest.approx(expected, rel=2e-3)


def test_an_enclosure_of_lobes_is_black(program, radiance, tmp_path):
    """Walls of emissivities by angle, tilted, so that the horizon cuts rings of their hemispheres."""
    box = "usemtl wall\n" + "".join(
        f"v {x} {y} {z + 0.3 * x - 0.2 * y}\n" for z in (0, 4) for x, y in ((-2, -2), (2, -2), (2, 2), (-2, 2)))
    box += "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"
    camera = {"position_m": [0.9, -0.7, 2.5], "target_m": [-0.9, 0.8, 1.0], "focal_length_mm": 12.0,
              "pixels": [24, 20]}

    got = program.render(tmp_path, meshes={"box.obj": box}, geometry=[{"file": "box.obj"}],
                         material=[write_emissivity(tmp_path, emits)], camera=camera)

    expected = radiance.band_planck(*LWIR, 300)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def hall(**floor):
    """A floor under a black ceiling at 350 K that half covers it, a sky elsewhere."""
    mesh = ("usemtl floor\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
            "usemtl ceiling\nv -50 0 9\nv 50 0 9\nv 50 50 9\nv -50 50 9\nf 5 8 7 6\n")
    materials = [{"name": "floor", "emissivity": 0.3, "temperature_k": 290.0, **floor},
                 {"name": "ceiling", "emissivity": 1.0, "temperature_k": 350.0}]
    camera = {"position_m": [0.0, -20.0, 8.0], "target_m": [0.0, -1.0, 0.0],
              "focal_length_mm": 18.0, "pixels": [32, 24]}
    return {"meshes": {"hall.obj": mesh}, "geometry": [{"file": "hall.obj"}], "material": materials,
            "camera": camera}


def render_hall(program, folder, name, **floor):
    into = folder / name
    into.mkdir()
    return program.render(into, **hall(**floor), atmosphere={
        "uniform": {**program.vacuum, "sky_radiance_w_m2_sr_um": 5.0}}).planes


def test_a_specular_share_mixes_the_diffuse_and_the_specular_surface(program, tmp_path):
    diffuse = render_hall(program, tmp_path, "diffuse", specular_share=0.0)
    mirror = render_hall(program, tmp_path, "mirror", specular_share=1.0)
    mixed = render_hall(program, tmp_path, "mixed", specular_share=0.3)

    expected = 0.7 * diffuse["radiance_lwir"].astype(float) + 0.3 * mirror["radiance_lwir"]
    assert mixed["radiance_lwir"] == pytest.approx(expected, rel=1e-6)
    assert set(np.unique(mirror["interaction"])) >= {2, 3}
    on_floor = mirror["interaction"] >= 2
    assert (mixed["interaction"][on_floor] == mirror["interaction"][on_floor] + 2).all()


@pytest.mark.parametrize("share, alike", [(0.49, 0.0), (0.5, 1.0)])
def test_the_thesis_knows_no_shares_between(program, tmp_path, share, alike):
    pictures = []
    for name, value in (("a", share), ("b", alike)):
        into = tmp_path / name
        into.mkdir()
        pictures.append(program.render(into, "--mode", "thesis", **hall(specular_share=value, roughness=0.2)))

    a, b = (p.planes["radiance_lwir"] for p in pictures)
    assert a.tobytes() == b.tobytes()


def test_a_rough_mirror_in_an_enclosure_is_black(program, radiance, tmp_path):
    box = "usemtl wall\n" + "".join(
        f"v {x} {y} {z + 0.3 * x - 0.2 * y}\n" for z in (0, 4) for x, y in ((-2, -2), (2, -2), (2, 2), (-2, 2)))
    box += "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"
    camera = {"position_m": [0.9, -0.7, 2.5], "target_m": [-0.9, 0.8, 1.0], "focal_length_mm": 12.0,
              "pixels": [24, 20]}
    wall = {**write_emissivity(tmp_path, emits), "specular_share": 0.6, "roughness": 0.3}

    got = program.render(tmp_path, meshes={"box.obj": box}, geometry=[{"file": "box.obj"}],
                         material=[wall], camera=camera)

    expected = radiance.band_planck(*LWIR, 300)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def ggx(roughness, view, sun):
    """The lobe for directions with z along the normal, well above the horizon, per sr: Walter and
    others (2007), what is turned up from below left out."""
    half = (view + sun) / np.linalg.norm(view + sun)
    a2 = roughness**2
    spread = a2 * half[2] ** 2 + half[0] ** 2 + half[1] ** 2
    return a2 / np.pi / spread**2 / (2 * (view[2] + np.sqrt(a2 + (1 - a2) * view[2] ** 2)))


def test_the_sun_stands_in_a_rough_mirror_with_the_density_of_its_lobe(program, tmp_path):
    time = "1992-03-20T12:00:00+00:00"  # at the equator, 2 degrees from the zenith
    zenith, azimuth = np.radians(sun_angles(program, time))
    sun = np.array([np.sin(zenith) * np.sin(azimuth), np.sin(zenith) * np.cos(azimuth), np.cos(zenith)])
    uniform = {**program.vacuum, "sun_irradiance_w_m2_um": 50.0}
    for view_deg in (3.0, 20.0):
        folder = tmp_path / f"{view_deg}"
        folder.mkdir()

        got = program.render(
            folder, "--planes", "reflected_sun_lwir", camera=seen_from(view_deg, 90.0),
            site={**NOON, "time": time}, atmosphere={"uniform": uniform},
            material=[{"name": "wall", "emissivity": 0.4, "temperature_k": 300.0,
                       "specular_share": 1.0, "roughness": 0.1}])

        view = np.array([np.sin(np.radians(view_deg)), 0, np.cos(np.radians(view_deg))])
        expected = 0.6 * 6 * 50 * ggx(np.hypot(0.1, 4.6505e-3 / 2), view, sun)
        assert got.planes["reflected_sun_lwir"] == pytest.approx(expected, rel=2e-3)
