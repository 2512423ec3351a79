"""Spectra of materials as they were measured: rendered bands against float64 integrals of the files."""
import numpy as np
import pytest

BAND = 2e-4  # of a band's value: what a user is promised

# Centres and widths, cm-1, and depths of what stands out of a smooth curve: quartz' doublet and its band at
# 12.6 um, carbonate, chlorophyll, liquid water.
FEATURES = {
    "quartz": [(1176, 22, .30), (1090, 25, .32), (798, 4.5, .12), (778, 4.5, .10)],
    "carbonate": [(885, 10, .10), (4290, 60, .15)],
    "chlorophyll": [(14790, 500, -.40), (18100, 900, -.12)],
    "water": [(6900, 250, .25), (5180, 150, .30)],
}


def measured(kinds, seed, base=.95):
    """An emissivity on the irregular wavelengths of an instrument, .38 to 14.01 um, with its noise."""
    random = np.random.default_rng(seed)
    um = np.concatenate([np.arange(.38, .8, .001), np.arange(.8, 2.5, .002),
                         1e4 / np.arange(4000, 713, -1.93)])
    um = um + random.uniform(-2e-4, 2e-4, um.size)
    um.sort()
    nu = 1e4 / um
    value = np.full(um.size, base)
    for kind in kinds:
        for centre, width, depth in FEATURES[kind]:
            value -= depth * np.exp(-.5 * ((nu - centre) / width) ** 2)
    return um, np.round(np.clip(value + random.normal(0, .004, um.size), .02, 1.0), 4)


CURVES = {name: measured(kinds, seed, base) for seed, (name, kinds, base) in enumerate([
    ("quartz sand", ["quartz"], .95), ("limestone", ["carbonate"], .93),
    ("grass", ["chlorophyll", "water"], .97), ("dry grass", ["water"], .9),
    ("asphalt", [], .95), ("brick", ["quartz", "carbonate"], .92), ("snow", ["water"], .98),
    ("water", [], .985), ("aluminium", [], .05), ("paint", ["carbonate"], .9)])}

HEADER = """Name: {name}
Type: test
Description: a curve of
 two lines
Measurement: Directional (10 Degree) Hemispherical Reflectance
First Column: X
Second Column: Y
X Units: Wavelength (micrometers)
Y Units: Reflectance (percent)
First X Value: {first}
Last X Value: {last}
Number of X Values: {count}
Additional Information: none

"""


def ecostress(um, emissivity, name="a"):
    """As ECOSTRESS has it: reflectance in percent, from long waves to short ones."""
    rows = [f"{x:.6f}\t{100 * (1 - e):.2f}" for x, e in zip(um[::-1].tolist(), emissivity[::-1].tolist())]
    return HEADER.format(name=name, first=um[-1], last=um[0], count=um.size) + "\n".join(rows) + "\n"


def splits(low, high, points):
    """The range, cut at the points in it."""
    inner = points[(points > low) & (points < high)]
    return np.concatenate([[low], inner, [high]])


def integral(function, low, high, points):
    """Gauss' rule of four points between all points: the file's curve is straight there."""
    x, weight = np.polynomial.legendre.leggauss(4)
    edges = splits(low, high, points)
    half = .5 * np.diff(edges)[:, None]
    um = edges[:-1, None] + half * (x + 1)
    return float(np.sum(half * weight * function(um)))


def band_table(edges):
    return [{"name": f"b{i}", "wavelength_um": [float(a), float(b)]}
            for i, (a, b) in enumerate(edges)]


@pytest.fixture
def surface(program, tmp_path):
    """Renders a level plane of one material; returns the radiance in each band."""

    def render(bands, text, name="s.txt", uniform=None, **keys):
        (tmp_path / name).write_text(text)
        material = {"name": "wall", "temperature_k": 300.0, "spectrum_file": name, **keys}
        more = {"atmosphere": {"uniform": uniform}} if uniform else {}
        got = program.render(tmp_path, material=[material], band=band_table(bands), **more)
        return np.array([got.planes[f"radiance_b{i}"][3, 4] for i in range(len(bands))], float)

    return render


@pytest.mark.parametrize("name", CURVES)
def test_narrow_thermal_bands_of_measured_curves_are_integrals_of_the_file(surface, radiance, name):
    um, e = CURVES[name]
    edges = 1e4 / np.arange(1250, 751, -5.0)
    bands = list(zip(edges, edges[1:]))

    got = surface(bands, ecostress(um, e))

    um = np.round(um, 6)
    for (low, high), value in zip(bands, got):
        whole = integral(lambda x: radiance.planck(x, 300.0), low, high, um)
        mean = integral(lambda x: np.interp(x, um, e) * radiance.planck(x, 300.0), low, high, um)
        assert value / whole == pytest.approx(mean / whole, abs=BAND)


@pytest.mark.parametrize("name", CURVES)
def test_bands_of_10_nm_in_sunlight_are_integrals_of_the_file(surface, name):
    um, e = CURVES[name]
    bands = [(a, a + .01) for a in np.arange(.4, 2.395, .01)]
    sun = {"sky_temperature_k": 1.0, "sky_radiance_w_m2_sr_um": np.pi, "sun_irradiance_w_m2_um": 0.0,
           "transmission": 1.0, "path_temperature_k": 1.0}

    got = surface(bands, ecostress(um, e), uniform=sun, temperature_k=100.0)

    um = np.round(um, 6)
    for (low, high), value in zip(bands, got):
        mean = integral(lambda x: 1 - np.interp(x, um, e), low, high, um) / (high - low)
        assert value / (np.pi * (high - low)) == pytest.approx(mean, abs=BAND)


def test_the_doublet_of_quartz_stands_in_a_cube_of_256_bands(surface, radiance):
    um, e = CURVES["quartz sand"]
    edges = np.linspace(8.0, 13.3, 257)
    bands = list(zip(edges, edges[1:]))

    got = surface(bands, ecostress(um, e))

    middle = .5 * (edges[1:] + edges[:-1])
    black = np.array([radiance.band_planck(a, b, 300.0) for a, b in bands])
    shown = got / black
    at = lambda wavenumber: shown[np.argmin(abs(middle - 1e4 / wavenumber))]
    # by the curve's own numbers: .95 less .30, .32, .12 and .10, and what lies between
    assert at(1176) == pytest.approx(.65, abs=.02) and at(1090) == pytest.approx(.63, abs=.02)
    assert at(1133) > at(1176) + .05 and at(1133) > at(1090) + .05
    assert at(788) > at(798) + .02 and at(788) > at(778) + .02


@pytest.fixture
def check(program, tmp_path):
    """Runs `radsig check` on a plane of one material with these files; returns what it did."""

    def run(files, render=None, band=None, **keys):
        for name, text in files.items():
            (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        material = {"name": "wall", "temperature_k": 300.0, **keys}
        scene = program.write_scene(tmp_path, material=[material], render=render or {},
                                    band=[band or {"name": "lwir", "wavelength_um": [8.0, 14.0]}])
        return program.run("check", scene)

    return run


TABLE = "wavelength_um,reflectance\n7.5,0.1\n10,0.05\n14,0.03\n"


def means(done):
    return [float(line.split()[-1]) for line in done.stdout.splitlines() if "mean emissivity" in line]


def test_check_tells_range_law_and_band_means(check):
    done = check({"s.csv": TABLE}, spectrum_file="s.csv")

    assert done.returncode == 0, done.stderr
    assert "7.5 to 14 um, 1 - reflectance (Kirchhoff), the same at all angles" in done.stdout
    # trapezoids of 0.91 at 8 um, 0.95 at 10, 0.97 at 14
    assert means(done) == [pytest.approx((2 * .93 + 4 * .96) / 6, abs=6e-5)]


def test_a_band_beyond_the_data_is_refused_but_for_a_tenth_of_the_wavelength(check):
    far = {"name": "b", "wavelength_um": [6.0, 9.0]}
    near = {"name": "b", "wavelength_um": [6.8, 9.0]}

    refused = check({"s.csv": TABLE}, band=far, spectrum_file="s.csv")
    assert refused.returncode == 1
    assert "band b needs 6 um, the spectrum has 7.5 to 14 um" in refused.stderr
    assert check({}, band=near, spectrum_file="s.csv").returncode == 0
    assert means(check({}, band=far, spectrum_file="s.csv", outside=0.0))[0] < .7
    assert check({}, band=far, spectrum_file="s.csv", outside="hold").returncode == 0


def test_joined_files_cover_both_ranges_and_tell_their_overlap(check):
    more = "wavelength_nm,emissivity\n4000,0.5\n7000,0.5\n8000,0.5\n"

    done = check({"s.csv": TABLE, "more.csv": more}, spectrum_file=["s.csv", "more.csv"],
                 band={"name": "b", "wavelength_um": [4.0, 14.0]})

    assert done.returncode == 0, done.stderr
    assert "more.csv: from 7.5 to 8 um the files before it have values too" in done.stderr
    assert "4 to 7.5, 7.5 to 14 um" in done.stdout


SPLIB = "splib07a Record=1: Quartz GDS31 BECKb AREF\n 0.1\n-1.23e34\n 0.1\n 0.2\n"
WAVELENGTHS = "splib07a Record=2: Wavelengths BECK 4 ch\n 0.5\n 0.55\n 0.6\n 0.7\n"
VIS = {"name": "vis", "wavelength_um": [0.5, 0.7]}


def test_splib07_takes_its_wavelengths_from_their_own_file(check):
    files = {"a.txt": SPLIB, "w.txt": WAVELENGTHS}

    done = check(files, band=VIS, spectrum_file="a.txt", wavelength_file="w.txt")
    assert done.returncode == 0, done.stderr
    assert means(done) == [pytest.approx(.875, abs=6e-5)]  # .9 to 0.6 um, then falling to .8
    assert "wavelength_file" in check({}, band=VIS, spectrum_file="a.txt").stderr


@pytest.mark.parametrize("order", [0, 1])
def test_a_record_of_an_envi_library_is_found_by_its_name(check, tmp_path, order):
    import spectral.io.envi

    um = [.5, .6, .7]
    values = np.array([[.1, .2, .3], [.4, .4, .4]], np.float32)
    header = {"wavelength": um, "wavelength units": "Micrometers", "spectra names": ["dark soil", "green leaf"]}
    library = spectral.io.envi.SpectralLibrary(values, header, None)
    library.save(str(tmp_path / "lib"))
    if order:
        text = (tmp_path / "lib.hdr").read_text().replace("byte order = 0", "byte order = 1")
        (tmp_path / "lib.hdr").write_text(text)
        (tmp_path / "lib.sli").write_bytes(values.astype(">f4").tobytes())

    done = check({}, band=VIS, spectrum_file="lib.sli", record="dark soil")
    assert done.returncode == 0, done.stderr
    assert means(done) == [pytest.approx(.8, abs=6e-5)]
    wrong = check({}, band=VIS, spectrum_file="lib.sli", record="green leav")
    assert wrong.returncode == 1 and "such as 'green leaf'" in wrong.stderr


def test_reflectance_between_two_directions_is_refused_where_heat_is_emitted(check):
    um = np.linspace(2.5, 14.0, 60)
    text = ecostress(um, np.full(60, .9)).replace("Directional (10 Degree) Hemispherical", "Bidirectional")

    refused = check({"s.txt": text}, spectrum_file="s.txt")
    assert refused.returncode == 1 and "accept_geometry" in refused.stderr
    done = check({}, spectrum_file="s.txt", accept_geometry=True)
    assert done.returncode == 0 and "measured between two directions" in done.stderr


@pytest.mark.parametrize("keys, expected", [
    ({"spectrum_file": "s.csv", "emissivity_file": "s.csv"}, "expected one of them"),
    ({"spectrum_file": "s.csv", "angular": "smooth"}, "constant"),
    ({"spectrum_file": "s.csv", "angle_deg": [0, 60]}, "an angle of 0 to 90 degrees for each"),
    ({"emissivity": .9, "outside": "hold"}, "without spectrum_file"),
    ({"spectrum_file": []}, "expected 1 to 16"),
    ({"spectrum_file": "t.csv"}, "found transmittance"),
    ({"spectrum_file": "s.csv", "extinction_per_km": 1.0}, "states spectrum_file and is transmissive"),
    ({"emissivity_file": "s.csv"}, "s.csv:1: found 'wavelength_um,reflectance', expected an angle in degrees, as an "
                                   ".ems has it: measured spectra are read by spectrum_file"),
])
def test_wrong_keys_are_refused_with_file_and_line(check, keys, expected):
    done = check({"s.csv": TABLE, "t.csv": TABLE.replace("reflectance", "transmittance")}, **keys)

    assert done.returncode == 1
    assert expected in done.stderr


def test_heat_that_needs_what_was_not_measured_is_refused(check):
    """The part of a black body of 300 K below 6.75 um is 7.6 %; of sunlight all is missing."""
    heat = {"density_kg_m3": 2000, "specific_heat_j_kg_k": 900, "conductivity_w_m_k": 1.0,
            "thickness_cm": 10}
    weather = {"thermal": "therm"}

    done = check({"s.csv": TABLE}, render=weather, spectrum_file="s.csv", **heat)
    assert "lacks 100 % of sunlight" in done.stderr and "300 K" in done.stderr
    done = check({}, render=weather, spectrum_file="s.csv", emissivity=.9, solar_absorptance=.6, **heat)
    assert "lacks" not in done.stderr


@pytest.mark.parametrize("angle, expected", [(0, .98982), (60, .96124)])
def test_optical_constants_of_water_give_fresnels_emissivity(program, radiance, tmp_path, angle, expected):
    """Hale and Querry at 10 um: n 1.2180, k 0.0508; held over a band of 20 nm."""
    (tmp_path / "water.csv").write_text("wavelength_um,n,k\n9.9,1.2180,0.0508\n10,1.2180,0.0508\n"
                                        "10.1,1.2180,0.0508\n")
    far = 6000.0
    camera = {"position_m": [0.0, -far * np.sin(np.radians(angle)), far * np.cos(np.radians(angle))],
              "focal_length_mm": 8500.0}
    got = program.render(tmp_path, camera=camera, band=[{"name": "b", "wavelength_um": [9.99, 10.01]}],
                         material=[{"name": "wall", "temperature_k": 300.0, "spectrum_file": "water.csv"}])

    black = radiance.band_planck(9.99, 10.01, 300.0)
    assert got.planes["radiance_b"][3, 4] / black == pytest.approx(expected, abs=1e-4)
    assert got.report["materials"][0]["spectrum"].endswith("Fresnel of n and k; outside held for a tenth of a wavelength")


def test_measured_angles_are_straight_between(program, radiance, tmp_path):
    for name, value in (("a", .9), ("b", .6)):
        (tmp_path / f"{name}.csv").write_text(f"wavelength_um,emissivity\n8,{value}\n10,{value}\n14,{value}\n")
    tilted = {"position_m": [0.0, -6000 * np.sin(np.radians(45)), 6000 * np.cos(np.radians(45))],
              "focal_length_mm": 8500.0}
    got = program.render(tmp_path, camera=tilted, material=[
        {"name": "wall", "temperature_k": 300.0, "spectrum_file": ["a.csv", "b.csv"], "angle_deg": [30, 60]}])

    black = radiance.band_planck(8.0, 14.0, 300.0)
    assert got.planes["radiance_lwir"][3, 4] / black == pytest.approx(.75, abs=2e-4)


def test_a_file_means_the_same_to_python3_spectral(check, tmp_path):
    import spectral.database.ecostress

    um, e = CURVES["quartz sand"]
    text = ecostress(um, e)
    header, rows = text.split("\n\n")
    # that reader wants the keys of an ECOSTRESS header and its 20 lines
    keys = {"Type": "soil", "Class": "a", "Subclass": "b", "Particle Size": "Coarse", "Sample No.": "1", "Owner": "o",
            "Wavelength Range": "All", "Origin": "here", "Collection Date": "N/A", "Description": "a curve"}
    lines = ["Name: a", *(f"{k}: {v}" for k, v in keys.items()),
             *header.splitlines()[header.splitlines().index(next(x for x in header.splitlines() if x.startswith("Measurement"))):]]
    (tmp_path / "s.txt").write_text("\n".join(lines) + "\n\n" + rows)
    signature = spectral.database.ecostress.read_ecostress_file(str(tmp_path / "s.txt"))

    done = check({}, spectrum_file="s.txt", band={"name": "b", "wavelength_um": [8.0, 9.5]})

    assert done.returncode == 0, done.stderr
    x, y = np.array(signature.x), 1 - np.array(signature.y) / 100
    edges = splits(8.0, 9.5, x)
    assert means(done) == [pytest.approx(np.trapz(np.interp(edges, x, y), edges) / 1.5, abs=6e-5)]
