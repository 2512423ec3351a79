"""Writes a radiance database as a container, from functions of the wavelength."""
import json

import numpy as np


def write(file, low_um, high_um, air, sensor_altitude_m=10000.0, step_cm1=2.0, zenith_deg=(0, 80, 10),
          targets_m=(), ranges_m=(), ground_k=300.0):
    """air: an object with methods of the wavelengths in um, which give W m-2 sr-1 um-1:
         sun(um)                 E_S tau1
         sky(um, zenith_deg)
         path(um, altitude_m, zenith_deg)   from there up to the sensor: transmission, radiance
         level(um, range_m)                 along the ground: the same"""
    wavenumber = np.arange(np.floor(1e4 / low_um / step_cm1) + 2, np.ceil(1e4 / high_um / step_cm1) - 2,
                           -1) * step_cm1
    um, first, last, step = 1e4 / wavenumber, *zenith_deg
    zeniths = np.arange(first, last + 1, step)
    flat = np.ones_like(um)
    sky = [air.sky(um, z) for z in range(0, 91, 15)]
    path = lambda altitude: [air.path(um, altitude, z) for z in zeniths]
    level = [air.level(um, m) for m in ranges_m]
    paths = np.array([path(0.0), *map(path, targets_m)])  # altitude, zenith, quantity, wavelength
    mu = np.cos(np.radians(np.linspace(.05, 89.95, 900)))
    mean = sum(air.sky(um, np.degrees(np.arccos(m))) * m * np.sqrt(1 - m * m) for m in mu) / np.sum(
        mu * np.sqrt(1 - mu * mu))
    arrays = [air.sun(um), flat, np.full(len(zeniths), 1e4), paths[0, :, 0], paths[0, :, 1],
              0 * paths[0, :, 1], mean, 0 * um, sky, 0 * np.array(sky), [0.0, 1e5],
              [ground_k, ground_k]]
    if targets_m:
        arrays += [targets_m, np.full((len(targets_m), len(zeniths)), 1e4), paths[1:, :, 0],
                   paths[1:, :, 1], 0 * paths[1:, :, 1]]
    if ranges_m:
        arrays += [ranges_m, [t for t, _ in level], [r for _, r in level], [0 * um for _ in level]]
    keys = dict(
        sensor_altitude_m=sensor_altitude_m, wavenumber_min_cm1=wavenumber[-1],
        wavenumber_max_cm1=wavenumber[0], wavenumber_step_cm1=step_cm1, point_count=len(um),
        path_zenith_first_deg=first, path_zenith_step_deg=step, path_zenith_meaningful_deg=last,
        path_count=len(zeniths), zenith_step_deg=15, zenith_count=7, azimuth_step_deg=0,
        azimuth_count=1, level_count=2)
    if targets_m:
        keys["target_count"] = len(targets_m)
    if ranges_m:
        keys["range_count"] = len(ranges_m)
    lines = [f"{json.dumps(k)}: {v}," for k, v in keys.items()]
    text = "\n".join(["RADSIG ATMOSPHERE 1", "{", *lines, '"header": [', '"# by hand"', "]", "}", ""])
    numbers = np.concatenate([np.ravel(a) for a in arrays]).astype("<f4")
    file.write_bytes(text.encode() + numbers.tobytes())
