"""What reaches surfaces along the rays of their hemispheres, as 16 pixels of a CPU's work-item share the work,
and as single pixels of a GPU's go alone, against every ray in double precision."""
import numpy as np
import pytest
import records
from radiometry_reference import FIRST, SECOND, planck, unit

RINGS, AROUND, SAMPLES, COUNT, FACETS = 6, 12, 32, 83, 7
CELLS = RINGS * AROUND
ZENITHS, AZIMUTHS = 4, 7  # 30 and 60 degrees
LIT = 0x80000000
SETS, NEAR = 3, 12  # sets of directions, near facets
ROWS = records.PATHS + ZENITHS * AZIMUTHS
LOBE = 3 * 91  # rows of emissivity before those of the lobe of material 2


def grid(random):
    """Sets of directions in the frame of a facet, and weights of their cells: rings of equal projected solid angles,
    the lowest first."""
    down, along = random.random((2, SETS, RINGS, AROUND))
    level = np.sqrt((np.arange(RINGS)[::-1, None] + down) / RINGS)
    turn = (np.arange(AROUND) + along) * 2 * np.pi / AROUND
    cells = np.stack([level * np.cos(turn), level * np.sin(turn), np.sqrt(1 - level**2), 0 * level + 1 / CELLS], -1)
    return cells.reshape(SETS, CELLS, 4)


def dome():
    """The sky in points by Gauss' rule, as host/incident.h has it, with the table's corners around each."""
    gauss = np.array([0.5 - 0.5 / np.sqrt(3), 0.5 + 0.5 / np.sqrt(3)])
    z = (np.arange(ZENITHS - 1)[:, None] + gauss).ravel()
    a = (np.arange(AZIMUTHS - 1)[:, None] + gauss).ravel()
    z, a = (x.ravel() for x in np.meshgrid(z, a, indexing="ij"))
    down, turn = np.radians(z * 90 / (ZENITHS - 1)), np.radians(a * 360 / (AZIMUTHS - 1))
    points = np.zeros((12, -(-len(z) // 16) * 16))
    n = len(z)
    points[:4, :n] = np.sin(down) * np.sin(turn), np.sin(down) * np.cos(turn), np.cos(down), np.sin(down)
    for k in range(4):
        row, column = z.astype(int) + k // 2, a.astype(int) + k % 2
        points[4 + k, :n] = row * AZIMUTHS + column
        points[8 + k, :n] = (z % 1 if k // 2 else 1 - z % 1) * (a % 1 if k % 2 else 1 - a % 1)
    return points


class Case:
    """Random surfaces: of material 0 Lambertian, of 1 half a mirror, of 2 with a diffuse lobe."""

    def __init__(self, seed, is_sky_uniform=False, sees_sky=0.6, has_near=False):
        random = np.random.default_rng(seed)
        self.wavelength_um = np.linspace(8, 12, SAMPLES)
        self.cell, self.dome = grid(random), dome()
        self.facets = np.zeros(FACETS, records.FACET)
        self.facets["normal"] = unit(random.normal(size=(FACETS, 3)))
        self.facets["material"] = np.arange(FACETS) % 3
        self.materials = np.zeros(3, records.MATERIAL)
        self.materials["emissivity_first"], self.materials["emissivity_angles"] = np.arange(3) * 91, 91
        self.materials["specular_share"], self.materials["lobe_first"] = (0, 0.5, 0), (records.NONE, records.NONE, LOBE)
        self.emissivity = random.uniform(0.1, 0.9, (LOBE + 1 + RINGS, SAMPLES))
        self.temperature_k = random.uniform(270, 320, FACETS)
        self.background = np.zeros(FACETS, records.BACKGROUND)
        self.background["shape_factor"] = random.uniform(0, 1, FACETS)
        self.spectra = random.uniform(1, 3, (ROWS, SAMPLES))
        self.spectra[records.PLANCK_FIRST] = FIRST / self.wavelength_um**5
        self.spectra[records.PLANCK_SECOND] = SECOND / self.wavelength_um
        if is_sky_uniform:
            self.spectra[records.PATHS:] = self.spectra[records.PATHS]
        self.light = random.uniform(0, 1, (FACETS, 5, SAMPLES // 4))
        self.hit = np.zeros(COUNT, records.HIT)
        normal = unit(random.normal(size=(COUNT, 3)))
        normal[:, 2] = np.abs(normal[:, 2])
        self.hit["normal"] = np.repeat(normal, 3, 0)[:COUNT]  # neighbours are alike
        self.hit["facet"] = random.integers(0, FACETS, COUNT)
        self.hit["facet"][::9] = records.NONE
        self.met = random.integers(0, FACETS, (CELLS + NEAR, COUNT)).astype(np.uint32)
        self.met |= np.where(random.random((CELLS + NEAR, COUNT)) < 0.5, LIT, 0).astype(np.uint32)
        self.met[:CELLS][random.random((CELLS, COUNT)) < sees_sky] = records.NONE
        self.order = random.permutation(COUNT).astype(np.uint32)
        self.direction_set = np.repeat(random.integers(0, SETS, COUNT), 5)[:COUNT].astype(np.uint32)
        self.near = np.zeros((NEAR, 4, COUNT))
        if has_near:
            self.near[:, 0] = np.where(random.random((NEAR, COUNT)) < 0.4, random.uniform(-0.1, 0.1, (NEAR, COUNT)), 0)
            self.near[:, 1:] = unit(random.normal(size=(NEAR, COUNT, 3))).transpose(0, 2, 1)
        self.mirrored = np.zeros(COUNT, records.BACKGROUND)
        self.mirrored["facet"] = records.NONE

    def frame(self):
        frame = np.zeros(1, records.RADIOMETRY)
        frame["columns"] = frame["pixel_count"] = COUNT
        frame["sample_count"] = SAMPLES
        frame["zenith_count"], frame["azimuth_count"] = ZENITHS, AZIMUTHS
        frame["zenith_step_deg"], frame["azimuth_step_deg"] = 90 / (ZENITHS - 1), 360 / (AZIMUTHS - 1)
        frame["sun"] = unit([0.3, 0.4, 0.8])
        return frame


def run(opencl, case, lanes):
    """Shape (pixels, 2, samples)."""
    params = np.zeros(1, records.INCIDENT)
    params["cell_count"], params["dome_count"], params["ring_count"] = CELLS, case.dome.shape[1], RINGS
    params["light_length"] = SAMPLES // 4
    camera = np.zeros(1, records.CAMERA)
    camera["corner"], camera["across"], camera["down"] = (0, 0, -1), (0.01, 0, 0), (0, 0.01, 0)
    floats = {name: np.float32(getattr(case, name))
              for name in ("cell", "dome", "temperature_k", "light", "spectra", "emissivity", "near")}
    out = np.zeros((COUNT, 2, SAMPLES), np.float32)
    opencl.run("incident", (-(-COUNT // (64 if lanes == 16 else 1)),), options=f"-DRAY_LANES={lanes}",
               frame=case.frame(), camera=camera, params=params, dome=floats["dome"],
               surface={"facets": case.facets, "materials": case.materials,
                        "facet_temperature_k": floats["temperature_k"]},
               light={"facet_background": case.background, "light": floats["light"]},
               hemisphere={"cell": floats["cell"], "hit": case.hit, "met": case.met, "order": case.order,
                           "direction_set": case.direction_set, "near_rays": floats["near"],
                           "background": case.mirrored, "background_lit": np.zeros(COUNT, np.float32)},
               spectra={"rows": floats["spectra"], "emissivity": floats["emissivity"]}, out=out)
    return out


class Reference:
    """A pixel's rays, one by one."""

    def __init__(self, case, place):
        self.case, hit = case, case.hit[place]
        self.sun = case.frame()[0]["sun"].astype(float)
        normal = hit["normal"].astype(float)
        level = np.hypot(*normal[:2])
        up = np.array([-normal[2] * normal[0] / level, -normal[2] * normal[1] / level, level])
        self.cell = case.cell[case.direction_set[place]]
        self.direction = self.cell[:, :3] @ np.stack([up, np.cross(up, normal), normal])
        self.is_above = self.direction[:, 2] > 0
        self.material = case.materials[case.facets[hit["facet"]]["material"]]
        fraction, weight = (1 + normal[2]) / 2, self.cell[:, 3]
        above = weight[self.is_above].sum()
        self.weight = weight * np.where(self.is_above, fraction / above, (1 - fraction) / max(1 - above, 1e-9))
        if not 1e-6 < above < 1 - 1e-6:
            self.weight = weight
        self.word = case.met[:CELLS, place]
        self.sees_sky = self.word == records.NONE
        self.near, self.near_word = case.near[:, :, place], case.met[CELLS:, place]

    def lobe(self):
        """What each cell counts at each sample."""
        if self.material["lobe_first"] == records.NONE:
            return np.ones((CELLS, SAMPLES))
        rings = self.case.emissivity[LOBE + 1:]
        of_cell = np.repeat(rings, AROUND, 0)
        return of_cell / (self.weight @ of_cell)

    def facet(self, c):
        return self.seen(self.word[c], self.direction[c])

    def seen(self, word, direction):
        case = self.case
        facet = int(word & ~np.uint32(LIT))
        own = case.facets[facet]
        along = own["normal"].astype(float) @ direction
        first = case.materials[own["material"]]["emissivity_first"]
        angle = np.degrees(np.arccos(min(abs(along), 1)))
        low = int(angle)
        e = case.emissivity[first + low:][:2]
        e = e[0] + (angle - low) * (e[min(1, len(e) - 1)] - e[0])
        facing = own["normal"].astype(float) @ self.sun * (-1 if along > 0 else 1)
        sun = case.spectra[records.SUN] * max(facing, 0) / np.pi * bool(word & LIT)
        black = planck(case.wavelength_um, case.temperature_k[facet])
        fraction = float(case.background[facet]["shape_factor"])
        lobe, extra = np.repeat(case.light[facet, :2], 4, 1)
        arriving = sun * lobe + fraction * case.spectra[records.SKY] + (1 - fraction) * black + extra
        return e * black + (1 - e) * arriving

    def facets(self):
        """What facets bring, eq. 2.4-2's background ray by ray."""
        diffuse = 1 - float(self.material["specular_share"])
        return diffuse * sum((self.weight[c] * self.lobe()[c] * self.facet(c)
                              for c in np.flatnonzero(~self.sees_sky)), np.zeros(SAMPLES))

    def near_facets(self):
        """What facets and sky bring to a Lambertian surface once near facets count by what is lacking of them: the
        rays beside them count as much less, on either side of the horizon."""
        bare = self.word & ~np.uint32(LIT)
        is_near = np.isin(bare, (self.near_word & ~np.uint32(LIT))[self.near[:, 0] != 0])
        facets, sky = np.zeros(SAMPLES), self.uniform_sky()
        for side, those in [(self.is_above, self.near[:, 3] > 0), (~self.is_above, self.near[:, 3] <= 0)]:
            rest, lack = self.weight[side & ~is_near].sum(), self.near[those, 0].sum()
            part = min(max(rest / lack, 0), 1) if lack > rest else 1
            for k in np.flatnonzero(those):
                facets += part * self.near[k, 0] * self.seen(self.near_word[k], self.near[k, 1:])
            sky -= (part * lack * self.weight[side & self.sees_sky].sum() / rest * self.case.spectra[records.PATHS])
            for c in np.flatnonzero(side & ~self.sees_sky):
                scale = 1 if is_near[c] else 1 - part * lack / rest
                facets += scale * self.weight[c] * self.facet(c)
        return facets, sky

    def uniform_sky(self):
        """Of a Lambertian surface."""
        return self.case.spectra[records.PATHS] * self.weight[self.sees_sky].sum()


LANES = pytest.mark.parametrize("lanes", [16, 1])


def diffuse_places(case):
    """Places of pixels that mirror nothing."""
    found = case.hit["facet"] != records.NONE
    material = case.facets["material"][np.where(found, case.hit["facet"], 0)]
    return np.flatnonzero(found & (material != 1))


@LANES
@pytest.mark.parametrize("sees_sky", [0.2, 0.6])
def test_facets_bring_what_each_ray_s_facet_sends(opencl, lanes, sees_sky):
    case = Case(1, sees_sky=sees_sky)

    out = run(opencl, case, lanes)

    for place in diffuse_places(case):
        expected = Reference(case, place).facets()
        # float32 sums of up to 72 rays, and angles whose last digits count near 0 degrees
        assert out[case.order[place], 1] == pytest.approx(expected, rel=2e-5)


@LANES
def test_near_facets_bring_what_their_rays_lack(opencl, lanes):
    case = Case(5, is_sky_uniform=True, has_near=True)

    out = run(opencl, case, lanes)

    for place in diffuse_places(case):
        pixel = Reference(case, place)
        if pixel.material["lobe_first"] == records.NONE:
            facets, sky = pixel.near_facets()
            assert out[case.order[place], 1] == pytest.approx(facets, rel=3e-5)
            assert out[case.order[place], 0] == pytest.approx(sky, rel=1e-5)


@LANES
@pytest.mark.parametrize("sees_sky", [0.2, 0.6, 1.0])
def test_a_uniform_sky_brings_what_its_open_cells_count(opencl, lanes, sees_sky):
    case = Case(2, is_sky_uniform=True, sees_sky=sees_sky)

    out = run(opencl, case, lanes)

    for place in diffuse_places(case):
        pixel = Reference(case, place)
        if pixel.material["lobe_first"] == records.NONE:  # in whose rings the dome's points lie otherwise
            assert out[case.order[place], 0] == pytest.approx(pixel.uniform_sky(), rel=5e-6)


@pytest.mark.parametrize("sees_sky", [0.2, 0.6, 1.0])
def test_a_pixel_alone_gets_what_it_gets_among_its_neighbours(opencl, sees_sky):
    case = Case(3, sees_sky=sees_sky)

    alone, together = run(opencl, case, 1), run(opencl, case, 16)

    # The orders of the sums differ.
    assert alone == pytest.approx(together, rel=5e-6, abs=1e-6)


@LANES
def test_what_nothing_was_met_by_gets_nothing(opencl, lanes):
    case = Case(4)

    out = run(opencl, case, lanes)

    assert (out[case.order[case.hit["facet"] == records.NONE]] == 0).all()
