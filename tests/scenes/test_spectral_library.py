"""The libraries of measured spectra: appendix_c.toml and table_d1.toml."""
import re

import envi
import numpy as np
import pytest
from built_program import ROOT, radsig, write_scene

LIBRARY = ROOT / "scenes" / "library"
FILES = [LIBRARY / "appendix_c.toml", LIBRARY / "table_d1.toml"]


def shown(name):
    """What `radsig material show` prints: means by range, and the angles at 10 um."""
    done = radsig("material", "show", name, *FILES)
    assert done.returncode == 0, done.stderr
    means = dict(re.findall(r"emissivity +(.*) um ([\d.]+)\n", done.stdout))
    angles = re.search(r"85 degrees (.*)", done.stdout).group(1).split()
    return {k: float(v) for k, v in means.items()}, [float(x) for x in angles], done.stdout


def test_they_hold_the_34_materials_and_the_22_rows():
    done = radsig("material", "list", *FILES)

    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) == 34 + 22 and sum("_1992" in line for line in lines) == 22


@pytest.mark.parametrize("path", sorted((LIBRARY / "spectra").glob("*.csv")), ids=lambda p: p.stem)
def test_every_table_is_short_and_says_where_it_comes_from(path):
    lines = path.read_text().splitlines()

    assert len(lines) < 120
    assert any(line.startswith("# Source: ") for line in lines)
    assert any(line.startswith("# Ranges: ") for line in lines)


# Normal emissivities as published, means of ranges; the heads of the tables cite them
@pytest.mark.parametrize("name, what, expected, within", [
    ("grass", "8 to 14", .983, 1e-3), ("grass", "3 to 5", .986, 1e-3),
    ("plant_leaf", "8 to 14", .977, 1e-3), ("soil", "3 to 5", .804, 1e-3),
    ("old_asphalt", "8 to 14", .945, .015), ("brick", "8 to 14", .93, .015),
    ("concrete", "8 to 14", .94, .015), ("sand", "8 to 14", .90, .03),
    ("plexiglass", "8 to 14", .955, .01), ("plexiglass", "3 to 5", .965, .01),
    ("metallic_paint", "8 to 14", .44, 1e-3), ("grey_panel_1", "8 to 14", .78, 1e-3),
])
def test_ranges_have_their_published_means(name, what, expected, within):
    assert shown(name)[0][what] == pytest.approx(expected, abs=within)


def test_water_aluminium_and_glass_are_fresnels():
    """Hale and Querry at 10 um, 0 and 60 degrees; Rakic; Rubin, soda-lime glass at 10 um."""
    angles = shown("water")[1]
    assert angles[0] == pytest.approx(.98982, abs=5e-4) and angles[2] == pytest.approx(.96124, abs=1e-3)
    assert shown("polished_aluminium")[1][0] == pytest.approx(.01240, abs=5e-4)
    assert shown("glass")[1][0] == pytest.approx(.795, abs=.005)


def test_heat_and_radiance_of_the_rows_of_table_d1_agree_or_the_difference_is_told():
    for name in ("asphalt_1992", "red_1992", "grey_3_1992"):
        text = shown(name)[2]
        assert re.search(r"absorptance .* for heat; the spectrum over sunlight .*[+-]0\.0\d\d", text), text


def test_quartz_has_its_doublets_and_carbonate_its_band():
    table = {p.stem: np.loadtxt(p, delimiter=",", skiprows=8, comments="#") for p in
             (LIBRARY / "spectra" / "sand.csv", LIBRARY / "spectra" / "gravel.csv")}
    at = lambda name, um: np.interp(um, table[name][:, 0], table[name][:, 1])

    assert at("sand", 8.63) > at("sand", 8.3) + .02 and at("sand", 8.63) > at("sand", 9.05) + .02
    assert at("sand", 12.66) > at("sand", 12.55) + .003 and at("sand", 12.66) > at("sand", 12.8) + .01
    assert at("gravel", 11.3) < at("gravel", 10.8) - .01 and at("gravel", 11.3) < at("gravel", 11.8) - .02


def test_grass_looks_green_and_soil_brown(tmp_path):
    plane = "".join(f"usemtl {name}\nv {x} -50 0\nv {x + 50} -50 0\nv {x + 50} 50 0\nv {x} 50 0\nf -4 -3 -2 -1\n"
                    for name, x in (("grass", -50), ("soil", 0)))
    day = {"sky_temperature_k": 1.0, "sky_radiance_w_m2_sr_um": 100.0, "sun_irradiance_w_m2_um": 1000.0,
           "transmission": 1.0, "path_temperature_k": 1.0}
    edges = {"blue": [.45, .52], "green": [.52, .60], "red": [.60, .69]}
    scene = write_scene(tmp_path, {"plane.obj": plane}, atmosphere={"uniform": day},
                        library={"materials": str(FILES[0])},
                        material=[{"name": n, "temperature_k": 290.0} for n in ("grass", "soil")],
                        band=[{"name": n, "wavelength_um": e} for n, e in edges.items()])

    done = radsig("render", scene, "-o", tmp_path / "out", "--set", "render.radiance=mean")

    assert done.returncode == 0, done.stderr
    planes = envi.read(tmp_path / "out" / "plane")[1]
    colour = lambda column: [planes[f"radiance_{n}"][3, column] for n in ("red", "green", "blue")]
    red, green, blue = colour(1)
    assert green > 1.3 * red and green > 1.5 * blue
    red, green, blue = colour(6)
    assert red > 1.1 * green and green > 1.1 * blue
