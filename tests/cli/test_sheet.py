"""Heat along sheets of one material, through renders of .gdb meshes; edges that are held at a
temperature are thin facets that state it."""
import numpy as np
import pytest

SITE = {"latitude_deg": 40.0, "longitude_deg": -75.0, "time": "1992-06-22T00:00:00+00:00"}
STEEL = {"density_kg_m3": 7833.0, "specific_heat_j_kg_k": 465.0, "conductivity_w_m_k": 54.0}
# So much better along it than into the air that the air does not count; nothing is stored.
PURE = {"density_kg_m3": 0.01, "specific_heat_j_kg_k": 1.0, "conductivity_w_m_k": 5000.0}
COMPUTED = -1
EDGE = 1e-5  # width of facets at an edge, m


def face(number, corners, temperature_c, thickness_cm, power_ly_h=0):
    """corners: east, north, up; counterclockwise from above."""
    east, north = np.array(corners)[:, :2].T
    area = 0.5 * abs(np.dot(east, np.roll(north, 1)) - np.dot(north, np.roll(east, 1)))
    lines = ["FACE", f"cell_{number}", f"1-1-{number}", "plate", "1", "none", str(temperature_c),
             str(thickness_cm), str(power_ly_h), "1.0", "null", "null", "null", str(len(corners))]
    lines += [f"{y!r} {-x!r} {z!r}" for x, y, z in corners[::-1]]  # the file's +x north, +y west
    return "\n".join([*lines, f"0 0 {area!r}", "0", "0", "0"])


def gdb(faces):
    return "\n".join(["OBJECT", "sheet", "1-0-0", "PART", "sheet", "1-1-0", *faces]) + "\n"


def cells(x, y, stated, thickness_cm, split=False):
    """Rectangles between borders x and y; stated(i, j) is a temperature or COMPUTED."""
    faces = []
    for j in range(len(y) - 1):
        for i in range(len(x) - 1):
            corners = [(x[i], y[j], 0.0), (x[i + 1], y[j], 0.0), (x[i + 1], y[j + 1], 0.0),
                       (x[i], y[j + 1], 0.0)]
            parts = [corners[:3], [corners[0], *corners[2:]]] if split else [corners]
            faces += [face(len(faces) + k + 1, part, stated(i, j), thickness_cm)
                      for k, part in enumerate(parts)]
    return gdb(faces)


def constant_weather(air_c, wind_m_s):
    head = ("time [h],air_temperature [C],pressure [hPa],wind [m/s],dew_point [C],"
            "direct [W/m2],diffuse [W/m2],longwave_down [W/m2]\n")
    return head + "".join(f"{i / 4},{air_c},1013,{wind_m_s},-20,0,0,300\n" for i in range(97))


def temperatures(program, folder, mesh, material, wind_m_s, low, high, columns, air_c=0.0, **render):
    """Temperatures seen from straight above between low and high, first row the northernmost."""
    width, height = np.subtract(high, low)
    middle = (np.array(low) + high) / 2
    rows = round(columns * height / width)
    (folder / "still.csv").write_text(constant_weather(air_c, wind_m_s))
    done = program.render(
        folder, meshes={"sheet.gdb": mesh}, site=SITE, weather={"history": "still.csv"},
        geometry=[{"file": "sheet.gdb"}],
        material=[{"name": "plate", "emissivity": 0.0, **material}],
        camera={"position_m": [*map(float, middle), 10.0], "target_m": [*map(float, middle), 0.0],
                "projection": "orthographic", "width_m": float(width), "pixels": [columns, rows],
                "focal_length_mm": None},
        render={"thermal": "layered", "mode": "exact", **render})
    return done.planes["temperature_c"]


def fin(program, folder, split=False, root_c=100, **render):
    """.9 mm of steel, 10 W/m2/K on both sides, air at 0 C."""
    x = np.concatenate([[-EDGE], np.linspace(0, 0.1, 41)])
    mesh = cells(x, [0, 0.0025], lambda i, j: root_c if i == 0 else COMPUTED, 0.09, split)
    return temperatures(program, folder, mesh, {**STEEL, "exposed_area": -1.0}, 4.3 / 3.8,
                        (0, 0), (0.1, 0.0025), 40, **render)[0]


@pytest.mark.parametrize("split", [False, True])
@pytest.mark.parametrize("mode, root_c", [("exact", 1), ("thesis", 100)])
def test_a_steel_fin_cools_to_its_tip_as_the_closed_form_says(program, tmp_path, split, mode, root_c):
    """At 1 C above the air free convection adds 0.1 % to the wind's."""
    along = fin(program, tmp_path, split, root_c, mode=mode)

    # 1 / cosh(m L), m^2 = 2 h / (k d); the last cell's middle is 1.25 mm from the tip: 3e-4 warmer
    assert along[-1] / root_c == pytest.approx(0.258566, rel=0.01 if split else 2e-3)
    assert (np.diff(along) < 0).all()


def test_without_lateral_conduction_a_fin_has_the_air_s_temperature(program, tmp_path):
    assert fin(program, tmp_path, lateral_conduction=False) == pytest.approx(0.0, abs=0.02)


def test_nafems_t4_a_plate_loses_heat_over_two_edges(program, tmp_path):
    """k 52, h 750 to 0 C, 100 C at the south, no heat through the west: 18.25 C at (.6, .2). A facet
    of 0 C whose middle is k / h beyond the border is what passes h there."""
    beyond = 2 * 52 / 750
    x = np.concatenate([np.linspace(0, 0.6, 25), [0.6 + beyond]])
    y = np.concatenate([[-EDGE], np.linspace(0, 1, 41), [1 + beyond]])

    def stated(i, j):
        return 100 if j == 0 else 0 if i == 24 or j == 41 else COMPUTED

    plane = temperatures(program, tmp_path, cells(x, y, stated, 1000), PURE, 0.0, (0, 0),
                         (0.6, 1.0), 24)

    border = plane[:, -1] * (beyond / 2) / (beyond / 2 + 0.0125)
    at_e = np.interp(0.2, np.linspace(0.0125, 0.9875, 40), border[::-1])
    assert at_e == pytest.approx(18.25, rel=0.01)  # NAFEMS' own bound


ISO_10211_1_CASE_1 = [
    [9.7, 13.4, 14.7, 15.1], [5.3, 8.6, 10.3, 10.8], [3.2, 5.6, 7.0, 7.5], [2.0, 3.6, 4.7, 5.0],
    [1.3, 2.3, 3.0, 3.2], [0.7, 1.4, 1.8, 1.9], [0.3, 0.6, 0.8, 0.9]]


def test_iso_10211_1_case_1_half_a_column_between_20_and_0_c(program, tmp_path):
    """Half of a square column 2 high: 20 C on top, 0 C at the left and below, symmetry at the
    right."""
    x = np.concatenate([[-EDGE], np.linspace(0, 1, 21)])
    y = np.concatenate([[-EDGE], np.linspace(0, 2, 41), [2 + EDGE]])

    def stated(i, j):
        return 20 if j == 41 else 0 if i == 0 or j == 0 else COMPUTED

    plane = temperatures(program, tmp_path, cells(x, y, stated, 1000), PURE, 0.0, (0, 0), (1, 2), 20)

    across = np.hstack([plane, plane[:, ::-1]])  # the other half
    at = lambda row, column: across[row - 1:row + 1, column - 1:column + 1].mean()
    points = [[at(5 * i, 5 * j) for j in range(1, 5)] for i in range(1, 8)]
    assert np.array(points) == pytest.approx(np.array(ISO_10211_1_CASE_1), abs=0.1)  # ISO's bound


def test_the_number_of_threads_changes_no_bit(program, tmp_path, monkeypatch):
    pictures = []
    for threads in (1, 2):
        monkeypatch.setenv("POCL_MAX_PTHREAD_COUNT", str(threads))
        pictures.append(fin(program, tmp_path))

    assert (pictures[0] == pictures[1]).all()
