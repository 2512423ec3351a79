"""radsig render with transmissive bodies, against closed forms."""
import numpy as np
import pytest

BAND = 2e-4  # band integration, float32 tables
LOW, HIGH = 8.0, 14.0
VACUUM = {"sky_temperature_k": 1.0, "sky_radiance_w_m2_sr_um": 0.0, "sun_irradiance_w_m2_um": 0.0,
          "transmission": 1.0, "path_temperature_k": 1.0}
PLANE = "usemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
FACES = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]


def box(low, high, material="cloud", faces=FACES):
    corners = [[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)]
    lines = [f"usemtl {material}", *("v {} {} {}".format(*c) for c in corners)]
    return "\n".join(lines + ["f {} {} {} {}".format(*f) for f in faces]) + "\n"


def under(*bodies, per_km=40.0, cloud_k=260.0, wall=None, sky=VACUUM, **changes):
    """Arguments of a scene: the level plane of 100 m, and boxes of one material."""
    names = [f"body{i}.obj" for i in range(len(bodies))]
    cloud = {"name": "cloud", "extinction_per_km": per_km, "temperature_k": cloud_k}
    return {"meshes": {"plane.obj": PLANE, **dict(zip(names, bodies))},
            "geometry": [{"file": n} for n in ("plane.obj", *names)],
            "material": [{"name": "wall", "emissivity": 1.0, "temperature_k": 300.0,
                          **(wall or {})}, cloud],
            "atmosphere": {"uniform": {**VACUUM, **sky}}, **changes}


SLAB = box((-40, -40, 20), (40, 40, 30))


def slants(program, radiance):
    """1 / cosine of every pixel's ray from the plumb line."""
    directions = radiance.pixel_directions(position_m=[0.0, 0.0, 60.0], target_m=[0.0, 0.0, 0.0],
                                           focal_length_mm=85.0, pixels=[8, 6])
    return 1 / -directions[..., 2]


@pytest.mark.parametrize("mode", ["exact", "thesis"])
def test_a_slab_before_the_target_takes_its_share_and_gives_its_own(program, radiance, tmp_path,
                                                                    mode):
    got = program.render(tmp_path, **under(SLAB), render={"thermal": "fixed", "mode": mode})

    tau = np.exp(-.04 * 10 * slants(program, radiance))
    expected = tau * radiance.band_planck(LOW, HIGH, 300) + (1 - tau) * radiance.band_planck(
        LOW, HIGH, 260)
    bound = BAND if mode == "exact" else 2e-2  # the thesis sums over the database's points
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=bound)


def test_a_slab_shades_the_sun_on_the_ground(program, radiance, tmp_path):
    sun = {"sun_irradiance_w_m2_um": 100.0}
    wall = {"emissivity": .5}
    vis = [{"name": "vis", "wavelength_um": [.5, .6]}]
    wide = box((-4000, -4000, 20), (4000, 4000, 30))
    camera = {"position_m": [0.0, 0.0, 15.0], "focal_length_mm": 35.0}

    clear = program.render(tmp_path, **under(SLAB, per_km=0.0, sky=sun, wall=wall), band=vis,
                           camera=camera)
    shaded = program.render(tmp_path, **under(wide, sky=sun, wall=wall), band=vis, camera=camera)

    # The sun's cosine from the radiance of the clear plane: .5 E / pi cos, over .1 um.
    cosine = np.median(clear.planes["radiance_vis"]) * np.pi / (.5 * 100 * .1)
    tau = np.exp(-.04 * 10 / cosine)
    assert .5 < cosine < 1
    assert shaded.planes["radiance_vis"] == pytest.approx(tau * clear.planes["radiance_vis"],
                                                          rel=1e-4)  # cosine from a float32 plane
    assert clear.planes["sunlit"] == pytest.approx(1)
    assert shaded.planes["sunlit"] == pytest.approx(tau, rel=1e-4)


def test_a_cloud_at_the_temperature_of_sky_and_ground_is_invisible(program, radiance, tmp_path):
    wall = {"emissivity": .3, "temperature_k": 280.0}
    sky = {"sky_temperature_k": 280.0}

    got = program.render(tmp_path, **under(SLAB, box((-10, -10, 2), (10, 10, 6)), cloud_k=280.0,
                                           wall=wall, sky=sky))

    assert got.planes["radiance_lwir"] == pytest.approx(radiance.band_planck(LOW, HIGH, 280),
                                                        rel=BAND)


def test_a_wide_slab_dims_the_whole_sky(program, radiance, tmp_path):
    wall = {"emissivity": .5, "temperature_k": 1.0}
    sky = {"sky_temperature_k": 280.0}
    wide = box((-40000, -40000, 20), (40000, 40000, 30))
    camera = {"position_m": [0.0, 0.0, 15.0], "focal_length_mm": 35.0}
    steps = {"hemisphere_step_deg": {"zenith": 5, "azimuth": 30}, "thermal": "fixed"}

    got = program.render(tmp_path, **under(wide, cloud_k=1.0, wall=wall, sky=sky), camera=camera,
                         render=steps)

    # 2 E3(depth): the share of an isotropic sky that comes through a level slab.
    mu = (np.arange(20000) + .5) / 20000
    share = 2 * np.mean(mu * np.exp(-.4 / mu))
    expected = .5 * share * radiance.band_planck(LOW, HIGH, 280)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=5e-3)  # cells of 5 degrees


@pytest.mark.parametrize("mode", ["exact", "thesis"])
def test_a_missed_ray_sees_the_sky_through_a_body(program, radiance, tmp_path, mode):
    sky = {"sky_temperature_k": 280.0}
    camera = {"position_m": [0.0, 0.0, 1.0], "target_m": [0.0, 0.0, 60.0],
              "focal_length_mm": 200.0, "pixels": [3, 3]}

    got = program.render(tmp_path, **under(SLAB, sky=sky), camera=camera,
                         render={"mode": mode, "thermal": "fixed"})

    tau = np.exp(-.04 * 10)
    expected = tau * radiance.band_planck(LOW, HIGH, 280) + (1 - tau) * radiance.band_planck(
        LOW, HIGH, 260)
    bound = BAND if mode == "exact" else 2e-2
    assert got.planes["radiance_lwir"][1, 1] == pytest.approx(expected, rel=bound)
    assert got.planes["interaction"][1, 1] == 0


def test_a_mirror_shows_a_body(program, radiance, tmp_path):
    wall = {"emissivity": .2, "specular_share": 1.0, "temperature_k": 290.0}
    camera = {"position_m": [0.0, 0.0, 15.0], "focal_length_mm": 200.0, "pixels": [3, 3]}

    got = program.render(tmp_path, **under(SLAB, wall=wall, sky={"sky_temperature_k": 250.0}),
                         camera=camera)

    tau = np.exp(-.04 * 10)
    b = lambda kelvin: radiance.band_planck(LOW, HIGH, kelvin)
    expected = .2 * b(290) + .8 * (tau * b(250) + (1 - tau) * b(260))
    assert got.planes["radiance_lwir"][1, 1] == pytest.approx(expected, rel=BAND)


def refusal(program, folder, **scene):
    done = program.run("check", program.write_scene(folder, **scene))
    assert done.returncode == 1
    return done.stderr


def test_a_body_with_a_hole_is_refused(program, tmp_path):
    text = refusal(program, tmp_path, **under(box((0, 0, 5), (9, 9, 9), faces=FACES[1:])))

    assert "material cloud" in text and "do not close" in text


def test_a_body_that_faces_inwards_is_refused(program, tmp_path):
    inside_out = [f[::-1] for f in FACES]

    text = refusal(program, tmp_path, **under(box((0, 0, 5), (9, 9, 9), faces=inside_out)))

    assert "material cloud" in text and "face inwards" in text


def test_a_body_without_any_temperature_is_refused(program, tmp_path):
    scene = under(SLAB)
    del scene["material"][1]["temperature_k"]

    assert "material cloud" in (text := refusal(program, tmp_path, **scene))
    assert "temperature_k" in text


def test_more_than_four_transmissive_materials_are_refused(program, tmp_path):
    boxes = [box((0, 0, 5 + i), (9, 9, 6 + i), f"c{i}") for i in range(5)]
    scene = under(*boxes)
    scene["material"] += [{"name": f"c{i}", "extinction_per_km": 1.0, "temperature_k": 250.0}
                          for i in range(5)]

    assert "expected 4 of them or fewer" in refusal(program, tmp_path, **scene)


MATTER = {"emissivity": .93, "density_kg_m3": 2114.0, "specific_heat_j_kg_k": 920.0,
          "conductivity_w_m_k": .689, "thickness_cm": 5.0, "exposed_area": -.5}


def warm_planes(program, folder, cloud):
    """The ground below a box 10 m above it, after a summer's day; cloud: what the box is made of."""
    folder.mkdir()
    scene = under(box((-20, -20, 10), (20, 20, 14)))
    scene["material"] = [{"name": "wall", **MATTER}, {"name": "cloud", **cloud}]
    return program.render(
        folder, **scene, render={"thermal": "therm"},
        site={"time": "1992-06-21T14:00:00-05:00", "longitude_deg": -75.0},
        weather={"air_temperature_sunrise_c": 15.0, "air_temperature_peak_c": 29.0,
                 "peak_time_h": 15.0, "relative_humidity_sunrise": .9, "wind_m_s": 2.0},
        camera={"position_m": [0.0, 0.0, 8.0], "focal_length_mm": 8.0, "pixels": [24, 24]}).planes


@pytest.fixture(scope="module")
def warm(program, tmp_path_factory):
    folder = tmp_path_factory.mktemp("warm")
    cloud = lambda per_km: {"extinction_per_km": per_km, "temperature_k": 270.0}
    made = {"clear": cloud(0.0), "thin": cloud(150.0), "dense": cloud(1e6), "opaque": MATTER}
    return {name: warm_planes(program, folder / name, of) for name, of in made.items()}


def test_ground_below_a_dense_cloud_is_as_cold_as_below_a_roof(warm):
    assert warm["dense"]["temperature_c"] == pytest.approx(warm["opaque"]["temperature_c"],
                                                           abs=1e-3)


def test_ground_below_a_thin_cloud_is_between_sun_and_shade(warm):
    shade = warm["dense"]["sunlit"] == 0

    assert shade.sum() > 50
    assert (warm["thin"]["temperature_c"] < warm["clear"]["temperature_c"] - 1)[shade].all()
    assert (warm["thin"]["temperature_c"] > warm["dense"]["temperature_c"] + 1)[shade].all()


@pytest.mark.parametrize("heading, place", [("wavelength_um", lambda um: um),
                                            ("wavenumber_cm1", lambda um: 1e4 / um)])
def test_a_body_takes_its_extinction_from_a_table_on_its_own_wavelengths(program, radiance, tmp_path,
                                                                         heading, place):
    um, per_km = np.array([7.5, 9.0, 9.2, 9.4, 12.0, 15.0]), np.array([10.0, 10.0, 80.0, 10.0, 40.0, 40.0])
    rows = "".join(f"{place(x)!r},{y}\n" for x, y in zip(um.tolist(), per_km.tolist()))
    (tmp_path / "smoke.csv").write_text(f"# smoke\n{heading},extinction_per_km\n{rows}")
    scene = under(SLAB)
    scene["material"][1]["extinction_file"] = "smoke.csv"

    got = program.render(tmp_path, **scene)

    def at(x):
        if heading == "wavelength_um":
            return np.interp(x, um, per_km)
        return np.interp(1e4 / x, 1e4 / um[::-1], per_km[::-1])

    slant = slants(program, radiance)[3, 4]
    tau = lambda x: np.exp(-at(x) / 1000 * 10 * slant)
    expected = sum(radiance.integral(
        lambda x: tau(x) * radiance.planck(x, 300) + (1 - tau(x)) * radiance.planck(x, 260), a, b)
        for a, b in zip([8, 9, 9.2, 9.4, 12], [9, 9.2, 9.4, 12, 14]))
    assert got.planes["radiance_lwir"][3, 4] == pytest.approx(expected, rel=BAND)


@pytest.mark.parametrize("rows, keys, expected", [
    ("7,1\n9,1\n14,1\n", {}, "expected extinction_per_km beside it"),
    ("9.1,1\n10,1\n14,1\n", {"extinction_per_km": 1.0}, "band lwir needs extinction at 8 um, the table has 9.1 to 14 um"),
    ("7,1\n9,1\n9,1\n", {"extinction_per_km": 1.0}, "smoke.csv:4: found '9,1', expected wavelengths that only rise"),
])
def test_a_table_of_extinction_that_does_not_do_is_refused(program, tmp_path, rows, keys, expected):
    (tmp_path / "smoke.csv").write_text(f"wavelength_um,extinction_per_km\n{rows}")
    scene = under(SLAB)
    scene["material"][1] = {"name": "cloud", "temperature_k": 260.0, "extinction_file": "smoke.csv", **keys}

    done = program.run("check", program.write_scene(tmp_path, **scene))

    assert done.returncode == 1 and expected in done.stderr
