"""Longwave from facet to facet, thermal = "layered": plates that see each other."""
import pytest
from test_sheet import SITE, constant_weather, face, gdb

# One temperature through and through, so little of it that it is settled at once.
THIN = {"density_kg_m3": 1.0, "specific_heat_j_kg_k": 100.0, "conductivity_w_m_k": 10.0,
        "solar_absorptance": 0.0}
LANGLEY_W_M2 = 11.622



def quad(low, high, z, up):
    (x0, y0), (x1, y1) = low, high
    corners = [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]
    return corners if up else corners[::-1]


def level(number, low, high, z, up, temperature_c=-1, power_w_m2=0.0, material="plate"):
    """A level facet; .gdb takes the side of a facet from its normal."""
    text = face(number, quad(low, high, z, True), temperature_c, 0.01, power_w_m2 / LANGLEY_W_M2)
    lines = text.split("\n")
    lines[3] = material
    if not up:
        lines[-4] = lines[-4].replace("0 0 ", "0 0 -")
        lines[-3] = "180"
    return "\n".join(lines)


def look(program, folder, faces, materials, air_c, **changes):
    """Straight down on the square of a metre at the origin, one pixel; temperature in C."""
    (folder / "still.csv").write_text(constant_weather(air_c, 0.0))
    done = program.render(
        folder, meshes={"plates.gdb": gdb(faces)}, site=SITE, weather={"history": "still.csv"},
        geometry=[{"file": "plates.gdb"}],
        material=[{**THIN, "name": name, "emissivity": e} for name, e in materials.items()],
        camera={"position_m": [0.5, 0.5, 5.0], "target_m": [0.5, 0.5, 0.0],
                "projection": "orthographic", "width_m": 0.1, "pixels": [1, 1],
                "focal_length_mm": None},
        render={"thermal": "layered", **changes})
    return done.planes["temperature_c"][0, 0]


@pytest.mark.parametrize("mode", ["exact", "thesis"])
def test_plates_of_400_and_300_k_exchange_644_w_m2(program, tmp_path, mode):
    """Emissivities .9 and .7, so wide that they see nothing else. The cold one sheds what it gets, and
    its air is as warm as it is, so that it stays at 300 K."""
    wide = ((-500, -500), (501, 501))
    faces = [level(1, *wide, 0.0, True, power_w_m2=-644.494, material="cold"),
             level(2, *wide, 10.0, False, temperature_c=400 - 273.15, material="hot")]
    materials = {"hot": 0.9, "cold": 0.7}

    cold_c = look(program, tmp_path, faces, materials, 300 - 273.15, mode=mode)

    # Settled to 2 W m-2, of which .7 are absorbed, over 10 W m-2 K-1
    assert cold_c == pytest.approx(300 - 273.15, abs=0.15)
    alone_c = look(program, tmp_path, faces, materials, 300 - 273.15, facet_longwave=False)
    assert alone_c < cold_c - 50


def test_a_facet_under_a_roof_sees_the_roof_instead_of_the_sky(program, tmp_path):
    """A roof as warm as the air: the floor has their temperature, whatever the sky (300 W m-2)."""
    wide = ((-500, -500), (501, 501))
    faces = [level(1, *wide, 0.0, True, material="floor"),
             level(2, *wide, 10.0, False, temperature_c=30.0, material="roof")]

    assert look(program, tmp_path, faces, {"floor": 0.9, "roof": 0.95}, 30.0) == pytest.approx(
        30.0, abs=0.05)  # float32, and the gap's edges


def test_a_lone_facet_sees_sky_alone(program, tmp_path):
    """Nothing changes where facets do not see each other."""
    faces = [level(1, (-5, -5), (6, 6), 0.0, True)]

    with_it, without = (look(program, tmp_path, faces, {"plate": 0.9}, 10.0, facet_longwave=key)
                        for key in (True, False))

    assert with_it == without
