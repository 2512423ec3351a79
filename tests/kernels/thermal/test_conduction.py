"""Heat along facets that touch: thin plates, one temperature through and through."""
import numpy as np
import pytest
import records
from test_layered import facet, steady

STEEL = (54.0, 7833.0 * 465.0)
COUNT, PLACES = 20, 32
THICK_M, AREA_M2, H = 1e-4, 0.02**2, 10.0


@pytest.fixture(scope="module", params=[16, 1])
def conduct(opencl, request):
    """Heat along facets, W m-2, shape (2 steps, places), of one patch."""
    def run(facets, links, forcing, lit=None, step_s=900.0):
        span = np.zeros(1, records.SPAN)
        words = 0 if lit is None else 3
        span[0] = (PLACES, 0, 0, words, 0, step_s, 0 if lit is None else 96, len(forcing))
        patch = {"patch_first": np.array([0, PLACES], np.uint32), "links": links,
                 "groups": np.zeros(PLACES, records.CONDUCTION_GROUP),
                 "numbers": np.zeros((9, PLACES), np.float32),
                 "progress": np.zeros(1, records.CONDUCTION_PROGRESS)}
        out = np.zeros((2 * len(forcing), PLACES), np.float32)
        while not patch["progress"]["is_done"][0]:
            opencl.run("conduction", (1,), options=f"-DRAY_LANES={request.param}", span=span, patch_count=1, facets=facets,
                       load={"forcing": forcing, "sunlit": lit, "power_materials": 0},
                       exchange={"lateral_columns": 0, "received_columns": 0}, patch=patch,
                       out_w_m2=out)
        return out.astype(float)

    return run


def strip(conductance_w_k, **values):
    """COUNT plates in a row; the last one touches the first one too."""
    facets = np.repeat(facet([(THICK_M, *STEEL)], **values), PLACES)
    facets["lateral_fraction"] = facets["capacity_j_m2_k"] / facets["capacity_j_m2_k"].sum(1)[:, None]
    links = np.zeros(PLACES, records.CONDUCTION)
    links["neighbour"], links["area_m2"] = records.NONE, AREA_M2
    for i in range(COUNT):
        links["neighbour"][i][:2] = (i + 1) % COUNT, (i - 1) % COUNT
        links["link_w_k"][i][:2] = conductance_w_k
    return facets, links


def bits(lit):
    """Words of a day that is the same at all hours; lit: a truth a place."""
    return np.repeat(np.where(lit, 0xFFFFFFFF, 0).astype(np.uint32)[None], 3, axis=0)


@pytest.mark.parametrize("conductance_w_k", [1e-4, 5.4e-3, 10.0])
def test_a_lit_plate_warms_its_neighbours_as_the_network_says(conduct, conductance_w_k):
    facets, links = strip(conductance_w_k, absorptance=1.0)
    lit = np.zeros(PLACES, bool)
    lit[3] = lit[11] = True

    heat = conduct(facets, links, steady(193, convection_w_m2_k=H, direct_w_m2=500.0), bits(lit))

    network = np.eye(COUNT) * (H * AREA_M2 + 2 * conductance_w_k)
    for i in range(COUNT):
        network[i, (i + 1) % COUNT] -= conductance_w_k
        network[i, (i - 1) % COUNT] -= conductance_w_k
    rise_k = np.linalg.solve(network, 500.0 * AREA_M2 * lit[:COUNT])
    expected = H * rise_k - 500.0 * lit[:COUNT]
    assert heat[383, :COUNT] == pytest.approx(expected, abs=0.5)  # .05 K of 10 W m-2 K-1


def test_what_one_plate_gives_another_one_gets(conduct):
    """The sum over the patch is none at all hours, with emission and a sun that moves."""
    facets, links = strip(5.4e-3, absorptance=0.9, emissivity=0.9)
    hour = np.arange(193) * 0.25
    forcing = steady(193, convection_w_m2_k=H, sky_longwave_w_m2=300.0)
    forcing["direct_w_m2"] = 800 * np.maximum(0, np.sin(2 * np.pi * (hour - 6) / 24))

    heat = conduct(facets, links, forcing, bits(np.arange(PLACES) % 3 == 0))[:384, :COUNT]

    assert abs(heat).max() > 100
    assert abs(heat.sum(axis=1)).max() < 1e-3 * abs(heat).sum(axis=1).max()


def test_plates_without_neighbours_get_nothing(conduct):
    facets, links = strip(0.0, absorptance=0.9)
    links["neighbour"] = records.NONE

    heat = conduct(facets, links, steady(193, convection_w_m2_k=H, direct_w_m2=500.0))

    assert abs(heat).max() < 1e-2  # W m-2; rounding of 300 K over the gain of a step


def test_a_neighbour_that_keeps_a_temperature_is_felt(conduct):
    facets, links = strip(0.0)
    links["neighbour"] = records.NONE
    links["stated_w_k"], links["stated_k"] = 2 * H * AREA_M2, 320.0

    heat = conduct(facets, links, steady(193, convection_w_m2_k=H))

    # 290 K air by H, 320 K by 2 H: 310 K, so that H times 20 K comes in
    assert heat[383, :COUNT] == pytest.approx(H * 20.0, abs=0.1)
