"""Air before, in and behind bodies, and along the ground: databases with grids, against closed forms."""
import container
import numpy as np
import pytest

LOW, HIGH = 8.0, 14.0
BAND = 2e-4  # band integration, float32 tables
HEIGHT_M = 2000.0  # docs/departures.md: what absorbs falls off by e in this height


class Air:
    """Grey air that thins by e in 2000 m, of one temperature; the sky has its own, or the air's."""

    def __init__(self, radiance, per_m, air_k, sky_k=None, sensor_m=10000.0):
        self.planck, self.per_m, self.air_k, self.sky_k = radiance.planck, per_m, air_k, sky_k
        self.sensor_m = sensor_m

    def depth(self, low_m, high_m):
        return self.per_m * HEIGHT_M * (np.exp(-low_m / HEIGHT_M) - np.exp(-high_m / HEIGHT_M))

    def of_depth(self, um, depth):
        tau = np.exp(-depth) * np.ones_like(um)
        return tau, (1 - tau) * self.planck(um, self.air_k)

    def sun(self, um):
        return 0 * um

    def sky(self, um, zenith_deg):
        return self.planck(um, self.sky_k or self.air_k)

    def path(self, um, altitude_m, zenith_deg):
        depth = self.depth(altitude_m, self.sensor_m) / np.cos(np.radians(zenith_deg))
        return self.of_depth(um, depth)

    def level(self, um, range_m):
        return self.of_depth(um, self.per_m * range_m)


WALL = "usemtl wall\nv -50 {0} 0\nv 50 {0} 0\nv 50 {0} 60\nv -50 {0} 60\nf 1 2 3 4\n"
GROUND = "usemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
CAMERA = {"position_m": [0.0, 0.0, 2.0], "target_m": [0.0, 100.0, 2.0], "focal_length_mm": 400.0,
          "pixels": [5, 3]}
RANGES_M = (100.0, 1000.0, 5000.0)


def seen_level(program, folder, air, range_m, **changes):
    container.write(folder / "air.radc", LOW, HIGH, air, ranges_m=RANGES_M)
    scene = dict(meshes={"wall.obj": WALL.format(range_m)}, geometry=[{"file": "wall.obj"}],
                 atmosphere={"database": "air.radc"}, camera=CAMERA)
    return program.render(folder, **{**scene, **changes})


# Between range 0 and the first run, between runs, and beyond the last.
@pytest.mark.parametrize("range_m", [40.0, 700.0, 4000.0, 20000.0])
def test_a_level_view_sees_through_the_air_of_its_range(program, radiance, tmp_path, range_m):
    air = Air(radiance, 2e-4, 280.0)
    camera = {**CAMERA, "target_m": [0.0, range_m, 30.0], "position_m": [0.0, 0.0, 30.0],
              "focal_length_mm": 20000.0}

    got = seen_level(program, tmp_path, air, range_m, camera=camera)

    tau = np.exp(-2e-4 * range_m * np.exp(-30 / HEIGHT_M))
    expected = tau * radiance.band_planck(LOW, HIGH, 300) + (1 - tau) * radiance.band_planck(
        LOW, HIGH, 280)
    assert got.planes["radiance_lwir"][1] == pytest.approx(expected, rel=BAND)


def test_from_the_ground_up_the_air_thins(program, radiance, tmp_path):
    lid = "usemtl wall\nv -50 -50 900\nv -50 50 900\nv 50 50 900\nv 50 -50 900\nf 1 2 3 4\n"
    camera = {**CAMERA, "target_m": [0.0, 0.0, 900.0]}

    got = seen_level(program, tmp_path, Air(radiance, 2e-4, 280.0), 1.0, meshes={"wall.obj": lid},
                     camera=camera)

    tau = np.exp(-2e-4 * HEIGHT_M * (np.exp(-2 / HEIGHT_M) - np.exp(-900 / HEIGHT_M)))
    expected = tau * radiance.band_planck(LOW, HIGH, 300) + (1 - tau) * radiance.band_planck(
        LOW, HIGH, 280)
    assert got.planes["radiance_lwir"][1, 2] == pytest.approx(expected, rel=BAND)


def test_where_all_has_one_temperature_a_level_view_shows_nothing(program, radiance, tmp_path):
    wide = {**CAMERA, "focal_length_mm": 20.0, "pixels": [9, 9]}
    wall = [{"name": "wall", "emissivity": .5, "temperature_k": 280.0}]

    got = seen_level(program, tmp_path, Air(radiance, 2e-4, 280.0), 300.0, camera=wide,
                     material=wall, site={"ground_material": "wall"})

    kinds = got.planes["interaction"]
    assert (kinds == 0).sum() > 20 and (kinds == 1).sum() > 20  # sky, and wall and ground
    assert got.planes["radiance_lwir"] == pytest.approx(radiance.band_planck(LOW, HIGH, 280), rel=BAND)


def test_thesis_mode_takes_the_path_of_the_zenith_angle(program, radiance, tmp_path):
    air = Air(radiance, 2e-4, 280.0)

    got = seen_level(program, tmp_path, air, 100.0, render={"mode": "thesis", "thermal": "fixed"})

    tau = np.exp(-air.depth(0, 10000) / np.cos(np.radians(80)))
    expected = tau * radiance.band_planck(LOW, HIGH, 300) + (1 - tau) * radiance.band_planck(
        LOW, HIGH, 280)
    assert got.planes["radiance_lwir"][1, 2] == pytest.approx(expected, rel=2e-2)  # sums points


def box(low, high, size=40.0):
    corners = [((-size, size)[i & 1], (-size, size)[i >> 1 & 1], (low, high)[i >> 2]) for i in range(8)]
    faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    return "usemtl cloud\n" + "".join("v {} {} {}\n".format(*c) for c in corners) + "".join(
        "f {} {} {} {}\n".format(*f) for f in faces)


DOWN = {"position_m": [0.0, 0.0, 10000.0], "target_m": [0.0, 0.0, 0.0], "focal_length_mm": 8000.0,
        "pixels": [3, 3]}


def over_a_cloud(program, folder, air, per_km, ranges_m=(), targets_m=(500.0, 1000.0, 3000.0),
                 middle_m=1000.0, camera=DOWN):
    container.write(folder / "air.radc", LOW, HIGH, air, targets_m=targets_m, ranges_m=ranges_m)
    cloud = {"name": "cloud", "extinction_per_km": per_km, "temperature_k": 260.0}
    wall = {"name": "wall", "emissivity": 1.0, "temperature_k": 310.0}
    return program.render(folder, meshes={"ground.obj": GROUND, "cloud.obj": box(middle_m - 10, middle_m + 10)},
                          geometry=[{"file": "ground.obj"}, {"file": "cloud.obj"}],
                          material=[wall, cloud], atmosphere={"database": "air.radc"}, camera=camera)


@pytest.mark.parametrize("per_km", [20.0, 1e5], ids=["thin", "opaque"])
def test_the_air_before_and_behind_a_cloud_is_that_of_its_altitude(program, radiance, tmp_path,
                                                                   per_km):
    air = Air(radiance, 3e-4, 285.0)

    got = over_a_cloud(program, tmp_path, air, per_km)

    b = lambda kelvin: radiance.band_planck(LOW, HIGH, kelvin)
    front, rear = np.exp(-air.depth(1000, 10000)), np.exp(-air.depth(0, 1000))
    own = np.exp(-per_km * .02)
    expected = (1 - front) * b(285) + front * ((1 - own) * b(260) + own * (
        (1 - rear) * b(285) + rear * b(310)))
    assert got.planes["radiance_lwir"][1, 1] == pytest.approx(expected, rel=BAND)


class Layered(Air):
    """All that absorbs lies between 2000 and 4000 m: far from an exponential column."""

    def depth(self, low_m, high_m):
        return self.per_m * max(0.0, min(high_m, 4000.0) - max(low_m, 2000.0))


def test_the_grid_of_altitudes_goes_before_the_exponential_column(program, radiance, tmp_path):
    air = Layered(radiance, 3e-4, 285.0)

    got = over_a_cloud(program, tmp_path, air, 1e5, targets_m=(1000.0, 2000.0, 4000.0), middle_m=3000.0)

    b = lambda kelvin: radiance.band_planck(LOW, HIGH, kelvin)
    front = np.exp(-3e-4 * 1000)  # half of the layer is above the cloud
    expected = (1 - front) * b(285) + front * b(260)
    assert got.planes["radiance_lwir"][1, 1] == pytest.approx(expected, rel=BAND)


def test_a_target_above_the_ground_has_less_air_before_it(program, radiance, tmp_path):
    air = Layered(radiance, 3e-4, 285.0)
    container.write(tmp_path / "air.radc", LOW, HIGH, air, targets_m=(1000.0, 2000.0, 4000.0))
    hill = GROUND.replace(" 0\n", " 3000\n")

    got = program.render(tmp_path, meshes={"plane.obj": hill}, atmosphere={"database": "air.radc"},
                         camera=DOWN)

    tau = np.exp(-3e-4 * 1000)
    expected = (1 - tau) * radiance.band_planck(LOW, HIGH, 285) + tau * radiance.band_planck(
        LOW, HIGH, 300)
    assert got.planes["radiance_lwir"][1, 1] == pytest.approx(expected, rel=BAND)


def test_from_the_ground_air_stands_before_a_cloud_in_the_sky(program, radiance, tmp_path):
    air = Air(radiance, 3e-4, 285.0, sky_k=250.0)
    camera = {**DOWN, "position_m": [0.0, 0.0, 2.0], "target_m": [0.0, 0.0, 1000.0]}

    got = over_a_cloud(program, tmp_path, air, 1e5, ranges_m=RANGES_M, camera=camera)

    b = lambda kelvin: radiance.band_planck(LOW, HIGH, kelvin)
    front = np.exp(-air.depth(2, 1000))
    assert got.planes["interaction"][1, 1] == 0
    assert got.planes["radiance_lwir"][1, 1] == pytest.approx((1 - front) * b(285) + front * b(260),
                                                              rel=BAND)


def test_a_grid_of_altitudes_above_the_sensor_is_refused(program, radiance, tmp_path):
    air = Layered(radiance, 3e-4, 285.0)
    container.write(tmp_path / "air.radc", LOW, HIGH, air, targets_m=(500.0, 12000.0))

    done = program.run("check", program.write_scene(tmp_path, atmosphere={"database": "air.radc"}))

    assert done.returncode == 1
    assert "air.radc" in done.stderr and "expected between ground and sensor" in done.stderr
