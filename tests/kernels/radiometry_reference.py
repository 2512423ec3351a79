"""The equations of thesis 2.4 in float64 numpy, one pixel at a time, and random pixels to try them on.

Written from eq. 2.4-1 and 2.4-2."""
import lobe_reference
import numpy as np
import records
from records import DIFFUSE, MISSED, NONE, SPECULAR_BACKGROUND, SPECULAR_SKY

CAMERA, SUN_WAY, BACKGROUND, BACKGROUND_SUN = range(4)  # TRANSMISSION_...
FIRST, SECOND = 1.191042972397188e8, 1.438776877e4  # CODATA 2018: 2 h c^2, h c / k


def planck(wavelength_um, temperature_k):
    """eq. 2.4-5, W m-2 sr-1 um-1."""
    with np.errstate(over="ignore"):
        return FIRST / wavelength_um**5 / np.expm1(SECOND / (wavelength_um * temperature_k))


def unit(v):
    v = np.asarray(v, np.float64)
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def angle_deg(cosine):
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def between(rows, position):
    """The row at a fractional index, linear; outside, the nearest."""
    position = min(max(position, 0.0), len(rows) - 1.0)
    low = min(int(position), max(len(rows) - 2, 0))
    high = min(low + 1, len(rows) - 1)
    return rows[low] + (position - low) * (rows[high] - rows[low])


class Reference:
    def __init__(self, case):
        f = self.frame = case.frame[0]
        self.case = case
        self.rows = case.spectra.astype(np.float64)
        self.wavelength_um = case.wavelength_um
        self.emissivity_rows = case.emissivity.astype(np.float64)
        paths, first = f["path_count"], records.PATHS
        self.tau2, self.path = (self.rows[first + k * paths:][:paths] for k in (0, 1))
        first += 2 * paths
        air = case.air[0]
        self.sky_table = self.rows[first:air["first_row"]].reshape(
            f["zenith_count"], f["azimuth_count"], -1)
        heights, ranges = int(air["altitude_count"]), int(air["range_count"])
        rest = self.rows[air["first_row"]:]
        self.altitude = rest[:2 * heights * paths].reshape(2, heights, paths, rest.shape[1])
        self.range = rest[2 * heights * paths:].reshape(2, ranges, rest.shape[1])

    def emissivity(self, material, angle):
        rows = self.emissivity_rows[material["emissivity_first"]:][:material["emissivity_angles"]]
        return between(rows, np.floor(angle + 0.5) if self.frame["thesis"] else angle)

    def sky(self, direction):
        """eq. 2.4.1-1 to 2.4.1-3; below the horizon, the horizon."""
        azimuth = np.degrees(np.arctan2(direction[0], direction[1])) % 360
        zenith = angle_deg(direction[2]) / self.frame["zenith_step_deg"]
        columns = np.stack([between(self.sky_table[:, k], zenith)
                            for k in range(self.frame["azimuth_count"])])
        return between(columns, azimuth / self.frame["azimuth_step_deg"])

    def ray(self, pixel):
        c, n = self.case.camera[0], int(self.frame["first_pixel"]) + pixel
        row, column = divmod(n, int(self.frame["columns"]))
        return unit(c["corner"].astype(np.float64) + (column + 0.5) * c["across"].astype(np.float64)
                    + (row + 0.5) * c["down"].astype(np.float64))

    def bodies(self, way, pixel):
        """Transmission, temperature and range of the middle, the nearest first."""
        if self.case.extinction is None:
            return []
        path = self.case.body_paths[way, pixel]
        beta = self.case.extinction.astype(np.float64)
        return [(np.exp(-beta[path["medium"][i]] * path["length_m"][i]),
                 float(path["temperature_k"][i]), float(path["middle_m"][i]))
                for i in range(4) if path["length_m"][i] > 0]

    def transmission(self, way, pixel):
        return np.prod([tau for tau, _, _ in self.bodies(way, pixel)], axis=0)

    def seen_through(self, radiance, way, pixel):
        for tau, kelvin, _ in reversed(self.bodies(way, pixel)):
            radiance = radiance * tau + (1 - tau) * planck(self.wavelength_um, kelvin)
        return radiance

    def air_kind(self, ray):
        air = self.case.air[0]
        if not self.frame["thesis"]:
            if air["range_count"] and (air["is_level"] or abs(ray[2]) < np.sin(np.radians(10))):
                return "range"
            if air["altitude_count"] and ray[2] < 0:
                return "altitude"
        return "zenith"

    def air(self, pixel, at_m):
        """Transmission and radiance of the air between the sensor and a range on its ray."""
        ray, limit = self.ray(pixel), float(self.case.hit["range_m"][pixel])
        air, z = self.case.air[0], float(self.case.camera["position"][0, 2])
        kind = self.air_kind(ray)
        place = ((angle_deg(-ray[2]) - self.frame["path_zenith_first_deg"])
                 / self.frame["path_zenith_step_deg"])
        # What absorbs, by the column of an atmosphere that falls off by e every 2000 m.
        column = lambda m: (1 - np.exp(-ray[2] * m / 2000)) * 2000 / ray[2]
        if kind == "range":
            level = column(at_m) * np.exp(-(z - air["ground_z_m"]) / 2000)
            return self.segment(air["range_m"][:air["range_count"]], *self.range, level)
        if kind == "altitude":
            depth, radiance = (np.array([between(rows, place) for rows in table])
                               for table in self.altitude)
            known = air["altitude_z_m"][:air["altitude_count"]].astype(float)
            return self.segment(known, depth, radiance,
                                np.clip(z + at_m * ray[2], known[0], known[-1]))
        tau2, path = between(self.tau2, place), between(self.path, place)
        if not at_m < limit:
            return tau2, path
        part = tau2 ** (column(at_m) / column(limit) if np.isfinite(limit) else 0.0)
        return part, path * (1 - part) / (1 - tau2)

    @staticmethod
    def segment(known, depth, radiance, at):
        """ln tau linear between known places (beyond the last goes on); the source of a step is
        constant."""
        i = min(max(int(np.searchsorted(known, at)) - 1, 0), len(known) - 2)
        fraction = (at - float(known[i])) / (float(known[i + 1]) - float(known[i]))
        tau = np.exp(-(depth[i] + fraction * (depth[i + 1] - depth[i])))
        a, b = np.exp(-depth[i]), np.exp(-depth[i + 1])
        return tau, radiance[i] + (radiance[i + 1] - radiance[i]) * (a - tau) / (a - b)

    def sensor_path(self, whole, path, pixel):
        """tau2 tau2c, and what air and bodies send. Thesis mode has the bodies behind the path of a
        target, and nothing before the sky; exact mode has them where they are in the air."""
        missed = self.case.hit["facet"][pixel] == NONE
        radiance, ahead, behind = 0.0, 1.0, path
        steps = []
        for tau, kelvin, middle_m in self.bodies(CAMERA, pixel):
            upto = (1.0, 0.0 if missed else path) if self.frame["thesis"] else self.air(pixel, middle_m)
            steps.append((tau, planck(self.wavelength_um, kelvin), *upto))
        for tau, black, air, upto in steps:
            radiance = radiance + ahead * (upto - (path - behind)) + ahead * air * (1 - tau) * black
            ahead, behind = ahead * tau, path - upto
        return whole * ahead, radiance + ahead * behind

    def is_specular(self, pixel):
        facet = self.case.facets[self.case.hit["facet"][pixel]]
        return self.case.materials[facet["material"]]["specular_share"] > 0

    def background(self, pixel):
        """e_B B(T_B) + E_S/pi tau1 tau_SB cos(theta_B) (1 - e_B), and e_B."""
        b = self.case.background[pixel]
        normal = b["normal"].astype(np.float64)
        to_target = unit(self.case.hit["point"][pixel].astype(np.float64) - b["point"])
        if self.is_specular(pixel):  # along the mirrored ray: the points are float32
            mirror = self.case.hit["normal"][pixel].astype(np.float64)
            to_target = 2 * (mirror @ self.ray(pixel)) * mirror - self.ray(pixel)
        e = self.emissivity(self.case.materials[b["material"]], angle_deg(normal @ to_target))
        cosine = max(0.0, normal @ self.frame["sun"].astype(np.float64))
        lit = float(self.case.background_sunlit[pixel])
        sun = self.rows[records.SUN] / np.pi * lit * cosine
        sun = sun * self.transmission(BACKGROUND_SUN, pixel)
        return e * planck(self.wavelength_um, float(b["mean_temperature_k"])) + sun * (1 - e), e

    def lobes(self, material, normal, ray):
        """What is reflected of an irradiance normal to the beam, over 1 - e, per sr: eq. 2.4-2's cosine
        over pi in the thesis' mode; else (1 - e_S) / (1 - e_hemi) of it, and a specular fraction's lobe."""
        towards = self.frame["sun"].astype(np.float64)
        cosine = max(0.0, normal @ towards)
        if self.frame["thesis"]:
            return cosine / np.pi
        diffuse = cosine / np.pi
        if material["emissivity_angles"] > 1:
            rows = self.emissivity_rows[material["emissivity_first"]:][:91]
            diffuse = diffuse * (1 - self.emissivity(material, angle_deg(cosine))) * (
                lobe_reference.over_reflectance(rows))
        fraction = float(material["specular_share"])
        if fraction == 0:
            return diffuse
        lobe = lobe_reference.of_sun(float(material["roughness"]), normal, -ray, towards)
        return (1 - fraction) * diffuse + fraction * lobe

    def pixel(self, pixel):
        """Interaction, spectral radiance at the sensor, emissivity and background's (or None)."""
        case, hit, b = self.case, self.case.hit[pixel], self.case.background[pixel]
        ray, fraction = self.ray(pixel), float(b["shape_factor"])
        if hit["facet"] == NONE:
            sky = self.sensor_path(1.0, self.sky(ray), pixel)[1]
            self.parts = [0, 0, 0, 0, sky, 0]
            return MISSED, sky, None, None
        material = case.materials[case.facets["material"][hit["facet"]]]
        normal = hit["normal"].astype(np.float64)
        kind = DIFFUSE
        if material["specular_share"] > 0:
            kind = SPECULAR_SKY if b["facet"] == NONE else SPECULAR_BACKGROUND
        view = angle_deg(-normal @ ray)
        e = self.emissivity(material, 0.0 if self.frame["thesis"] and kind == DIFFUSE else view)
        sky = self.rows[records.SKY] if kind == DIFFUSE else self.sky(
            ray - 2 * (normal @ ray) * normal)
        behind, e_b = (0.0, None) if b["facet"] == NONE else self.background(pixel)
        if kind == SPECULAR_BACKGROUND:
            behind = self.seen_through(behind, BACKGROUND, pixel)
        sun = self.rows[records.SUN] * float(case.sunlit[pixel]) * self.lobes(material, normal, ray)
        sun = sun * self.transmission(SUN_WAY, pixel)
        above = fraction * sky, (1 - fraction) * behind
        if not self.frame["thesis"]:  # exact mode takes what incident.cl made
            above = case.at_samples(case.incident[pixel].astype(np.float64))
        tau2, path = self.sensor_path(*self.air(pixel, float(hit["range_m"])), pixel)
        self.parts = [
            tau2 * e * planck(self.wavelength_um, float(case.pixel_k[pixel])), tau2 * (1 - e) * sun,
            tau2 * (1 - e) * above[0], tau2 * (1 - e) * above[1], path, tau2]
        return kind, sum(self.parts[:5]), e, e_b

    def part_planes(self, pixel):
        """The parts of the radiance in band, and the mean of tau2: shape (bands, 6)."""
        self.pixel(pixel)
        rows = []
        for band in self.case.bands:
            at, w = self.case.of_band(band)
            sums = [(w * (s[at] if np.ndim(s) else s)).sum() for s in self.parts]
            scale = 1 / w.sum() if band["is_mean"] else 1
            rows.append([*(x * scale for x in sums[:5]), sums[5] / w.sum()])
        return np.array(rows)

    def planes(self, pixel):
        """Interaction, and radiance in band, emissivity and background's, each per band."""
        kind, radiance, e, e_b = self.pixel(pixel)
        in_band = []
        for band in self.case.bands:
            at, w = self.case.of_band(band)
            mean = lambda s: records.NO_VALUE if s is None else (w * s[at]).sum() / w.sum()
            in_band.append(((w * radiance[at]).sum(), mean(e), mean(e_b)))
        return kind, np.array(in_band)


class Case:
    """Random pixels of every kind. Half of the materials are specular, half have 91 angles.
    bodies: transmissive ones stand on the ways of most pixels.
    air: "altitude", "range" or both: grids that the database has."""

    def __init__(self, seed, count, thesis, bodies=False, air=""):
        self.random = np.random.default_rng(seed)
        self.count, self.has_bodies = count, bodies
        self.set_bands()
        self.set_frame(thesis)
        self.set_materials()
        self.set_spectra()
        self.set_air(air)
        self.set_pixels()
        self.extinction = self.body_paths = None
        if bodies:
            self.set_bodies()

    def set_bands(self):
        """Three bands apart, and one that fractions samples of the first two with other weights."""
        edges = [(8.0, 14.0, 30), (0.5, 0.9, 11), (3.0, 5.0, 16)]
        self.bands = np.zeros(len(edges) + 1, records.BAND)
        self.wavelength_um, weight = [], []
        for band, (low, high, used) in zip(self.bands, edges):
            padded = (used + 15) // 16 * 16
            width = np.diff(np.linspace(low, high, used + 1))
            band["first_sample"] = band["first_weight"] = len(weight)
            band["sample_count"] = used
            band["width_um"] = high - low
            self.wavelength_um += list(np.linspace(low, high, used)) + [high] * (padded - used)
            weight += list(width) + [0.0] * (padded - used)
        shared = np.linspace(0.1, 0.3, 17)
        self.bands[-1]["first_sample"], self.bands[-1]["sample_count"] = 19, 17
        self.bands[-1]["first_weight"], self.bands[-1]["width_um"] = len(weight), shared.sum()
        self.bands["gain"], self.bands["offset"] = [2.5, 1.0, 40.0, 3.0], [-3.0, 0.0, 7.0, 0.0]
        self.bands["is_mean"] = [0, 1, 0, 0]
        self.wavelength_um, self.weight = np.array(self.wavelength_um), np.array(weight)
        self.weights = np.concatenate([weight, shared]).astype(np.float32)
        self.weight[19:36] += shared

    def tables(self):
        """The groups of tables that radiometry.cl reads."""
        return {
            "surface": {"facets": self.facets, "materials": self.materials,
                        "facet_temperature_k": self.temperature_k},
            "pixel": {"hit": self.hit, "background": self.background, "temperature_k": self.pixel_k,
                      "sunlit": self.sunlit, "background_sunlit": self.background_sunlit,
                      "paths": self.body_paths, "incident": self.incident},
            "spectra": {"rows": self.spectra, "emissivity": self.emissivity,
                        "extinction": self.extinction, "knot_first": self.knot_first,
                        "knot_fraction": self.knot_fraction}}

    def of_band(self, band):
        """Where in the rows a band is, and its weights there."""
        first, own, count = (int(band[k]) for k in ("first_sample", "first_weight", "sample_count"))
        return slice(first, first + count), self.weights[own:own + count].astype(np.float64)

    def set_frame(self, thesis):
        self.frame = np.zeros(1, records.RADIOMETRY)
        for name, value in dict(
                columns=20, first_pixel=7, pixel_count=self.count, band_count=len(self.bands),
                sample_count=len(self.weight), thesis=thesis, path_count=3,
                path_zenith_first_deg=20, path_zenith_step_deg=20, zenith_count=7,
                azimuth_count=13, zenith_step_deg=15, azimuth_step_deg=30,
                wants=records.WITHOUT_PARTS,
                sun=unit((0.5, -0.3, 0.7))).items():
            self.frame[name] = value
        self.camera = np.zeros(1, records.CAMERA)
        self.camera["position"] = (10, -20, 1000)
        self.camera["corner"], self.camera["across"] = (-1.0, 1.2, -0.9), (0.1, 0.01, 0.0)
        self.camera["down"] = (0.0, -0.1, 0.02)

    def set_materials(self):
        self.materials = np.zeros(6, records.MATERIAL)
        self.materials["specular_share"] = [0, 1, 0, 1, 0, 0.25]
        self.materials["emissivity_angles"] = [91, 91, 1, 1, 91, 91]
        rows = np.cumsum(self.materials["emissivity_angles"])
        self.materials["emissivity_first"] = np.concatenate([[0], rows[:-1]])
        self.materials["number"] = [3, 14, 15, 92, 65, 35]
        self.materials["roughness"] = [0, 0.3, 0, 0.6, 0, 0.05]
        self.facets = np.zeros(40, records.FACET)
        self.facets["material"] = self.random.integers(0, 6, 40)
        self.temperature_k = self.random.uniform(240, 340, 40).astype(np.float32)
        table = []
        for angles in self.materials["emissivity_angles"]:  # falls off towards grazing angles
            at_normal = self.random.uniform(0.1, 1.0, len(self.weight))
            angle = np.radians(np.arange(angles))[:, None]
            table.append(at_normal * np.cos(angle) ** 0.3)
        lobed = np.flatnonzero(self.materials["emissivity_angles"] > 1)
        self.materials["lobe_first"] = NONE
        self.materials["lobe_first"][lobed] = rows[-1] + np.arange(len(lobed))
        lobes = [lobe_reference.over_reflectance(table[i])[None] for i in lobed]
        self.emissivity = np.concatenate(table + lobes).astype(np.float32)

    def set_spectra(self):
        f, n = self.frame[0], len(self.weight)
        uniform = self.random.uniform
        sky = uniform(0.5, 5, (f["zenith_count"], f["azimuth_count"], n))
        sky[0] = sky[0, :1]  # the zenith has no azimuth
        sky[:, -1] = sky[:, 0]
        self.spectra = np.concatenate([
            [self.weight, FIRST / self.wavelength_um**5, SECOND / self.wavelength_um,
             uniform(0, 20, n), uniform(0.5, 5, n)],
            uniform(0.3, 1, (f["path_count"], n)), uniform(0, 4, (f["path_count"], n)),
            sky.reshape(-1, n)]).astype(np.float32)

    def set_air(self, grids):
        """Depths grow towards the ground and with range; the last rows of altitudes are the sensor's."""
        n, paths = len(self.weight), int(self.frame["path_count"][0])
        uniform = np.random.default_rng(1).uniform  # the pixels are the same with and without
        self.air = np.zeros(1, records.AIR)
        self.air["first_row"], self.air["ground_z_m"] = len(self.spectra), -500
        if "altitude" in grids:
            self.air["altitude_count"] = 4
            self.air["altitude_z_m"][0, :4] = -500, 0, 400, 1000
            step = uniform(0.05, 0.4, (4, paths, n))
            rows = [step[::-1].cumsum(0)[::-1] - step[-1], uniform(0, 4, (4, paths, n))]
            rows[1][-1] = 0
            self.add_rows(rows)
        if "range" in grids:
            self.air["range_count"] = 3
            self.air["range_m"][0, :3] = 0, 300, 900
            rows = [uniform(0.1, 0.5, (3, n)).cumsum(0), uniform(0, 4, (3, n))]
            rows[0][0] = rows[1][0] = 0
            self.add_rows(rows)

    def add_rows(self, rows):
        rows = np.float32(rows).reshape(-1, len(self.weight))
        self.spectra = np.concatenate([self.spectra, rows])

    def set_pixels(self):
        n, random = self.count, self.random
        self.hit, self.background = np.zeros(n, records.HIT), np.zeros(n, records.BACKGROUND)
        self.hit["facet"] = random.integers(0, len(self.facets), n)
        ray = np.array([Reference(self).ray(i) for i in range(n)])
        normal = unit(random.normal(size=(n, 3)))
        normal *= -np.sign((normal * ray).sum(1))[:, None]
        self.hit["normal"], self.hit["range_m"] = normal, random.uniform(500, 2000, n)
        self.hit["point"] = self.camera["position"] + self.hit["range_m"][:, None] * ray
        specular = self.materials["specular_share"][self.facets["material"][self.hit["facet"]]] > 0
        alone = random.random(n) < 0.4
        missed = random.random(n) < 0.15
        self.hit["facet"][missed], self.hit["range_m"][missed] = NONE, np.inf
        b = self.background
        b["facet"] = np.where(alone, NONE, random.integers(0, len(self.facets), n))
        b["material"] = np.where(alone, NONE, random.integers(0, 6, n))
        b["shape_factor"] = np.where(specular, alone, np.where(alone, 1, random.random(n)))
        b["mean_temperature_k"] = np.where(alone, 0, random.uniform(240, 340, n))
        b["point"] = self.hit["point"] + random.normal(size=(n, 3)) * 5
        bounce = ray - 2 * (ray * normal).sum(1)[:, None] * normal
        b["point"][specular] = (self.hit["point"] + 5 * bounce)[specular]
        behind = unit(random.normal(size=(n, 3)))
        towards = (behind * (self.hit["point"] - b["point"])).sum(1)
        b["normal"] = behind * np.sign(towards)[:, None]
        self.sunlit, self.background_sunlit = random.random((2, n)).astype(np.float32)
        self.pixel_k = random.uniform(240, 340, n).astype(np.float32)
        self.set_incident()

    def set_incident(self):
        """At every sample where there are bodies, else at knots: blocks of 16 samples between 5 of them."""
        samples, random = len(self.weight), self.random
        knots = samples if self.has_bodies else 32
        self.knot_first = self.knot_fraction = None
        if not self.has_bodies:
            self.knot_first = random.integers(0, knots - 4, samples // 16).astype(np.uint32)
            self.knot_fraction = random.dirichlet(np.ones(5), (samples // 16, 16)).astype(np.float32)
            self.knot_fraction = np.ascontiguousarray(self.knot_fraction.transpose(0, 2, 1))
            self.frame["knot_span"] = 5
        self.frame["knot_count"] = knots
        self.incident = random.uniform(0.5, 9, (self.count, 2, knots)).astype(np.float32)

    def at_samples(self, incident):
        """incident: shape (2, knots)."""
        if self.knot_first is None:
            return incident
        between = self.knot_first[:, None] + np.arange(5)
        return np.einsum("pbk,bki->pbi", incident[:, between], self.knot_fraction).reshape(2, -1)

    def set_bodies(self):
        random, shape = self.random, (4, self.count)
        self.extinction = random.uniform(1e-4, 1e-2, (4, len(self.weight))).astype(np.float32)
        self.body_paths = np.zeros(shape, records.TRANSMISSION_PATH)
        some = np.arange(4) < random.integers(0, 4, shape)[..., None]  # none to three of four
        self.body_paths["length_m"] = np.where(some, random.uniform(1, 300, (*shape, 4)), 0)
        self.body_paths["temperature_k"] = random.uniform(220, 300, (*shape, 4))
        at = np.sort(random.random((*shape, 4)))
        self.body_paths["middle_m"] = at * np.fmin(self.hit["range_m"], 1500)[:, None]
        self.body_paths["medium"] = random.permuted(np.broadcast_to(np.arange(4), (*shape, 4)), axis=2)
