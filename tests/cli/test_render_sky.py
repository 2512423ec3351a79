"""radsig render under the airport's radiance database: missed rays, the ground plane, mirrors, a
scene of 1994 files, and the airport itself. Expected radiances are read from the .rad file in
double, linear between its points as docs/file-formats.md has them."""
import numpy as np
import pytest

LWIR = [{"name": "lwir", "wavelength_um": [8.0, 13.3]}]
BAND = 2e-4  # band integration, float32 tables
SPECK = "usemtl wall\nv -1 -9 0\nv 1 -9 0\nv 1 -8 0\nv -1 -8 0\nf 1 2 3 4\n"
NIGHT = {"time": "1992-06-21T00:30:00-05:00"}


def under_database(program, **changes):
    """Arguments of a scene under the airport's sky with a speck of geometry at z = 0."""
    return {"meshes": {"plane.obj": SPECK}, "band": LWIR,
            "atmosphere": {"database": str(program.airport / "june24_1500z.rad")},
            "material": [{"name": "wall", "emissivity": 0.9, "temperature_k": 300.0},
                         {"name": "ground", "emissivity": 0.8, "temperature_k": 290.0}],
            "site": {"ground_material": "ground"}, **changes}


def band_of(database, values):
    wavelength, look_up = database.grid(8.0, 13.3)
    return np.trapz(look_up(values), wavelength)


def test_the_sky_overhead_and_at_the_horizon_is_the_database(database):
    zenith, horizon = band_of(database, database.sky_at([0, 0, 1])), band_of(
        database, database.direction[6, 0])

    assert zenith == pytest.approx(17.07, abs=0.01)  # LOWTRAN 7, four digits
    assert horizon == pytest.approx(43.76, abs=0.01)


@pytest.mark.parametrize("target_m, focal_length_mm", [
    ([0.0, 0.0, 100.0], 40.0), ([0.0, 60.0, 40.0], 30.0), ([80.0, -20.0, 60.0], 30.0),
    ([-50.0, 0.0, 30.0], 40.0),
])
def test_a_missed_ray_sees_the_sky_of_its_direction(program, radiance, database, tmp_path,
                                                    target_m, focal_length_mm):
    camera = {"position_m": [0.0, 0.0, 2.0], "target_m": target_m,
              "focal_length_mm": focal_length_mm, "pixels": [12, 9]}
    directions = radiance.pixel_directions(**camera)

    got = program.render(tmp_path, **under_database(program, camera=camera))

    above = directions[..., 2] > 0.01
    expected = [band_of(database, database.sky_at(d)) for d in directions[above]]
    assert len(expected) > 50
    assert got.planes["radiance_lwir"][above] == pytest.approx(expected, rel=BAND)
    assert (got.planes["interaction"][above] == 0).all()
    assert np.isnan(got.planes["range_m"][above]).all()
    assert np.isnan(got.planes["temperature_c"][above]).all()


def turning_sky():
    """A database, as text, whose sky is flat in wavelength: zenith i x 15, azimuth k x 30 degrees
    give 1 + i + k/16 W m-2 sr-1 um-1 (k 12 is k 0)."""
    points = 3
    lines = ["1.0", "7.936508", "13.513514", "740.0", "1260.0", "260.0", f"{points}"]
    lines += ["0.0", "80.0", "80.0", "80.0", "2"]
    lines += [f"{1e4 / w:.6f} {w} 0.0 1.0" for w in (1260.0, 1000.0, 740.0)]
    for zenith in (0, 80):
        lines += [f"{zenith}.0 1.0"] + ["1.0 0.0 0.0"] * points
    lines += ["1e-4 0.0"] * points
    for i in range(7):
        for k in range(13):
            radiance_w_cm2 = 1e-4 * (1 + i + k % 12 / 16)
            lines += [f"{15 * i}.0 {30 * k}.0"] + [f"{radiance_w_cm2:.9e} 0.0"] * points
    return "\n".join([*lines, "1", "0.0 290.0"]) + "\n"


@pytest.mark.parametrize("target_m", [[0, 9, 3], [9, 2, 3], [1, -9, 3], [-9, 1, 3], [-3, 5, 3]])
def test_azimuths_of_the_sky_run_clockwise_from_north(program, radiance, tmp_path, target_m):
    (tmp_path / "turning.rad").write_text(turning_sky())
    camera = {"position_m": [0.0, 0.0, 0.0], "target_m": target_m, "focal_length_mm": 90.0,
              "pixels": [4, 3]}
    directions = radiance.pixel_directions(**camera)
    azimuth = np.degrees(np.arctan2(directions[..., 0], directions[..., 1])) % 360 / 30
    zenith = np.degrees(np.arccos(directions[..., 2])) / 15
    turned = np.interp(azimuth, range(13), [*range(12), 0])

    got = program.render(tmp_path, **under_database(
        program, camera=camera, atmosphere={"database": "turning.rad"})).planes

    expected = (1 + zenith + turned / 16) * (13.3 - 8.0)
    assert got["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def test_a_missed_ray_under_a_uniform_sky_sees_it_without_the_path(program, radiance, tmp_path):
    got = program.render(
        tmp_path, camera={"target_m": [0.0, 10.0, 100.0]},
        atmosphere={"uniform": {**program.vacuum, "sky_temperature_k": 260.0,
                                "sky_radiance_w_m2_sr_um": 0.5, "transmission": 0.3,
                                "path_temperature_k": 290.0}})

    expected = radiance.band_planck(8, 14, 260) + 0.5 * 6
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)
    assert np.isnan(got.planes["emissivity_lwir"]).all()
    assert (got.planes["interaction"] == 0).all()


def test_a_ray_that_leaves_downwards_meets_the_ground_plane(program, radiance, tmp_path):
    camera = {"position_m": [0.0, 0.0, 100.0], "target_m": [0.0, 80.0, 0.0],
              "focal_length_mm": 60.0, "pixels": [8, 6]}
    directions = radiance.pixel_directions(**camera)

    got = program.render(tmp_path, **under_database(program, camera=camera)).planes

    assert (got["material"] == 2).all() and (got["interaction"] == 1).all()
    assert np.isnan(got["facet"]).all()
    assert got["temperature_c"] == pytest.approx(290 - 273.15, abs=1e-3)
    assert got["range_m"] == pytest.approx(-100 / directions[..., 2], rel=1e-5)
    assert got["emissivity_lwir"] == pytest.approx(0.8, rel=1e-6)


def at_sensor(database, zenith_deg, surface):
    """Band radiance at the sensor of a surface's spectrum on the band's grid."""
    wavelength, look_up = database.grid(8.0, 13.3)
    tau2, path = (look_up(values) for values in database.path_at(zenith_deg))
    return np.trapz(surface * tau2 + path, wavelength)


def test_the_ground_at_night_is_emission_and_sky_through_the_path(program, radiance, database,
                                                                  tmp_path):
    camera = {"position_m": [0.0, 0.0, 10000.0], "target_m": [0.0, 10000.0, 0.0],
              "focal_length_mm": 1e5, "pixels": [2, 2]}
    site = {"ground_material": "ground", **NIGHT}
    wavelength, look_up = database.grid(8.0, 13.3)
    surface = 0.8 * radiance.planck(wavelength, 290) + 0.2 * look_up(database.sky)

    got = program.render(tmp_path, **under_database(program, camera=camera, site=site)).planes

    assert (got["sunlit"] == 0).all()
    assert got["radiance_lwir"] == pytest.approx(at_sensor(database, 45, surface), rel=BAND)


MIRROR = [{"name": "wall", "emissivity": 0.2, "specular_share": 1.0, "temperature_k": 280.0},
          {"name": "screen", "emissivity": 0.9, "temperature_k": 320.0}]
LEVEL = "usemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
SCREEN = "usemtl screen\nv 20 -50 0\nv 20 50 0\nv 20 50 90\nv 20 -50 90\nf 4 3 2 1\n"


@pytest.mark.parametrize("from_m, to_sky", [([60.0, 0.0, 80.0], [-60, 0, 80]),
                                            ([-30.0, 70.0, 60.0], [30, -70, 60])])
def test_a_mirror_shows_the_sky_of_the_mirrored_direction(program, radiance, database, tmp_path,
                                                          from_m, to_sky):
    camera = {"position_m": from_m, "focal_length_mm": 1e4, "pixels": [1, 1]}
    wavelength, look_up = database.grid(8.0, 13.3)
    surface = 0.2 * radiance.planck(wavelength, 280) + 0.8 * look_up(database.sky_at(to_sky))
    zenith_deg = np.degrees(np.arccos(from_m[2] / np.linalg.norm(from_m)))

    got = program.render(tmp_path, **under_database(
        program, camera=camera, material=MIRROR, meshes={"plane.obj": LEVEL}, site=NIGHT)).planes

    assert got["interaction"] == 2 and got["shape_factor"] == 1
    assert np.isnan(got["background_temperature_c"]).all()
    assert got["radiance_lwir"] == pytest.approx(at_sensor(database, zenith_deg, surface), rel=BAND)


@pytest.fixture(scope="module")
def mirrored_wall(program, tmp_path_factory):
    """A level mirror before a wall at 320 K in the east; seen from the west, 45 degrees up."""
    return program.render(
        tmp_path_factory.mktemp("mirror"), meshes={"plane.obj": LEVEL, "screen.obj": SCREEN},
        geometry=[{"file": "plane.obj"}, {"file": "screen.obj"}], material=MIRROR,
        render={"mode": "thesis"},
        camera={"position_m": [-30.0, 0.0, 30.0], "focal_length_mm": 400.0, "pixels": [4, 4]})


def test_a_mirror_shows_the_wall_that_the_mirrored_ray_meets(mirrored_wall, radiance):
    planes = mirrored_wall.planes
    wall = 0.9 * radiance.band_planck(8, 14, 320)  # eq. 2.4-1 without sun: it reflects nothing

    assert (planes["interaction"] == 3).all() and (planes["shape_factor"] == 0).all()
    assert planes["background_temperature_c"] == pytest.approx(46.85, abs=1e-3)
    assert (planes["background_material"] == 2).all()
    assert planes["background_emissivity_lwir"] == pytest.approx(0.9, rel=1e-6)
    assert planes["radiance_lwir"] == pytest.approx(
        0.2 * radiance.band_planck(8, 14, 280) + 0.8 * wall, rel=BAND)


@pytest.fixture(scope="module")
def of_1994(program, airport, database, tmp_path_factory):
    """A scene made of 1994 files alone: .snd .adv .sen .gdb .wth .rad .mat. The response is 1 at
    all points of the database, the gain 1 per W cm-2 sr-1."""
    folder = tmp_path_factory.mktemp("1994")
    points = len(database.wavenumber_cm1)
    (folder / "flat.sen").write_text(f"{points}\n1.0\n0.0\n" + "1.0\n" * points)
    path = program.write_scene(
        folder, name="old", meshes={"unused.obj": program.plane},
        site={"latitude_deg": None, "longitude_deg": None, "time": None,
              "node": str(airport.with_name("june24.snd")), "ground_material": "summergrass"},
        camera={"position_m": None, "target_m": None, "focal_length_mm": None, "pixels": None,
                "view": str(airport.with_name("foxbat.adv"))},
        geometry=[{"file": str(airport.with_name("airport.gdb"))}], material=[],
        library={"materials": str(program.root / "scenes" / "library" / "materials.mat")},
        weather={"history": str(program.root / "tests" / "cli" / "clear_june_1992.wth")},
        atmosphere={"database": str(airport.with_name("june24_1500z.rad"))},
        band=[{"name": "lwir", "sensor": "flat.sen"}],
        render={"thermal": "therm"})
    done = program.run("render", path, "-o", folder / "out", "--size", "32x32")
    assert done.returncode == 0, done.stderr
    return program.load(folder / "out", "old")


def test_the_files_of_1994_make_a_scene(of_1994):
    assert of_1994.planes["radiance_lwir"].shape == (32, 32)
    assert np.isfinite(of_1994.planes["radiance_lwir"]).all()
    assert of_1994.report["time"] == "1987-06-24T15:00:00Z"  # line 11 of the .snd is GMT
    # its line 13 is west-positive
    assert of_1994.report["site"]["longitude_deg"] == pytest.approx(-84.108888)
    names = " ".join(each["path"] for each in of_1994.report["inputs"])
    for extension in (".snd", ".adv", ".sen", ".gdb", ".wth", ".rad", ".mat", ".ems"):
        assert extension in names


def test_a_view_file_looks_at_its_target_from_its_distance(of_1994):
    # foxbat.adv: (7162.3865 - 90.6849, -6951.7077 - 119.9939, 10000), the ground near z = 0
    expected = np.sqrt(7071.7016**2 + 7071.7016**2 + 10000**2)

    assert of_1994.planes["range_m"][15:17, 15:17] == pytest.approx(expected, abs=20)


def test_the_gain_of_a_sensor_file_is_per_square_centimetre(of_1994):
    expected = 1e-4 * of_1994.planes["radiance_lwir"].astype(float)

    assert of_1994.planes["counts_lwir"] == pytest.approx(expected, rel=1e-6)


@pytest.fixture(scope="module")
def airfield(program, airport, tmp_path_factory):
    out = tmp_path_factory.mktemp("airport")
    done = program.run("render", airport, "-o", out, "--size", "64x64")
    assert done.returncode == 0, done.stderr
    return program.load(out, "airport")


def test_concrete_and_grass_radiate_35_to_60_w_m2_sr(airfield):
    numbers = {each["name"]: each["number"] for each in airfield.report["materials"]}
    values = airfield.planes["radiance_lwir"]

    for name in ("concrete/roadway", "summergrass"):
        seen = values[airfield.planes["material"] == numbers[name]]
        assert len(seen) > 100
        assert 35 < seen.min() and seen.max() < 60


def test_the_picture_without_its_path_is_as_warm_as_the_surfaces(airfield, radiance, database):
    # scenes/airport/scene.toml
    directions = radiance.pixel_directions([6951.7077, 7162.3865, 10000.0],
                                           [-119.9939, 90.6849, 0.0], 3790.47, [64, 64])
    dark = airfield.planes["emissivity_lwir"] > 0.95
    wavelength, look_up = database.grid(8.0, 13.3)
    temperature_k = np.linspace(250, 400, 601)
    black = [radiance.planck(wavelength, t) for t in temperature_k]
    assert np.count_nonzero(dark) > 1000

    zenith_deg = np.degrees(np.arccos(-directions[..., 2]))[dark]
    middle = np.median(zenith_deg)
    assert np.ptp(zenith_deg) < 0.6  # one path for all: its radiance changes by less than .5 %
    tau2, path = (look_up(values) for values in database.path_at(middle))
    at_sensor_of = [np.trapz(b * tau2 + path, wavelength) for b in black]
    found_k = np.interp(airfield.planes["radiance_lwir"][dark], at_sensor_of, temperature_k)

    assert found_k == pytest.approx(airfield.planes["temperature_c"][dark] + 273.15, abs=3)


def facet_normals(path):
    """The normals of a .gdb by facet id, in its own axes: x north, y west."""
    lines = path.read_text().splitlines()
    normals = []
    for at, line in enumerate(lines):
        if line == "FACE":
            corners = int(lines[at + 13])
            normals.append([float(x) for x in lines[at + 14 + corners].split()])
    return np.array(normals)


def test_facets_turned_to_the_sun_are_warmer_than_those_turned_away(airfield, airport, program):
    row = program.run("sun", "--site=39.773333,-84.108888", "--time",
                      "1987-06-24T10:00:00-05:00").stdout.splitlines()[1].split(",")
    zenith, azimuth = np.radians([float(x) for x in row[1:3]])
    to_sun = [np.sin(zenith) * np.cos(azimuth), -np.sin(zenith) * np.sin(azimuth), np.cos(zenith)]
    facet, index = np.unique(airfield.planes["facet"].astype("i8"), return_index=True)
    facet, index = facet[facet >= 0], index[facet >= 0]
    temperature_c = airfield.planes["temperature_c"].ravel()[index]

    towards = facet_normals(airport.with_name("airport.gdb"))[facet] @ to_sun > 0

    assert np.count_nonzero(towards) > 50 and np.count_nonzero(~towards) > 10
    assert temperature_c[towards].mean() > temperature_c[~towards].mean() + 1
