#!/usr/bin/env python3
"""Compares exact mode with Mitsuba 3 (package `mitsuba` of PyPI) on a scene that both can express: grey
Lambertian surfaces that emit, a directional sun, a uniform sky, no air. See bench/README.md.

Exit 0 where they agree, 1 where not, 0 with a line where Mitsuba is not installed."""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/radsig"
PIXELS = (96, 64)
SAMPLES = 2025  # of Mitsuba, a pixel; a square number, for its samples_per_side
BAND_UM = (8.0, 13.3)
SITE, TIME = (39.77, -84.11), "1987-06-24T10:00:00-05:00"
POSITION, TARGET, FOCAL_MM = (28.0, -34.0, 22.0), (0.0, 0.0, 2.0), 35.0
SKY_K, SKY_ADDED, SUN = 255.0, 0.4, 25.0  # K, W m-2 sr-1 um-1, W m-2 um-1
MEAN_LIMIT, PIXEL_LIMIT, PIXEL_SHARE = 0.002, 0.02, 0.99
MATERIALS = {"ground": (0.92, 312.0), "hall": (0.80, 296.0), "tank": (0.65, 330.0),
             "wall": (0.88, 287.0)}  # emissivity, K


def box(low, high):
    """Corners and faces of a box without its floor, counterclockwise from outside."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    corners = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    return corners, [(4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]


PARTS = {
    "ground": ([(-60, -60, 0), (60, -60, 0), (60, 60, 0), (-60, 60, 0)], [(0, 1, 2, 3)]),
    "hall": box((-14, -2, 0), (-2, 14, 8)),
    "tank": box((3, -6, 0), (8, -1, 5)),
    "wall": box((2, 6, 0), (16, 7, 6)),
}


def planck(wavelength_um, kelvin):
    """W m-2 sr-1 um-1; CODATA 2018."""
    return 1.191042972397188e8 / wavelength_um**5 / np.expm1(1.438776877e4 / (wavelength_um * kelvin))


def in_band(kelvin):
    x, weight = np.polynomial.legendre.leggauss(100)
    half = 0.5 * (BAND_UM[1] - BAND_UM[0])
    return half * np.sum(weight * planck(BAND_UM[0] + half * (x + 1), kelvin))


def towards_sun():
    row = subprocess.run([PROGRAM, "sun", f"--site={SITE[0]},{SITE[1]}", "--time", TIME],
                         capture_output=True, text=True, check=True).stdout.splitlines()[1]
    zenith, azimuth = (math.radians(float(x)) for x in row.split(",")[1:3])
    return [math.sin(zenith) * math.sin(azimuth), math.sin(zenith) * math.cos(azimuth),
            math.cos(zenith)]


def by_radsig(folder):
    """The radiance in band, shape (rows, columns)."""
    lines, first = [], 1
    for name, (corners, faces) in PARTS.items():
        lines += [f"usemtl {name}", *("v {} {} {}".format(*c) for c in corners)]
        lines += ["f " + " ".join(str(first + i) for i in face) for face in faces]
        first += len(corners)
    (folder / "scene.obj").write_text("\n".join(lines) + "\n")
    materials = "".join(f'[[material]]\nname = "{name}"\nemissivity = {e}\ntemperature_k = {k}\n'
                        for name, (e, k) in MATERIALS.items())
    (folder / "scene.toml").write_text(f"""name = "both"
[site]
latitude_deg = {SITE[0]}
longitude_deg = {SITE[1]}
time = {TIME}
[atmosphere]
uniform = {{ sky_temperature_k = {SKY_K}, sky_radiance_w_m2_sr_um = {SKY_ADDED}, \
sun_irradiance_w_m2_um = {SUN}, transmission = 1.0, path_temperature_k = {SKY_K} }}
[[geometry]]
file = "scene.obj"
{materials}[camera]
position_m = {list(POSITION)}
target_m = {list(TARGET)}
focal_length_mm = {FOCAL_MM}
pixels = {list(PIXELS)}
[[band]]
name = "lwir"
wavelength_um = {list(BAND_UM)}
[render]
thermal = "fixed"
samples_per_pixel = 400
hemisphere_step_deg = {{ zenith = 5, azimuth = 10 }}
""")
    subprocess.run([PROGRAM, "render", folder / "scene.toml", "-o", folder / "out"], check=True)
    return np.fromfile(folder / "out/both.img", "<f4").reshape(PIXELS[1], PIXELS[0]).astype(float)


def mesh_of(mi, name):
    """A part, its faces flat, that emits and reflects."""
    emissivity, kelvin = MATERIALS[name]
    corners, faces = PARTS[name]
    triangles = [t for f in faces for t in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict({"type": "diffuse", "reflectance": 1 - emissivity})
    properties["emitter"] = mi.load_dict({"type": "area", "radiance": emissivity * in_band(kelvin)})
    mesh = mi.Mesh(name, 3 * len(triangles), len(triangles), props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = np.array(
        [corners[i] for t in triangles for i in t], np.float32).ravel()
    parameters["faces"] = np.arange(3 * len(triangles), dtype=np.uint32)
    parameters.update()
    return mesh


def by_mitsuba(mi):
    width_um = BAND_UM[1] - BAND_UM[0]
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": -1},
        "sensor": {
            "type": "perspective", "fov": 2 * math.degrees(math.atan(18 / FOCAL_MM)),
            "fov_axis": "x",
            "to_world": mi.ScalarTransform4f().look_at(POSITION, TARGET, (0, 0, 1)),
            "film": {"type": "hdrfilm", "width": PIXELS[0], "height": PIXELS[1],
                     "pixel_format": "luminance", "rfilter": {"type": "box"}},
            "sampler": {"type": "multijitter", "sample_count": SAMPLES}},
        "sky": {"type": "constant", "radiance": in_band(SKY_K) + SKY_ADDED * width_um},
        "sun": {"type": "directional", "direction": [-x for x in towards_sun()],
                "irradiance": SUN * width_um},
        **{name: mesh_of(mi, name) for name in PARTS}}
    return np.array(mi.render(mi.load_dict(scene), spp=SAMPLES, seed=1))[:, :, 0].astype(float)


def main():
    try:
        import mitsuba as mi
    except ImportError:
        print("mitsuba_check: skipped: Mitsuba is not installed (make bench-mitsuba fetches it)")
        return 0
    mi.set_variant("scalar_rgb")  # needs no LLVM of its own choosing
    with tempfile.TemporaryDirectory() as folder:
        ours = by_radsig(Path(folder))
    theirs = by_mitsuba(mi)
    off = abs(ours / theirs - 1)
    mean_off = ours.mean() / theirs.mean() - 1
    share = (off <= PIXEL_LIMIT).mean()
    agree = abs(mean_off) <= MEAN_LIMIT and share >= PIXEL_SHARE
    print(json.dumps({"mitsuba": mi.__version__, "variant": mi.variant(),
                      "mean_w_m2_sr": [round(ours.mean(), 5), round(theirs.mean(), 5)],
                      "mean_off": round(mean_off, 6), "rms_off": round(float(np.sqrt((off**2).mean())), 6),
                      "worst_off": round(float(off.max()), 5), "share_within_2_percent": round(share, 5)}))
    print("mitsuba_check: " + ("they agree" if agree else "they do not agree"))
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
