"""Projections and parts of the frame, against closed forms and the whole frame."""
import numpy as np
import pytest

WALL = {"name": "wall", "emissivity": 1.0, "temperature_k": 300.0}
OVERHEAD = {"projection": "orthographic", "width_m": 16.0, "focal_length_mm": None,
            "pixels": [32, 24]}
# a plate of 4 m, 30 m above the plane, its south-west corner above the origin
PLATE = "usemtl plate\nv 0 0 30\nv 4 0 30\nv 4 4 30\nv 0 4 30\nf 1 2 3 4\n"


def oblique(**changes):
    return {"position_m": [0.0, -100.0, 100.0], "target_m": [0.0, 0.0, 0.0], **OVERHEAD, **changes}


def test_an_orthographic_picture_shows_sizes_whatever_their_distance(program, tmp_path):
    got = program.render(
        tmp_path, meshes={"plane.obj": program.plane, "plate.obj": PLATE},
        geometry=[{"file": "plane.obj"}, {"file": "plate.obj"}], camera=OVERHEAD,
        material=[WALL, {"name": "plate", "emissivity": 1.0, "temperature_k": 300.0}])

    expected = np.ones((24, 32))
    expected[4:12, 16:24] = 2  # pixels of .5 m; north is up, east is right
    assert (got.planes["material"] == expected).all()
    assert got.planes["range_m"] == pytest.approx(np.where(expected == 2, 30, 60), rel=1e-6)


def test_orthographic_rays_are_parallel(program, tmp_path):
    got = program.render(tmp_path, camera=oblique())

    assert got.planes["view_angle_deg"] == pytest.approx(45, abs=1e-3)
    up = (12 - np.arange(24) - 0.5) * 0.5  # in the picture: half of the way is further
    expected = np.repeat((100 * 2**.5 + up)[:, None], 32, axis=1)
    assert got.planes["range_m"] == pytest.approx(expected, rel=1e-6)


# A mirror below a plate that begins 1 m in the east: from 5 m up a pinhole would see it from 1/3 m on.
def test_orthographic_rays_are_mirrored_in_parallel(program, tmp_path):
    plate = "usemtl plate\nv 1 -50 10\nv 90 -50 10\nv 90 50 10\nv 1 50 10\nf 4 3 2 1\n"
    got = program.render(
        tmp_path, meshes={"plane.obj": program.plane, "plate.obj": plate},
        geometry=[{"file": "plane.obj"}, {"file": "plate.obj"}],
        camera={**OVERHEAD, "position_m": [0.0, 0.0, 5.0]},
        material=[{**WALL, "specular_share": 1.0, "emissivity": 0.5},
                  {"name": "plate", "emissivity": 1.0, "temperature_k": 300.0}])

    east = np.tile((np.arange(32) - 15.5) * 0.5, (24, 1))
    assert (got.planes["interaction"] == np.where(east > 1, 3, 2)).all()


BOX = ("usemtl box\nv -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nv -5 -5 10\nv 5 -5 10\nv 5 5 10\n"
       "v -5 5 10\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")


@pytest.mark.parametrize("mode", ["exact", "thesis"])
@pytest.mark.parametrize("camera", [
    {"position_m": [40.0, -60.0, 50.0], "focal_length_mm": 40.0}, oblique(width_m=40.0)])
def test_a_part_of_the_frame_has_the_frame_s_own_pixels(program, tmp_path, camera, mode):
    def planes(name, **part):
        (tmp_path / name).mkdir()
        return program.render(
            tmp_path / name, meshes={"plane.obj": program.plane, "box.obj": BOX},
            geometry=[{"file": "plane.obj"}, {"file": "box.obj"}],
            material=[{**WALL, "emissivity": 0.8}, {"name": "box", "emissivity": 0.6,
                                                    "temperature_k": 320.0,
                                                    "specular_share": 1.0}],
            atmosphere={"uniform": {**program.vacuum, "sun_irradiance_w_m2_um": 50.0}},
            render={"mode": mode}, camera={**camera, "pixels": [40, 30], **part}).planes

    whole, part = planes("whole"), planes("part", crop=[13, 7, 17, 11])

    assert len(np.unique(part["material"][~np.isnan(part["material"])])) == 2
    for name, values in part.items():
        assert values.shape == (11, 17)
        assert values.tobytes() == whole[name][7:18, 13:30].tobytes(), name


@pytest.mark.parametrize("camera, expected", [
    ({"projection": "flat"}, 'expected "perspective" or "orthographic"'),
    ({"projection": "orthographic", "focal_length_mm": None}, "width_m: missing"),
    ({"width_m": 3.0}, "camera.width_m: unknown key"),
    ({**OVERHEAD, "focal_length_mm": 50.0}, "focal_length_mm: unknown key"),
    ({"crop": [0, 0, 9, 6]}, "within 8 x 6 pixels"),
    ({"crop": [0, 4, 8, 3]}, "within 8 x 6 pixels"),
    ({"crop": [0, 0, 0, 3]}, "within 8 x 6 pixels"),
    ({"crop": [0, 0.5, 3, 3]}, "expected whole numbers"),
])
def test_a_wrong_camera_is_refused(program, tmp_path, camera, expected):
    done = program.run("check", program.write_scene(tmp_path, camera=camera))

    assert done.returncode == 1 and expected in done.stderr and "scene.toml:" in done.stderr
