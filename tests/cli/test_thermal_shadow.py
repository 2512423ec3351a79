"""Pixels and their own history of sun and shadow: a box on a level plane through a summer day."""
import numpy as np
import pytest

BOX = """usemtl ground
v -50 -50 0
v 50 -50 0
v 50 50 0
v -50 50 0
f 1 2 3 4
usemtl box
v -5 -5 0
v 5 -5 0
v 5 5 0
v -5 5 0
v -5 -5 10
v 5 -5 10
v 5 5 10
v -5 5 10
f 9 10 11 12
f 5 6 10 9
f 6 7 11 10
f 7 8 12 11
f 8 5 9 12
"""
MATTER = {"emissivity": 0.93, "density_kg_m3": 2114.0, "specific_heat_j_kg_k": 920.0,
          "conductivity_w_m_k": 0.689, "thickness_cm": 5.0, "exposed_area": -0.5}
WEATHER = {"air_temperature_sunrise_c": 15.0, "air_temperature_peak_c": 29.0, "peak_time_h": 15.0,
           "relative_humidity_sunrise": 0.9, "wind_m_s": 2.0}
SITE = {"latitude_deg": 40.0, "longitude_deg": -75.0, "time": "1992-06-21T14:00:00-05:00"}


def scene(**changes):
    return {"site": SITE, "weather": WEATHER, "meshes": {"plane.obj": BOX},
            "material": [{"name": "ground", **MATTER}, {"name": "box", **MATTER}],
            "camera": {"position_m": [0.0, 0.0, 10000.0], "target_m": [0.0, 0.0, 0.0],
                       "focal_length_mm": 3600.0, "pixels": [100, 100]},
            "render": {"thermal": "therm"}, **changes}


@pytest.fixture(scope="module", params=["therm", "layered"])
def planes(request, program, tmp_path_factory):
    return program.render(tmp_path_factory.mktemp("shadow"),
                          **scene(render={"thermal": request.param})).planes


def at(planes, name, east, north):
    return planes[name][round(49.5 - north), round(49.5 + east)]


def test_ground_far_from_the_box_has_the_temperature_of_its_facet_s_sun(planes):
    """Far in the south nothing ever stands before the sun."""
    far = planes["temperature_c"][90:, 40:60]

    assert np.ptp(far) < 1e-3  # equal histories, computed once
    assert planes["hours_lit_24h"][90:, 40:60].min() == planes["hours_lit_24h"].max()


def test_ground_that_was_in_shadow_in_the_morning_is_still_cooler(planes):
    """At two in the afternoon the ground just west of the box is lit, and was not before noon."""
    lit, shaded_before = at(planes, "sunlit", -7.5, 0.5), at(planes, "temperature_c", -7.5, 0.5)

    assert lit == 1
    assert shaded_before < planes["temperature_c"][95, 50] - 1


def test_shade_is_never_hotter(planes):
    ground = planes["material"] == planes["material"][95, 50]

    assert planes["temperature_c"][ground].max() == pytest.approx(
        planes["temperature_c"][95, 50], abs=1e-3)


def test_ground_just_west_of_the_box_is_lit_since_noon(planes):
    """Half a metre from a wall 10 m high the sun, 73 degrees high, comes round it 10 degrees before
    south: at 11:48, between the steps of 11:45 and 12:00."""
    assert at(planes, "minutes_since_sun_change", -5.5, 0.5) == 127.5


def test_tiles_do_not_change_temperatures(program, tmp_path):
    small = program.render(tmp_path, "--size", "10x10", **scene()).planes["temperature_c"]
    again = program.render(tmp_path, "--size", "10x10", **scene()).planes["temperature_c"]

    assert (small == again).all()


@pytest.mark.parametrize("change, message", [
    ({"layers": []}, "expected 1 to 3 tables"),
    ({"layers": [{"thickness_cm": 1}]}, "conductivity_w_m_k"),
    ({"back_temperature_c": 10}, 'needs back = "stated" or "ground"'),
    ({"back": "snow"}, "snow")])
def test_wrong_layers_are_refused(program, tmp_path, change, message):
    what = scene(render={"thermal": "layered"})
    what["material"][0] = {**what["material"][0], **change}
    done = program.run("check", program.write_scene(tmp_path, what.pop("meshes"), **what))

    assert done.returncode == 1 and message in done.stderr


def test_layers_of_one_material_are_a_thicker_facet(program, tmp_path):
    beneath = {k: MATTER[k] for k in ("density_kg_m3", "specific_heat_j_kg_k",
                                      "conductivity_w_m_k")}
    thick = scene(render={"thermal": "layered"})
    thick["material"][0] = {**thick["material"][0], "thickness_cm": 30.0}
    layered = scene(render={"thermal": "layered"})
    layered["material"][0] = {**layered["material"][0],
                              "layers": [{"thickness_cm": 25.0, **beneath}]}

    one, two = (program.render(tmp_path, "--size", "20x20", **s).planes["temperature_c"]
                for s in (thick, layered))

    assert abs(one - two).max() < 1e-3


@pytest.mark.parametrize("model", ["therm", "layered"])
def test_snow_gets_no_warmer_than_0_c(program, tmp_path, model):
    snowy = scene(render={"thermal": model})
    snowy["material"][0] = {**snowy["material"][0], "melting_temperature_c": 0.0}

    done = program.render(tmp_path, "--size", "20x20", **snowy)

    ground = done.planes["temperature_c"][done.planes["material"] == done.planes["material"][0, 0]]
    assert ground.max() == pytest.approx(0.0, abs=1e-3)  # a June noon, float32
    assert done.planes["temperature_c"].max() > 30  # the box does not melt


def test_backgrounds_have_their_own_shade_in_exact_mode_alone(program, tmp_path):
    """Thesis, Figure 3-9: there the sun is on them at all hours."""
    # Off the middle, so that no ray runs along an edge of the box, where a wall is met from behind in
    # exact mode alone.
    camera = {**scene()["camera"], "position_m": [0.37, 0.21, 10000.0],
              "target_m": [0.37, 0.21, 0.0]}
    thesis, exact = (
        program.render(tmp_path, "--size", "40x40", **scene(camera=camera, render={
            "thermal": "therm", "mode": mode})).planes["background_temperature_c"]
        for mode in ("thesis", "exact"))

    def two_warmest_walls(picture):
        """The modes' rays are others and a pixel has the mean of what they met; most met one wall alone."""
        values, counts = np.unique(picture[picture > 40], return_counts=True)
        return np.sort(values[np.argsort(counts)[-2:]])

    difference = two_warmest_walls(exact) - two_warmest_walls(thesis)
    # nodes, start and air differ between the modes too, by some thousandths at two in the afternoon
    assert difference[0] < -0.05 and abs(difference[1]) < 0.01


@pytest.mark.parametrize("model", ["therm", "layered"])
def test_power_that_is_switched_on_warms_its_material_alone(program, tmp_path, model):
    """600 W/m2 since eight in the morning, none by night; facets send each other nothing."""
    render = {"thermal": model, **({"facet_longwave": False} if model == "layered" else {})}
    cold, warm = (scene(render=render) for _ in range(2))
    warm["material"][1] = {**warm["material"][1], "power_w_m2_by_hour": [[8, 600.0], [20, 0]]}
    before, after = (program.render(tmp_path, "--size", "50x50", **s).planes["temperature_c"]
                     for s in (cold, warm))

    rise = after - before
    assert rise[25, 25] > 10  # the roof
    assert rise[45, 25] == 0  # the ground


@pytest.mark.parametrize("pairs", [[], [[8]], [[8, 1], [7, 1]], [[25, 1]], 500])
def test_a_wrong_table_of_power_is_refused(program, tmp_path, pairs):
    what = scene()
    what["material"][0] = {**what["material"][0], "power_w_m2_by_hour": pairs}
    done = program.run("check", program.write_scene(tmp_path, what.pop("meshes"), **what))

    assert done.returncode == 1 and "power_w_m2_by_hour" in done.stderr


def test_a_history_that_begins_after_the_image_has_the_sun_of_the_day_before_it(program, tmp_path):
    row = "{:.2f} 20 1013 .6 -1 2 0 0 1 0 0 0 0\n"
    (tmp_path / "late.wth").write_text("40 .25\n" + "".join(row.format(14.25 + i / 4) for i in range(40)))
    what = scene(render={"thermal": "fixed"}, material=[
        {"name": n, "emissivity": .9, "temperature_k": 300.0} for n in ("ground", "box")])

    del what["weather"]
    late, without = (program.render(tmp_path, "--size", "20x20", **what, **weather).planes
                     for weather in ({"weather": {"history": "late.wth"}}, {}))

    for name in ("hours_lit_24h", "minutes_since_sun_change"):
        assert (late[name] == without[name]).all()
