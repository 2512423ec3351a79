"""Results that cannot be: radsig ends with 1, names what has them, and writes nothing."""
import pytest

MATTER = {"emissivity": 1.0, "thickness_cm": 5.0, "density_kg_m3": 2000.0,
          "specific_heat_j_kg_k": 900.0, "conductivity_w_m_k": 1.0}
WEATHER = {"air_temperature_sunrise_c": 15.0, "air_temperature_peak_c": 29.0, "peak_time_h": 15.0,
           "relative_humidity_sunrise": .9, "wind_m_s": 2.0}
HIDDEN = "o tank\ng lid\nusemtl steel\nv 0 0 -5\nv 1 0 -5\nv 1 1 -5\nf 1 2 3\n"


def refused(program, folder, *options, **changes):
    """What render says of a scene that it must not finish."""
    done = program.run("render", program.write_scene(folder, **changes), "-o", folder / "out", *options)

    assert done.returncode == 1 and not (folder / "out").exists()
    return done.stderr


@pytest.mark.parametrize("mode", ["exact", "thesis"])
@pytest.mark.parametrize("thermal", ["therm", "layered"])
def test_a_facet_colder_than_1_k_is_named(program, tmp_path, mode, thermal):
    said = refused(program, tmp_path, geometry=[{"file": "plane.obj", "power_w_m2": -30000.0}],
                   material=[{"name": "wall", **MATTER}], weather=WEATHER,
                   render={"thermal": thermal, "mode": mode})

    assert "plane.obj: face 0 of object plane, part part, material wall: found a temperature of" in said
    assert "expected 1 to 6000 K" in said


def test_a_facet_that_no_pixel_shows_is_named_too(program, tmp_path):
    said = refused(program, tmp_path, meshes={"plane.obj": program.plane, "tank.obj": HIDDEN},
                   geometry=[{"file": "plane.obj"}, {"file": "tank.obj", "power_w_m2": -30000.0}],
                   material=[{"name": name, **MATTER} for name in ("wall", "steel")],
                   weather=WEATHER, render={"thermal": "therm"})

    assert "tank.obj: face 1 of object tank, part lid, material steel: found a temp" in said


@pytest.mark.parametrize("mode", ["exact", "thesis"])
@pytest.mark.parametrize("power, kelvin", [(-3000.0, "1"), (1e6, "20")])  # a heat pump of 3 kW; (1e6 / sigma)^(1/4) = 2049 K
def test_power_that_no_surface_has_is_warned_about_with_the_facet_s_name(program, tmp_path, mode, power, kelvin):
    scene = program.write_scene(tmp_path, geometry=[{"file": "plane.obj", "power_w_m2": power}], material=[{"name": "wall", **MATTER}],
                                weather=WEATHER, render={"thermal": "therm", "mode": mode})
    done = program.run("render", scene, "-o", tmp_path / "out")

    assert done.returncode == 0
    assert f"plane.obj: face 0 of object plane, part part, material wall: its power of {power:g} W/m2" in done.stderr
    assert f"takes it to {kelvin}" in done.stderr and "expected 228" in done.stderr  # 15 C less 60 K


def test_engines_and_coolers_are_not_warned_about(program, tmp_path):
    for power in (-150.0, 2e4, 2e5):  # (2e5 / sigma)^(1/4) = 1370 K
        scene = program.write_scene(tmp_path, geometry=[{"file": "plane.obj", "power_w_m2": power}], material=[{"name": "wall", **MATTER}],
                                    weather=WEATHER, render={"thermal": "therm"})
        assert "its power" not in program.run("render", scene, "-o", tmp_path / "out").stderr


def test_a_plane_that_is_not_finite_is_named_with_its_facet(program, tmp_path):
    # 1e9 W m-2 um-1 of sun times a gain of 1e30 is beyond a float
    said = refused(program, tmp_path, atmosphere={"uniform": {
        **program.vacuum, "sun_irradiance_w_m2_um": 1e9}}, material=[
            {"name": "wall", "emissivity": .5, "temperature_k": 300.0}],
        band=[{"name": "lwir", "wavelength_um": [8.0, 14.0], "gain": 1e30}])

    assert "material wall: found inf in the plane counts_lwir, expected a finite number" in said


def test_what_nobody_asked_for_is_not_looked_at(program, tmp_path):
    scene = program.write_scene(tmp_path, atmosphere={"uniform": {
        **program.vacuum, "sun_irradiance_w_m2_um": 1e9}}, material=[
            {"name": "wall", "emissivity": .5, "temperature_k": 300.0}],
        band=[{"name": "lwir", "wavelength_um": [8.0, 14.0], "gain": 1e30}])

    done = program.run("render", scene, "-o", tmp_path / "out", "--planes", "range_m")

    assert done.returncode == 0, done.stderr


def test_a_sensor_s_plane_that_is_not_finite_is_named(program, tmp_path):
    # shot noise of 1e-44 electrons a radiance: its variance is beyond a float
    said = refused(program, tmp_path, sensor={"electrons_per_w_m2_sr": 1e-44})

    assert "sensor_lwir: found " in said and "expected a finite number" in said


def test_surfaces_of_1_k_and_6000_k_are_rendered(program, tmp_path):
    for kelvin in (1.0, 6000.0):
        got = program.render(tmp_path, material=[
            {"name": "wall", "emissivity": 1.0, "temperature_k": kelvin}])
        assert got.planes["temperature_c"] == pytest.approx(kelvin - 273.15, abs=1e-3)


def test_radsig_thermal_refuses_them_too(program, tmp_path):
    # does not radiate, so that air alone cools 1e6 W/m2
    (tmp_path / "list.mat").write_text("1\nslab\n1\n.22\n5.93\n2.114\n0\n.9\n0\n-.5\nx.ems\nx.ext\n")
    rows = "".join(f"{i / 4} 20.0 1013.0 .60 -1 2.0 0 0 1 0 0 0 0\n" for i in range(97))
    (tmp_path / "day.wth").write_text("97 .25\n" + rows)

    done = program.run("thermal", "--materials", tmp_path / "list.mat", "--material", "slab",
                       "--weather", tmp_path / "day.wth", "--site", "43,-77", "--date", "1992-06-23",
                       "--utc-offset", "-4", "--thickness-cm", "5", "--power-w-m2", "1e6")

    assert done.returncode == 1 and done.stdout == ""
    assert "found a temperature of" in done.stderr and "expected 1 to 6000 K" in done.stderr


def test_emitted_longwave_that_no_surface_has_is_refused(program, tmp_path):
    rows = "".join(f"{i},20,1000,2,5,0,0,{up},400\n" for i, up in enumerate([400] * 23 + [1]))
    (tmp_path / "day.csv").write_text(
        "time [h],air_temperature [C],pressure [hPa],wind [m/s],dew_point [C],direct [W/m2],"
        "diffuse [W/m2],longwave_up [W/m2],longwave_down [W/m2]\n" + rows)
    done = program.run(
        "validate", "thermal", tmp_path / "day.csv", "--site", "43,-77", "--date", "1992-06-23",
        "--utc-offset", "-4", "--solar-absorptance", ".8", "--thermal-emissivity", ".9",
        "--thickness-cm", "10", "--conductivity-w-m-k", "1", "--heat-capacity-j-m3-k", "2e6")

    assert done.returncode == 1 and "record 24: longwave_up of 1" in done.stderr
