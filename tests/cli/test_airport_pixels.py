"""The airport as the thesis had it: every pixel once more in double precision, from its planes, the
geometry, the emissivities and the radiance database alone (eq. 2.4-1 and 2.4-2)."""
import numpy as np
import pytest

PIXELS = [160, 120]
BAND_UM = (8.0, 13.3)
# Thesis, below eq. 2.4-5: c, h, k.
C, H, K = 2.99792458e8, 6.626176e-34, 1.380662e-23
GROUND = 4  # code of summergrass
MISSED, DIFFUSE, TO_SKY, TO_BACKGROUND = range(4)
BOUND = 1e-5
ABOVE_M = 2e-3  # 2^-20 of the scene's size: where rays leave a surface
CAMERAS = {
    "from above": {"position_m": [6951.7077, 7162.3865, 10000.0],
                   "target_m": [-119.9939, 90.6849, 0.0], "focal_length_mm": 3790.47},
    "at the horizon": {"position_m": [900.0, 1100.0, 60.0], "target_m": [-119.0, 90.0, 90.0],
                       "focal_length_mm": 24.0},
}


def read_emissivity(path):
    """Wavenumbers, ascending, and shape (91, 396)."""
    rows = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    blocks = np.array([rows[i + 1:i + 397] for i in range(0, len(rows), 397)], float)
    return blocks[0, ::-1, 0], blocks[:, ::-1, 1]


def read_library(folder):
    """File of emissivities and specularity by material code."""
    lines = (folder / "materials.mat").read_text().splitlines()
    return {int(lines[i + 1]): (folder / lines[i + 9], float(lines[i + 5]))
            for i in range(1, len(lines) - 10, 11)}


def read_triangles(path):
    """Corners, shape (n, 3, 3), outward unit normals, the number of the facet that each is of, and its
    material's code; east, north, up. A facet of four corners is cut from its first to its third."""
    lines, corners, outward, facet, code, faces, at = path.read_text().splitlines(), [], [], [], [], 0, 0
    while at < len(lines):
        if lines[at] != "FACE":
            at += 3
            continue
        count = int(lines[at + 13])
        places = [line.split() for line in lines[at + 14:at + 14 + count]]
        for i in range(1, count - 1):
            corners.append([places[0], places[i], places[i + 1]])
            outward.append(lines[at + 14 + count].split())
            facet.append(faces)
            code.append(int(lines[at + 4]))
        faces += 1
        at += 18 + count

    def to_enu(north_west_up):
        a = np.array(north_west_up, float)
        return np.stack([-a[..., 1], a[..., 0], a[..., 2]], axis=-1)

    corners = to_enu(corners)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    turned = (normals * to_enu(outward)).sum(1) < 0
    outside = np.where(turned[:, None], -normals, normals)
    return corners, outside, np.array(facet), np.array(code)


def first_hit(corners, normals, origin, direction):
    """The triangle that a ray meets first from its front (Moeller and Trumbore), or -1."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(direction, second)
    with np.errstate(all="ignore"):
        scale = 1 / (first * p).sum(1)
        u = ((origin - corners[:, 0]) * p).sum(1) * scale
        q = np.cross(origin - corners[:, 0], first)
        v, t = (q @ direction) * scale, (second * q).sum(1) * scale
        met = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0) & (normals @ direction < 0)
    return int(np.argmin(np.where(met, t, np.inf))) if met.any() else -1


class Recomputed:
    """What the planes, the files and the equations make of each pixel."""

    def __init__(self, program, radiance, database, camera, planes):
        self.planes, self.database = planes, database
        self.library = read_library(program.root / "scenes" / "library")
        self.triangles = read_triangles(program.airport / "airport.gdb")
        self.ray = radiance.pixel_directions(**camera, pixels=PIXELS)
        self.position = np.array(camera["position_m"])
        self.um = 1e4 / database.wavenumber_cm1
        self.inside = (self.um >= BAND_UM[0]) & (self.um <= BAND_UM[1])
        self.um = self.um[self.inside]
        self.emissivities = {}
        zenith, azimuth = np.radians(self.sun_deg(program))
        self.sun = np.array([np.sin(zenith) * np.sin(azimuth), np.sin(zenith) * np.cos(azimuth),
                             np.cos(zenith)])

    @staticmethod
    def sun_deg(program):
        done = program.run("sun", "--site", "39.773333,-84.108888", "--time",
                           "1987-06-24T10:00:00-05:00")
        return [float(x) for x in done.stdout.splitlines()[1].split(",")[1:3]]

    def integrate(self, spectrum):
        return np.trapz(spectrum, self.um)

    def planck(self, celsius):
        m, kelvin = 1e-6 * self.um, float(celsius) + 273.15
        return 2e-6 * H * C**2 / m**5 / np.expm1(H * C / (m * K * kelvin))

    def emissivity(self, code):
        """Shape (91, points), and its means over the band."""
        if code not in self.emissivities:
            wavenumber, table = read_emissivity(self.library[int(code)][0])
            e = np.array([np.interp(1e4 / self.um, wavenumber, row) for row in table])
            width = self.integrate(np.ones(len(self.um)))
            self.emissivities[code] = e, np.array([self.integrate(row) for row in e]) / width
        return self.emissivities[code]

    def meet(self, origin, direction, facet=None):
        """Where a ray meets the scene (or one facet) and the normal there; the ground is level."""
        corners, normals, facets, codes = self.triangles
        if facet is not None:
            of_facet = np.flatnonzero(facets == facet)
            corners, normals, codes = corners[of_facet], normals[of_facet], codes[of_facet]
        k = first_hit(corners, normals, origin, direction)
        normal = normals[k] if k >= 0 else np.array([0.0, 0.0, 1.0])
        place = corners[k][0] if k >= 0 else np.zeros(3)
        point = origin + ((place - origin) @ normal) / (direction @ normal) * direction
        return point, normal, codes[k] if k >= 0 else GROUND

    def is_known(self, at):
        """True where normal and background are those of the planes. The normals of facets of decimetres
        are uncertain by .05 degree, their corners being float32 in a scene of kilometres; a ray may
        pass an edge on its other side."""
        p, ray = self.planes, self.ray[at]
        point, normal, _ = self.meet(self.position, ray, p["facet"][at])
        if abs(np.degrees(np.arccos(-normal @ ray)) - p["view_angle_deg"][at]) > 1e-3:
            return False
        if p["interaction"][at] == TO_SKY:
            return True
        bounce = ray - 2 * (ray @ normal) * normal
        met = self.meet(point + ABOVE_M * normal, bounce)[2]
        return met == p["background_material"][at]

    def sun_on(self, lit, cosine):
        inside, database = self.inside, self.database
        return database.sun[inside] * lit * max(cosine, 0.0) / np.pi

    def background(self, at, angle_deg, cosine):
        """Leaves a background towards the target; its angle None: as the plane of its emissivity says."""
        p = self.planes
        e, mean = self.emissivity(p["background_material"][at])
        if angle_deg is None:
            angle_deg = np.argmin(abs(mean - p["background_emissivity_lwir"][at]))
        e = e[int(np.rint(angle_deg))]
        return (e * self.planck(p["background_temperature_c"][at])
                + (1 - e) * self.sun_on(p["background_sunlit"][at], cosine))

    def from_above(self, at, point, normal, interaction, cosine):
        """cosine: of the sun on a diffuse target's background, which no plane tells."""
        f = float(self.planes["shape_factor"][at])
        if interaction == DIFFUSE:
            behind = 0.0 if f == 1 else self.background(at, None, cosine)
            return f * self.database.sky[self.inside] + (1 - f) * behind
        ray = self.ray[at]
        bounce = ray - 2 * (ray @ normal) * normal
        if interaction == TO_SKY:
            return self.database.sky_at(bounce)[self.inside]
        met = self.meet(point + ABOVE_M * normal, bounce)[1]
        return self.background(at, np.degrees(np.arccos(-met @ bounce)), met @ self.sun)

    def radiance(self, at, cosine=0.0):
        p, ray = self.planes, self.ray[at]
        interaction = int(p["interaction"][at])
        if interaction == MISSED:
            return self.integrate(self.database.sky_at(ray)[self.inside])
        point, normal, _ = self.meet(self.position, ray, p["facet"][at])
        angle_deg = np.degrees(np.arccos(-normal @ ray))
        e = self.emissivity(p["material"][at])[0][
            0 if interaction == DIFFUSE else int(np.rint(angle_deg))]
        surface = e * self.planck(p["temperature_c"][at]) + (1 - e) * (
            self.sun_on(p["sunlit"][at], normal @ self.sun)
            + self.from_above(at, point, normal, interaction, cosine))
        tau2, path = self.database.path_at(np.degrees(np.arccos(-ray[2])))
        return self.integrate(surface * tau2[self.inside] + path[self.inside])


@pytest.fixture(scope="module")
def both(request, program, radiance, airport, database, tmp_path_factory):
    """The planes of a render, and what recomputes its radiance."""
    out = tmp_path_factory.mktemp("airport")
    camera = CAMERAS[request.param]
    options = [f"--set=camera.{key}={value}" for key, value in camera.items()]
    done = program.run("render", airport, "-o", out, "--mode", "thesis",
                       "--size", f"{PIXELS[0]}x{PIXELS[1]}", *options)
    assert done.returncode == 0, done.stderr
    planes = program.load(out, "airport").planes
    return planes, Recomputed(program, radiance, database, camera, planes)


def seen_by(*cameras):
    """For tests of what these cameras see."""
    return pytest.mark.parametrize("both", cameras, indirect=True)


def some_of(planes, interaction, least):
    """Up to 150 pixels of an interaction, of which there must be some."""
    places = np.argwhere(planes["interaction"] == interaction)
    assert len(places) >= least
    chosen = np.random.default_rng(1).permutation(len(places))[:150]
    return [tuple(place) for place in places[chosen]]


@seen_by("at the horizon")
def test_missed_pixels_of_the_airport_are_the_sky_of_their_direction(both):
    planes, again = both

    for at in some_of(planes, MISSED, 100):
        assert planes["radiance_lwir"][at] == pytest.approx(again.radiance(at), rel=BOUND)


@seen_by("from above", "at the horizon")
def test_diffuse_pixels_of_the_airport_are_eq_2_4_2(both):
    planes, again = both

    for at in some_of(planes, DIFFUSE, 100):
        # No plane tells the sun's cosine on the background: 0 to 1 changes 4e-5 at most.
        least, most = again.radiance(at, 0.0), again.radiance(at, 1.0)
        assert most - least < 5e-5 * most
        assert least * (1 - BOUND) <= planes["radiance_lwir"][at] <= most * (1 + BOUND)


@seen_by("from above")
@pytest.mark.parametrize("interaction", [TO_SKY, TO_BACKGROUND])
def test_specular_pixels_of_the_airport_are_eq_2_4_1(both, interaction):
    planes, again = both
    places = some_of(planes, interaction, 40)

    known = [at for at in places if again.is_known(at)]

    assert len(known) > 0.75 * len(places)
    for at in known:
        assert planes["radiance_lwir"][at] == pytest.approx(again.radiance(at), rel=BOUND)
