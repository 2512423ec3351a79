"""radsig render on scenes whose image is known in closed form: level planes under a uniform sky.
Tolerance of bands: 2e-4; the trapezoid rule with exact edges and steps of 2 cm-1 errs by less."""
import numpy as np
import pytest

BAND = 2e-4
# rho .3; at 1 K it emits nothing
GREY = [{"name": "wall", "emissivity": 0.7, "temperature_k": 1.0}]
NOON = {"latitude_deg": 23.44, "longitude_deg": 0.0, "time": "1992-06-21T12:02:00+00:00"}
BANDS = {"lwir": (8.0, 14.0), "mwir": (3.0, 5.0), "wide": (7.5, 13.0), "odd": (8.37, 9.11)}


def sky(**changes):
    return {"uniform": {"sky_temperature_k": 1.0, "sky_radiance_w_m2_sr_um": 0.0,
                        "sun_irradiance_w_m2_um": 0.0, "transmission": 1.0,
                        "path_temperature_k": 1.0, **changes}}


def black_at(temperature_k):
    return [{"name": "wall", "emissivity": 1.0, "temperature_k": temperature_k}]


def sun(program, site):
    """Zenith and azimuth of the sun in radians."""
    done = program.run("sun", f"--site={site['latitude_deg']},{site['longitude_deg']}", "--time",
                       site["time"])
    return np.radians([float(x) for x in done.stdout.splitlines()[1].split(",")[1:3]])


@pytest.fixture(scope="module")
def black(program, tmp_path_factory):
    """Renders of a black plane at a temperature in four bands, made once."""
    made = {}

    def at(temperature_k):
        if temperature_k not in made:
            made[temperature_k] = program.render(
                tmp_path_factory.mktemp("black"), material=black_at(temperature_k),
                band=[{"name": k, "wavelength_um": list(v)} for k, v in BANDS.items()])
        return made[temperature_k].planes

    return at


# Planck's law over the band by quadrature in double, CODATA 2018
@pytest.mark.parametrize("band, temperature_k, expected", [
    ("lwir", 300.0, 54.933461), ("mwir", 300.0, 1.8659562), ("wide", 300.0, 51.476982),
    ("lwir", 250.0, 22.29229), ("lwir", 350.0, 106.44447), ("mwir", 350.0, 8.9743499),
])
def test_a_black_plane_radiates_planck_in_band(black, band, temperature_k, expected):
    assert black(temperature_k)[f"radiance_{band}"] == pytest.approx(expected, rel=BAND)


@pytest.mark.parametrize("temperature_k", [250.0, 300.0])
def test_a_band_with_odd_edges_is_integrated_to_its_edges(black, radiance, temperature_k):
    expected = radiance.band_planck(*BANDS["odd"], temperature_k)

    assert black(temperature_k)["radiance_odd"] == pytest.approx(expected, rel=BAND)


@pytest.mark.parametrize("edges, temperature_k", [((0.4, 0.7), 6000.0), ((8.37, 9.11), 300.0),
                                                  ((19.0, 20.0), 60.0)])
def test_a_lone_band_is_integrated_from_visible_to_far_infrared(program, radiance, tmp_path, edges,
                                                                temperature_k):
    got = program.render(tmp_path, material=black_at(temperature_k),
                         band=[{"name": "b", "wavelength_um": list(edges)}])

    expected = radiance.band_planck(*edges, temperature_k)
    assert got.planes["radiance_b"] == pytest.approx(expected, rel=BAND)


def test_a_black_plane_appears_at_its_own_temperature(black):
    for band in BANDS:
        apparent_c = black(300.0)[f"apparent_temperature_{band}_c"]
        assert apparent_c == pytest.approx(26.85, abs=0.01)


def test_the_truth_of_an_open_plane_is_what_was_stated(black):
    planes = black(300.0)

    assert planes["temperature_c"] == pytest.approx(26.85, abs=1e-4)  # float32 of 300 - 273.15
    assert (planes["shape_factor"] == 1).all() and (planes["interaction"] == 1).all()
    assert (planes["material"] == 1).all() and (planes["facet"] == 0).all()
    for name in ("background_material", "background_temperature_c", "background_sunlit",
                 "background_emissivity_lwir"):
        assert np.isnan(planes[name]).all()


def test_range_and_view_angle_follow_from_the_camera(black, program, radiance):
    direction = radiance.pixel_directions(**program.scene["camera"])

    assert black(300.0)["range_m"] == pytest.approx(-60 / direction[..., 2], rel=1e-5)
    assert black(300.0)["view_angle_deg"] == pytest.approx(
        np.degrees(np.arccos(-direction[..., 2])), abs=0.02)  # acos of a float32 near 1


def test_a_plane_under_an_isotropic_sky_adds_rho_times_the_sky(program, tmp_path):
    got = program.render(tmp_path, material=GREY, atmosphere=sky(sky_radiance_w_m2_sr_um=7.5))

    assert got.planes["radiance_lwir"] == pytest.approx(0.3 * 7.5 * 6, rel=BAND)


def test_emission_and_reflection_add_up(program, radiance, tmp_path):
    material = [{"name": "wall", "emissivity": 0.7, "temperature_k": 310.0}]

    got = program.render(tmp_path, material=material, atmosphere=sky(sky_temperature_k=260.0))

    expected = 0.7 * radiance.band_planck(8, 14, 310) + 0.3 * radiance.band_planck(8, 14, 260)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def test_a_body_under_a_sky_of_its_temperature_is_invisible(program, radiance, tmp_path):
    material = [{"name": "wall", "emissivity": 0.35, "temperature_k": 280.0}]

    got = program.render(tmp_path, material=material, atmosphere=sky(sky_temperature_k=280.0))

    assert got.planes["radiance_lwir"] == pytest.approx(radiance.band_planck(8, 14, 280), rel=BAND)


def test_a_sun_at_zenith_adds_rho_e_over_pi(program, tmp_path):
    zenith_rad, _ = sun(program, NOON)
    assert zenith_rad < np.radians(0.2)

    got = program.render(tmp_path, material=GREY, site=NOON,
                         atmosphere=sky(sun_irradiance_w_m2_um=100.0))

    expected = 0.3 * 100 / np.pi * np.cos(zenith_rad) * 6
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)
    assert (got.planes["sunlit"] == 1).all()


def test_a_low_sun_counts_with_its_cosine(program, tmp_path):
    site = {**NOON, "time": "1992-06-21T16:30:00+00:00"}
    zenith_rad, _ = sun(program, site)

    got = program.render(tmp_path, material=GREY, site=NOON,
                         atmosphere=sky(sun_irradiance_w_m2_um=100.0))
    later = program.run("render", tmp_path / "scene.toml", "-o", tmp_path / "later", "--time",
                        site["time"])

    assert later.returncode == 0, later.stderr
    expected = 0.3 * 100 / np.pi * np.cos(zenith_rad) * 6
    planes = program.load(tmp_path / "later").planes
    assert planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)
    assert (planes["radiance_lwir"] < got.planes["radiance_lwir"]).all()


def test_a_sun_below_the_horizon_adds_nothing(program, radiance, tmp_path):
    material = [{"name": "wall", "emissivity": 0.7, "temperature_k": 300.0}]

    got = program.render(tmp_path, material=material,
                         site={**NOON, "time": "1992-06-21T23:30:00+00:00"},
                         atmosphere=sky(sun_irradiance_w_m2_um=1000.0))

    expected = 0.7 * radiance.band_planck(8, 14, 300)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)
    assert (got.planes["sunlit"] == 0).all()


def apparent_temperature_k(radiance, value, low_um, high_um):
    """Inverts the band's Planck radiance by bisection."""
    low_k, high_k = 1.0, 6000.0
    for _ in range(60):
        middle = 0.5 * (low_k + high_k)
        if radiance.band_planck(low_um, high_um, middle) < value:
            low_k = middle
        else:
            high_k = middle
    return low_k


@pytest.fixture(scope="module")
def hazy(program, tmp_path_factory):
    """A black plane at 300 K through a path of transmission .6 at 280 K; gain 12, offset -5."""
    return program.render(
        tmp_path_factory.mktemp("hazy"),
        atmosphere=sky(transmission=0.6, path_temperature_k=280.0),
        band=[{"name": "lwir", "wavelength_um": [8.0, 14.0], "gain": 12.0, "offset": -5.0}])


def test_a_path_dims_what_is_behind_it_and_adds_its_own(hazy, radiance):
    expected = 0.6 * radiance.band_planck(8, 14, 300) + 0.4 * radiance.band_planck(8, 14, 280)

    assert hazy.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def test_the_apparent_temperature_inverts_the_radiance(hazy, radiance):
    value = float(hazy.planes["radiance_lwir"][0, 0])

    expected = apparent_temperature_k(radiance, value, 8, 14) - 273.15
    assert hazy.planes["apparent_temperature_lwir_c"] == pytest.approx(expected, abs=0.01)


def test_counts_are_gain_times_radiance_plus_offset(hazy):
    expected = 12 * hazy.planes["radiance_lwir"].astype(float) - 5

    assert hazy.planes["counts_lwir"] == pytest.approx(expected, rel=3e-7)  # a rounding or two


def test_the_mean_radiance_is_the_band_radiance_over_its_width(program, radiance, tmp_path):
    got = program.render(tmp_path, render={"radiance": "mean"})

    expected = radiance.band_planck(8, 14, 300) / 6
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)
    assert got.header["data units"] == "W m-2 sr-1 um-1"
    # of the radiance in band all the same: DESIGN.md
    assert got.planes["counts_lwir"] == pytest.approx(6 * expected, rel=BAND)
    assert got.planes["apparent_temperature_lwir_c"] == pytest.approx(26.85, abs=0.01)


@pytest.mark.parametrize("mode", ["exact", "thesis"])
def test_the_emissivity_plane_holds_the_stated_one(program, tmp_path, mode):
    got = program.render(tmp_path, material=GREY, render={"mode": mode})

    assert got.planes["emissivity_lwir"] == pytest.approx(0.7, rel=1e-6)  # float32 sums


def test_thesis_mode_radiates_with_the_thesis_constants(program, radiance, tmp_path):
    band = [{"name": "b", "wavelength_um": [9.9, 10.1]}]
    (tmp_path / "exact").mkdir()
    (tmp_path / "thesis").mkdir()
    exact = program.render(tmp_path / "exact", band=band).planes["radiance_b"]
    thesis = program.render(tmp_path / "thesis", band=band,
                            render={"mode": "thesis"}).planes["radiance_b"]

    # h 6.626176e-34, k 1.380662e-23, c 2.99792458e8: printed below eq. 2.4-5
    h, k, c = 6.626176e-34, 1.380662e-23, 2.99792458e8
    expected = radiance.band_planck(9.9, 10.1, 300, first=2 * h * c * c * 1e24,
                                    second=1e6 * h * c / k)
    ratio = expected / radiance.band_planck(9.9, 10.1, 300)
    assert ratio - 1 == pytest.approx(-1.58e-5, abs=1e-6)
    assert thesis.astype(float) / exact - 1 == pytest.approx(ratio - 1, abs=2e-6)  # float32 sums


# A black box of 10 m at 350 K on a plane of 100 m, seen from 10 km straight down: pixels of 1 m.
BOX = ("usemtl box\nv -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nv -5 -5 10\nv 5 -5 10\nv 5 5 10\n"
       "v -5 5 10\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
DOWN = {"position_m": [0.0, 0.0, 10000.0], "target_m": [0.0, 0.0, 0.0], "focal_length_mm": 3600.0,
        "pixels": [100, 100]}


@pytest.fixture(scope="module")
def boxed(program, tmp_path_factory):
    site = {"latitude_deg": 40.0, "longitude_deg": -80.0, "time": "1992-06-21T08:00:00-05:00"}
    got = program.render(
        tmp_path_factory.mktemp("box"), meshes={"plane.obj": program.plane, "box.obj": BOX},
        geometry=[{"file": "plane.obj"}, {"file": "box.obj"}], site=site, camera=DOWN,
        atmosphere=sky(sun_irradiance_w_m2_um=50.0),
        material=[{"name": "wall", "emissivity": 0.6, "temperature_k": 300.0},
                  {"name": "box", "emissivity": 1.0, "temperature_k": 350.0}],
        render={"hemisphere_step_deg": {"zenith": 3, "azimuth": 3}})
    got.sun = sun(program, site)
    return got


def ground_points():
    """Centres of the pixels on the plane: east, north, shape (rows, columns)."""
    metres = np.arange(100) - 49.5
    return np.meshgrid(metres, -metres)


def is_shaded(east, north, sun_rad):
    """Does the beam from (east, north, 0) to the sun pass through the box? Slabs, in double."""
    zenith, azimuth = sun_rad
    along = [np.sin(zenith) * np.sin(azimuth), np.sin(zenith) * np.cos(azimuth), np.cos(zenith)]
    near, far = np.zeros_like(east), np.full_like(east, 10 / along[2])
    for at, step in ((east, along[0]), (north, along[1])):
        ends = np.sort([(-5 - at) / step, (5 - at) / step], axis=0)
        near, far = np.maximum(near, ends[0]), np.minimum(far, ends[1])
    return near < far


def test_the_shadow_of_a_box_lies_where_the_sun_puts_it(boxed):
    east, north = ground_points()
    moved = [is_shaded(east + x, north + y, boxed.sun)
             for x in (-0.02, 0.02) for y in (-0.02, 0.02)]  # float32 at 10 km, twice
    sure = (boxed.planes["material"] == 1) & (np.sum(moved, axis=0) % 4 == 0)

    assert np.count_nonzero(sure & moved[0]) > 50
    assert (boxed.planes["sunlit"][sure] == ~moved[0][sure]).all()


def test_the_morning_shadow_lies_in_the_west(boxed):
    east, _ = ground_points()
    assert np.pi / 4 < boxed.sun[1] < 3 * np.pi / 4

    shaded = (boxed.planes["sunlit"] == 0) & (boxed.planes["material"] == 1)
    assert east[shaded].mean() < -5


def wall_share(distance_m, half_width_m, height_m):
    """Share of a level point's cosine-weighted hemisphere that a wall in front of its middle hides:
    two rectangles at right angles to it (Howell, catalogue B-4)."""
    c, slant = distance_m, np.hypot(distance_m, height_m)
    return (np.arctan(half_width_m / c) - c / slant * np.arctan(half_width_m / slant)) / np.pi


@pytest.mark.parametrize("distance_m", [1.5, 4.5, 20.5])
def test_the_shape_factor_before_a_wall_is_the_closed_form(boxed, distance_m):
    column = int(50 + 5 + distance_m - 0.5)  # the pixel's centre is that far from the wall
    both = boxed.planes["shape_factor"][49:51, column]  # half a metre off the wall's middle

    assert both == pytest.approx(1 - wall_share(distance_m, 5, 10), abs=0.01)  # cells of 3 degrees


def test_the_background_near_a_wall_is_the_wall(boxed):
    planes = {name: value[49:51, 57:60] for name, value in boxed.planes.items()}

    assert (planes["background_material"] == 2).all()
    assert planes["background_temperature_c"] == pytest.approx(76.85, abs=1e-3)
    assert planes["background_emissivity_lwir"] == pytest.approx(1, rel=1e-6)


def test_a_wall_lights_the_ground_as_the_shape_factor_says(boxed, radiance):
    planes = {name: value[49:51, 57].astype(float) for name, value in boxed.planes.items()}
    lit = 50 * 6 / np.pi * np.cos(boxed.sun[0]) * planes["sunlit"]
    around = (1 - planes["shape_factor"]) * radiance.band_planck(8, 14, 350)

    expected = 0.6 * radiance.band_planck(8, 14, 300) + 0.4 * (lit + around)
    assert planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


# Four quarters of the plane by their corner: north-west, north-east, south-west, south-east.
QUARTERS = "".join(
    f"usemtl {name}\nv {w} {s} 0\nv {w + 50} {s} 0\nv {w + 50} {s + 50} 0\nv {w} {s + 50} 0\n"
    "f -4 -3 -2 -1\n"
    for name, w, s in (("nw", -50, 0), ("ne", 0, 0), ("sw", -50, -50), ("se", 0, -50)))


@pytest.mark.parametrize("position_m, top_left, top_right, bottom_left, bottom_right", [
    ([0.0, 0.0, 200.0], "nw", "ne", "sw", "se"),
    ([0.0, -100.0, 100.0], "nw", "ne", "sw", "se"),
    ([100.0, 0.0, 100.0], "sw", "nw", "se", "ne"),
    ([0.0, 100.0, 100.0], "se", "sw", "ne", "nw"),
])
def test_the_picture_is_not_mirrored(program, tmp_path, position_m, top_left, top_right,
                                     bottom_left, bottom_right):
    names = ["nw", "ne", "sw", "se"]
    got = program.render(
        tmp_path, meshes={"plane.obj": QUARTERS},
        material=[{"name": n, "emissivity": 1.0, "temperature_k": 300.0} for n in names],
        camera={"position_m": position_m, "focal_length_mm": 200.0, "pixels": [4, 4]})

    seen = np.array(names)[got.planes["material"].astype(int) - 1]
    corners = [seen[0, 0], seen[0, -1], seen[-1, 0], seen[-1, -1]]
    assert corners == [top_left, top_right, bottom_left, bottom_right]
