"""Clouds that scatter, seen from both sides and by the ground below them, against two streams in numpy."""

import numpy as np
import pytest

from cloud_reference import two_streams

SUN, SKY, WIDTH_UM = 1000.0, 40.0, .1
UNIFORM = {"sky_temperature_k": 1.0, "sky_radiance_w_m2_sr_um": SKY, "sun_irradiance_w_m2_um": SUN,
           "transmission": 1.0, "path_temperature_k": 1.0}
PLANE = "usemtl wall\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
DEPTH_M = 10.0
G = .85


def slab(half_m):
    corners = [((-half_m, half_m)[i & 1], (-half_m, half_m)[i >> 1 & 1], (20, 30)[i >> 2]) for i in range(8)]
    faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    return "usemtl cloud\n" + "".join("v {} {} {}\n".format(*c) for c in corners) + "".join(
        "f {} {} {} {}\n".format(*f) for f in faces)


def table(albedo, asymmetry=G):
    rows = [f"{39850 - 100 * i},{albedo},{asymmetry}" for i in range(396)]
    return "\n".join(["# by hand", "wavenumber_cm1,single_scattering_albedo,asymmetry", *rows]) + "\n"


def scene(folder, albedo, per_km, emissivity=.5, half_m=40000, **changes):
    (folder / "cloud.csv").write_text(table(albedo))
    cloud = {"name": "cloud", "extinction_per_km": per_km, "temperature_k": 1.0,
             "scattering_file": "cloud.csv"}
    return {"meshes": {"plane.obj": PLANE, "slab.obj": slab(half_m)},
            "geometry": [{"file": "plane.obj"}, {"file": "slab.obj"}],
            "material": [{"name": "wall", "emissivity": emissivity, "temperature_k": 1.0}, cloud],
            "atmosphere": {"uniform": UNIFORM},
            "band": [{"name": "vis", "wavelength_um": [.5, .5 + WIDTH_UM]}], **changes}


ABOVE = {"position_m": [0.0, 0.0, 60.0], "focal_length_mm": 200.0, "pixels": [3, 3]}
BELOW = {"position_m": [0.0, 0.0, 15.0], "focal_length_mm": 35.0}


@pytest.fixture(scope="module")
def sun_up(program, tmp_path_factory):
    """Cosine of the sun's zenith angle, from a plane that the sun alone lights: .5 E / pi cos."""
    folder = tmp_path_factory.mktemp("sun")
    sky = {**UNIFORM, "sky_radiance_w_m2_sr_um": 0.0}
    got = program.render(folder, **scene(folder, 1, 0.0, atmosphere={"uniform": sky}, camera=BELOW))
    return np.median(got.planes["radiance_vis"]) / (.5 * SUN / np.pi * WIDTH_UM)


def source(depth, albedo, sun_up, ground, from_above):
    """J: what the two streams send, less what goes through unscattered, for each share it takes."""
    back, through, sun_back, sun_through = two_streams(depth, albedo, G, sun_up)
    straight = np.exp(-2 * depth)
    ahead, behind = (SKY, ground) if from_above else (ground, SKY)
    sun = sun_back if from_above else sun_through
    return ((through - straight) * behind + back * ahead + sun * sun_up * SUN / np.pi) / (1 - straight)


@pytest.mark.parametrize("albedo", [1.0, .95])
@pytest.mark.parametrize("emissivity", [None, .4], ids=["no ground plane", "ground plane"])
def test_from_above_a_cloud_sends_back_sun_sky_and_ground(program, tmp_path, sun_up, albedo, emissivity):
    site = {"ground_material": "wall"} if emissivity else {}

    got = program.render(tmp_path, **scene(tmp_path, albedo, 2000.0, emissivity or .5, camera=ABOVE, site=site))

    ground = (1 - emissivity) * (SUN * sun_up / np.pi + SKY) if emissivity else SKY
    expected = source(20.0, albedo, sun_up, ground, True) * WIDTH_UM
    assert expected > .2 * SUN / np.pi * WIDTH_UM  # white: the plane below has .5 at most
    assert got.planes["radiance_vis"][1, 1] == pytest.approx(expected, rel=1e-3)  # float32, sun_up


@pytest.mark.parametrize("per_km", [100.0, 1000.0])
def test_the_ground_below_a_wide_cloud_gets_what_two_streams_let_through(program, tmp_path, sun_up, per_km):
    steps = {"hemisphere_step_deg": {"zenith": 5, "azimuth": 30}, "thermal": "fixed"}

    got = program.render(tmp_path, **scene(tmp_path, 1.0, per_km, camera=BELOW, render=steps))

    depth = per_km * DEPTH_M / 1000
    below = source(depth, 1.0, sun_up, SKY, False)
    mu = (np.arange(20000) + .5) / 20000
    through = 2 * np.mean(mu * np.exp(-depth / mu))
    direct = np.exp(-depth / sun_up) * sun_up * SUN / np.pi
    expected = .5 * (direct + through * SKY + (1 - through) * below) * WIDTH_UM
    assert got.planes["radiance_vis"] == pytest.approx(expected, rel=5e-3)  # cells of 5 degrees


def test_from_below_a_cloud_before_the_sky_shows_what_it_lets_through(program, tmp_path, sun_up):
    up = {"position_m": [0.0, 0.0, 1.0], "target_m": [0.0, 0.0, 60.0], "focal_length_mm": 2000.0,
          "pixels": [3, 3]}

    got = program.render(tmp_path, **scene(tmp_path, 1.0, 100.0, camera=up))

    tau = np.exp(-1.0)
    expected = (tau * SKY + (1 - tau) * source(1.0, 1.0, sun_up, SKY, False)) * WIDTH_UM
    assert got.planes["radiance_vis"][1, 1] == pytest.approx(expected, rel=1e-3)


def test_from_inside_a_thick_cloud_is_bright_above_and_darker_below(program, tmp_path, sun_up):
    planes = []
    for name, target_m in ("down", 0.0), ("up", 60.0):
        (tmp_path / name).mkdir()
        camera = {"position_m": [0.0, 0.0, 25.0], "target_m": [0.0, 0.0, target_m],
                  "focal_length_mm": 200.0, "pixels": [3, 3]}
        got = program.render(tmp_path / name, **scene(tmp_path / name, 1.0, 4000.0, camera=camera))
        planes.append(got.planes["radiance_vis"][1, 1])

    # As from outside: down the top of the layer, up its base.
    expected = [source(40.0, 1.0, sun_up, SKY, above) * WIDTH_UM for above in (True, False)]
    assert planes == pytest.approx(expected, rel=1e-3)


def test_scattering_clouds_within_each_other_are_invisible_where_all_has_their_temperature(program, radiance, tmp_path):
    sky = {**UNIFORM, "sky_temperature_k": 280.0, "sky_radiance_w_m2_sr_um": 0.0, "sun_irradiance_w_m2_um": 0.0}
    changes = scene(tmp_path, .6, 60.0, half_m=30, atmosphere={"uniform": sky}, camera={"pixels": [8, 6]},
                    site={"ground_material": "wall"}, band=[{"name": "lwir", "wavelength_um": [8.0, 14.0]}])
    inner = slab(10).replace("cloud", "smoke").replace(" 20\n", " 24\n")
    changes["meshes"]["inner.obj"] = inner
    changes["geometry"] += [{"file": "inner.obj"}]
    changes["material"] += [{**changes["material"][1], "name": "smoke"}]
    for material in changes["material"]:
        material["temperature_k"] = 280.0

    got = program.render(tmp_path, **changes)

    assert got.planes["radiance_lwir"] == pytest.approx(radiance.band_planck(8, 14, 280), rel=2e-4)


def test_thesis_mode_knows_no_scattering(program, tmp_path):
    got = program.render(tmp_path, **scene(tmp_path, 1.0, 4000.0, camera=ABOVE,
                                           render={"mode": "thesis", "thermal": "fixed"}))

    assert got.planes["radiance_vis"][1, 1] == pytest.approx(0, abs=1e-6)  # 1 K


def check(program, folder, text, **cloud):
    changes = scene(folder, 1.0, 100.0)
    (folder / "cloud.csv").write_text(text)
    changes["material"][1] = {"name": "cloud", "scattering_file": "cloud.csv", **cloud}
    return program.run("check", program.write_scene(folder, **changes))


BODY = {"extinction_per_km": 1.0, "temperature_k": 280.0}


def test_a_table_of_scattering_with_an_albedo_above_1_is_refused(program, tmp_path):
    done = check(program, tmp_path, table(1).replace("39750,1,", "39750,1.5,"), **BODY)

    assert done.returncode == 1
    assert "cloud.csv:4: found '39750,1.5,0.85', expected single_scattering_albedo from 0 to 1" in done.stderr


def test_a_table_of_scattering_without_its_columns_is_refused(program, tmp_path):
    done = check(program, tmp_path, "39850 1 .8\n", **BODY)

    assert done.returncode == 1
    assert "cloud.csv:1:" in done.stderr and "single_scattering_albedo" in done.stderr


def test_an_opaque_material_that_states_scattering_is_refused(program, tmp_path):
    done = check(program, tmp_path, table(1), emissivity=1.0, temperature_k=280.0)

    assert done.returncode == 1
    assert "material cloud" in done.stderr and "scattering_file" in done.stderr
