"""Exact mode: what surrounds a surface, ray by ray, against closed forms. Tolerance of bands: 2e-4."""
import numpy as np
import pytest

BAND = 2e-4
LWIR = (8.0, 14.0)

# A room of 4 x 4 x 4 m, its six quads each of a material of its own.
ROOM = """v -2 -2 0
v 2 -2 0
v 2 2 0
v -2 2 0
v -2 -2 4
v 2 -2 4
v 2 2 4
v -2 2 4
usemtl floor
f 1 2 3 4
usemtl ceiling
f 5 8 7 6
usemtl south
f 1 5 6 2
usemtl east
f 2 6 7 3
usemtl north
f 3 7 8 4
usemtl west
f 4 8 5 1
"""
WALLS = ["floor", "ceiling", "south", "east", "north", "west"]
INSIDE = {"position_m": [1.1, -0.7, 3.0], "target_m": [-0.9, 0.8, 0.5], "focal_length_mm": 12.0,
          "pixels": [24, 20]}

# A floor between two walls that reach far beyond sight, east and west of it; open at no direction
# that the grid of the hemisphere samples: every azimuth meets the wall of its side.
CANYON = """v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
v 2 -1e5 -1
v 2 1e5 -1
v 2 1e5 1e5
v 2 -1e5 1e5
v -2 -1e5 -1
v -2 1e5 -1
v -2 1e5 1e5
v -2 -1e5 1e5
usemtl floor
f 1 2 3 4
usemtl east
f 5 8 7 6
usemtl west
f 9 10 11 12
"""
DOWN = {"position_m": [0.0, 0.0, 1.5], "target_m": [0.0, 0.0, 0.0], "focal_length_mm": 300.0,
        "pixels": [4, 4]}


def materials(emissivity, temperature_k, **more):
    return [{"name": n, "emissivity": e, "temperature_k": t, **more.get(n, {})}
            for n, e, t in zip(WALLS, emissivity, temperature_k)]


def sky(program, **changes):
    return {"uniform": {**program.vacuum, **changes}}


@pytest.mark.parametrize("emissivity", [0.05, 0.5, 0.93])
@pytest.mark.parametrize("specular_share", [0.0, 1.0])
def test_an_enclosure_of_one_temperature_is_black(program, radiance, tmp_path, emissivity,
                                                  specular_share):
    walls = materials([emissivity] * 6, [300.0] * 6)
    walls[0]["specular_share"] = specular_share

    got = program.render(tmp_path, meshes={"room.obj": ROOM}, geometry=[{"file": "room.obj"}],
                         material=walls, camera=INSIDE)

    expected = radiance.band_planck(*LWIR, 300)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def test_a_room_under_a_sky_of_its_temperature_is_invisible(program, radiance, tmp_path):
    open_room = ROOM.replace("usemtl ceiling\nf 5 8 7 6\n", "")
    walls = materials([0.1, 1, 0.3, 0.5, 0.7, 0.9], [280.0] * 6)

    got = program.render(tmp_path, meshes={"room.obj": open_room}, geometry=[{"file": "room.obj"}],
                         material=walls, camera=INSIDE,
                         atmosphere=sky(program, sky_temperature_k=280.0))

    expected = radiance.band_planck(*LWIR, 280)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def test_nothing_of_the_sky_comes_into_a_closed_room(program, tmp_path):
    got = program.render(tmp_path, "--planes", "reflected_sky_lwir", meshes={"room.obj": ROOM},
                         geometry=[{"file": "room.obj"}],
                         material=materials([0.3] * 6, [300.0] * 6), camera=INSIDE,
                         atmosphere=sky(program, sky_radiance_w_m2_sr_um=4.0))

    assert (got.planes["reflected_sky_lwir"] == 0).all()  # exactly, by the sum's order


def canyon(program, folder, *options, emissivity=(0.4, 1.0, 1.0, 1.0, 1.0, 1.0), east_k=350.0,
           west_k=250.0, **changes):
    walls = materials(emissivity, [1.0, 1.0, 1.0, east_k, 1.0, west_k])
    got = program.render(folder, *options, meshes={"canyon.obj": CANYON},
                         geometry=[{"file": "canyon.obj"}], material=walls, camera=DOWN, **changes)
    return got.planes


def test_each_wall_brings_its_own_radiance(program, radiance, tmp_path):
    planes = canyon(program, tmp_path)

    # The floor is at 1 K and reflects .6 of the mean of two black walls, each half of its view.
    walls = 0.5 * (radiance.band_planck(*LWIR, 350) + radiance.band_planck(*LWIR, 250))
    assert planes["radiance_lwir"] == pytest.approx(0.6 * walls, rel=BAND)


def test_the_thesis_takes_the_radiance_of_the_mean_temperature(program, radiance, tmp_path):
    planes = canyon(program, tmp_path, "--mode", "thesis")

    # The thesis' constants of Planck's law change 3e-5.
    expected = 0.6 * radiance.band_planck(*LWIR, 300)
    assert planes["radiance_lwir"] == pytest.approx(expected, rel=BAND)


def test_each_wall_brings_its_own_emissivity(program, radiance, tmp_path):
    planes = canyon(program, tmp_path, emissivity=(0.4, 1, 1, 0.8, 1, 0.2), west_k=350.0)

    # A wall sees the other one; what it does not emit is closed by black at its own temperature.
    assert planes["radiance_lwir"] == pytest.approx(0.6 * radiance.band_planck(*LWIR, 350), rel=BAND)


def test_a_wall_in_the_sun_lights_the_floor(program, tmp_path):
    """The sun stands in the west and lights the east wall; the west wall is taken away."""
    site = {"latitude_deg": 0.0, "longitude_deg": 0.0, "time": "1992-03-20T16:00:00+00:00"}
    zenith, azimuth = np.radians([float(x) for x in program.run(
        "sun", "--site=0,0", "--time", site["time"]).stdout.splitlines()[1].split(",")[1:3]])
    one_wall = CANYON.replace("usemtl west\nf 9 10 11 12\n", "")
    walls = materials([0.4, 1, 1, 0.3, 1, 1], [1.0] * 6)

    got = program.render(tmp_path, meshes={"wall.obj": one_wall}, geometry=[{"file": "wall.obj"}],
                         material=walls, camera=DOWN, site=site,
                         atmosphere=sky(program, sun_irradiance_w_m2_um=50.0))

    on_wall = 50 / np.pi * -np.sin(azimuth) * np.sin(zenith)  # the wall's normal points west
    on_floor = 50 / np.pi * np.cos(zenith)
    expected = 0.6 * 6 * (on_floor + 0.5 * 0.7 * on_wall)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=1e-3)  # float32 at 1e5 m


def test_a_wall_sends_on_the_sky_it_sees(program, tmp_path):
    """An endless wall beside an open floor sees half of an isotropic sky above it and nothing else."""
    one_wall = CANYON.replace("usemtl west\nf 9 10 11 12\n", "")
    walls = materials([0.4, 1, 1, 0.3, 1, 1], [1.0] * 6)

    got = program.render(tmp_path, meshes={"wall.obj": one_wall}, geometry=[{"file": "wall.obj"}],
                         material=walls, camera=DOWN,
                         atmosphere=sky(program, sky_radiance_w_m2_sr_um=8.0))

    # A uniform sky goes all round: the wall's own share of it is 1.
    expected = 0.6 * 6 * (0.5 * 8 + 0.5 * 0.7 * 8)
    assert got.planes["radiance_lwir"] == pytest.approx(expected, rel=1e-3)


def open_sky(database, normal):
    """Irradiance over pi of the database's sky on a tilted plane: 1 degree cells, per point."""
    total = np.zeros(database.sky.shape)
    for zenith in np.radians(np.arange(0.5, 90)):
        for azimuth in np.radians(np.arange(0.5, 360, 3)):
            direction = (np.sin(zenith) * np.sin(azimuth), np.sin(zenith) * np.cos(azimuth),
                         np.cos(zenith))
            cosine = max(0.0, np.dot(direction, normal))
            solid_angle = np.sin(zenith) * np.radians(1) * np.radians(3)
            total += database.sky_at(direction) * cosine * solid_angle / np.pi
    return total


@pytest.mark.parametrize("tilt_deg, east, north", [(0, 0, 0), (35, 1, 0), (35, -1, 0), (70, 0, 1)])
def test_a_tilted_plane_reflects_the_open_sky(program, database, tmp_path, tilt_deg, east, north):
    tilt = np.radians(tilt_deg)
    normal = np.array([np.sin(tilt) * east, np.sin(tilt) * north, np.cos(tilt)])
    across = np.array([0.0, 1, 0]) if east else np.array([1.0, 0, 0])
    up = np.cross(normal, across)
    corners = [s * across + t * up for s, t in ((-9, -9), (9, -9), (9, 9), (-9, 9))]
    if np.dot(np.cross(corners[1] - corners[0], corners[2] - corners[0]), normal) < 0:
        corners.reverse()
    mesh = "usemtl floor\n" + "".join("v %.9g %.9g %.9g\n" % tuple(c) for c in corners)
    walls = materials([0.2, 1, 1, 1, 1, 1], [1.0] * 6)

    got = program.render(
        tmp_path, meshes={"tilted.obj": mesh + "f 1 2 3 4\n"}, geometry=[{"file": "tilted.obj"}],
        material=walls, camera={**DOWN, "position_m": [0.0, 0.0, 9000.0], "focal_length_mm": 1e5},
        site={"ground_material": "ceiling", "time": "1992-06-21T00:30:00-04:00"},
        atmosphere={"database": str(program.airport / "june24_1500z.rad")},
        band=[{"name": "lwir", "wavelength_um": [8.0, 13.3]}])

    um, look_up = database.grid(8.0, 13.3)
    tau2, path = database.path_at(0.0)
    spectrum = look_up(tau2) * 0.8 * look_up(open_sky(database, normal)) + look_up(path)
    expected = np.sum(0.5 * (spectrum[1:] + spectrum[:-1]) * np.diff(um))
    # 72 cells and the correction to the open sky; 5e-4 of the reflected part is what it may err by.
    reflected = expected - np.sum(0.5 * (look_up(path)[1:] + look_up(path)[:-1]) * np.diff(um))
    assert got.planes["radiance_lwir"] == pytest.approx(expected, abs=2e-3 * reflected)
    assert got.planes["interaction"] == pytest.approx(1)


def test_parts_of_the_radiance_are_their_closed_forms(program, radiance, tmp_path):
    """A grey plane under sky and sun through a path that halves: each part on its own."""
    names = ["emitted", "reflected_sun", "reflected_sky", "reflected_background", "path"]
    site = {"latitude_deg": 0.0, "longitude_deg": 0.0, "time": "1992-03-20T12:00:00+00:00"}
    zenith = np.radians(float(program.run(
        "sun", "--site=0,0", "--time", site["time"]).stdout.splitlines()[1].split(",")[1]))
    got = program.render(
        tmp_path, "--planes", ",".join(f"{n}_lwir" for n in names) + ",transmission_lwir",
        material=[{"name": "wall", "emissivity": 0.7, "temperature_k": 310.0}], site=site,
        atmosphere=sky(program, sky_radiance_w_m2_sr_um=4.0, sun_irradiance_w_m2_um=30.0,
                       transmission=0.5, path_temperature_k=280.0))

    expected = {"emitted": 0.5 * 0.7 * radiance.band_planck(*LWIR, 310),
                "reflected_sun": 0.5 * 0.3 * 6 * 30 / np.pi * np.cos(zenith),
                "reflected_sky": 0.5 * 0.3 * 6 * 4, "reflected_background": 0,
                "path": 0.5 * radiance.band_planck(*LWIR, 280)}
    for name in names:
        assert got.planes[f"{name}_lwir"] == pytest.approx(expected[name], rel=BAND, abs=1e-6)
    assert got.planes["transmission_lwir"] == pytest.approx(0.5, rel=1e-6)
    parts = sum(got.planes[f"{n}_lwir"].astype(float) for n in names)
    assert parts == pytest.approx(got.planes["radiance_lwir"].astype(float), rel=1e-5)
