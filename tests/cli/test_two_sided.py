"""Sheets without a back: what the camera, the sun and the hemisphere meet of them from behind."""
import pytest

GROUND = "usemtl ground\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
NOON = {"latitude_deg": 23.44, "longitude_deg": 0.0, "time": "1992-06-21T12:02:00+00:00"}
VIEW = {"focal_length_mm": 85.0, "pixels": [8, 6]}
FROM_ABOVE = {**VIEW, "position_m": [0.0, 0.0, 60.0], "target_m": [0.0, 0.0, 0.0]}
FROM_BETWEEN = {**VIEW, "position_m": [0.0, 0.0, 9.0], "target_m": [0.0, 0.0, 0.0]}


def sheet(facing):
    """A level square of 40 m, 10 m above the ground."""
    corners = [(-20, -20), (20, -20), (20, 20), (-20, 20)][::1 if facing == "up" else -1]
    return "usemtl sheet\n" + "".join(f"v {x} {y} 10\n" for x, y in corners) + "f -4 -3 -2 -1\n"


@pytest.fixture
def under(program, tmp_path):
    """What a camera sees of the ground and a sheet over it."""

    def render(facing, camera, mode="exact", **of_sheet):
        materials = [{"name": "ground", "emissivity": 0.9, "temperature_k": 300.0},
                     {"name": "sheet", "emissivity": 0.9, "temperature_k": 280.0, **of_sheet}]
        return program.render(tmp_path, meshes={"plane.obj": GROUND + sheet(facing)}, site=NOON,
                              material=materials, camera=camera,
                              render={"thermal": "fixed", "mode": mode}).planes

    return render


@pytest.mark.parametrize("mode", ["exact", "thesis"])
@pytest.mark.parametrize("facing, two_sided, facet", [("up", False, 1), ("down", False, 0),
                                                      ("up", True, 1), ("down", True, 1)])
def test_the_camera_meets_a_sheet_from_behind_where_it_has_two_sides(under, mode, facing,
                                                                     two_sided, facet):
    """Thesis, eq. 2.3.2-6."""
    planes = under(facing, FROM_ABOVE, mode, two_sided=two_sided)

    assert (planes["facet"] == facet).all()
    # The nearest pixel is half a pixel of 1 in 19 off the axis.
    assert planes["range_m"].min() == pytest.approx((60, 50)[facet], rel=1e-3)


def test_a_sheet_seen_from_behind_turns_its_normal_to_the_camera_and_the_sky(under):
    planes = under("down", FROM_ABOVE, two_sided=True)

    assert planes["view_angle_deg"].max() < 30  # the picture's corner is 17 degrees off its middle
    assert (planes["shape_factor"] == 1).all()
    assert (planes["sunlit"] == 1).all()


@pytest.mark.parametrize("mode, two_sided, lit", [("thesis", False, 1), ("thesis", True, 0),
                                                  ("exact", False, 0), ("exact", True, 0)])
def test_the_sun_shines_through_the_back_of_a_sheet_in_thesis_mode_alone(under, mode, two_sided,
                                                                         lit):
    """The sun is in the zenith: a ray to it meets the sheet from behind."""
    assert (under("up", FROM_BETWEEN, mode, two_sided=two_sided)["sunlit"] == lit).all()


@pytest.mark.parametrize("mode, two_sided, is_open", [
    ("thesis", False, True), ("thesis", True, False), ("exact", False, False),
    ("exact", True, False)])
def test_the_back_of_a_sheet_hides_the_sky_but_in_thesis_mode(under, mode, two_sided, is_open):
    factor = under("up", FROM_BETWEEN, mode, two_sided=two_sided)["shape_factor"]

    # 10 m under a square of 40 m it leaves the lowest two rings of six at most
    assert (factor == 1).all() if is_open else factor.max() < 0.5


@pytest.mark.parametrize("mode", ["exact", "thesis"])
def test_the_front_of_a_sheet_stops_every_ray(under, mode):
    planes = under("down", FROM_BETWEEN, mode)

    assert (planes["sunlit"] == 0).all() and planes["shape_factor"].max() < 0.5
