"""The lobes of what a surface reflects, in float64 numpy; directions are unit, shape (3, ...)."""
import numpy as np

SUN_RADIUS = 4.6505e-3  # rad: 695700 km seen from 1 au


def of_slopes(roughness, normal, view, from_):
    """GGX's distribution of the half vector times Smith's masking over 4 (n.v): the density of what
    facets seen from `view` mirror, as Walter and others (2007) and Heitz (2014) write it."""
    h = view[:, None] + from_
    h = h / np.linalg.norm(h, axis=0)
    a2, up = roughness**2, normal @ h
    d = np.where(up > 0, a2 / (np.pi * up**4 * (a2 + (1 - up**2) / up**2) ** 2), 0)
    view_up = normal @ view
    g1 = 2 / (1 + np.sqrt(1 + a2 * (1 - view_up**2) / view_up**2))
    return g1 * d / (4 * view_up)


def specular(roughness, normal, view, from_):
    """What goes below the surface is turned up."""
    below = from_ - 2 * normal[:, None] * (normal @ from_)
    both = of_slopes(roughness, normal, view, from_) + of_slopes(roughness, normal, view, below)
    return np.where(normal @ from_ > 0, both, 0)


def of_sun(roughness, normal, view, sun):
    """The lobe as wide as the disc makes it."""
    wide = np.hypot(roughness, SUN_RADIUS / 2)
    return specular(wide, normal, view, np.asarray(sun)[:, None])[0]


def over_reflectance(rows):
    """1 / (1 - e_hemi) of emissivities of 0, 1 .. 90 degrees, shape (91, n): 2 integral (1 - e) cos
    sin, trapezoids of .01 degree between them."""
    fine = np.linspace(0, 90, 9001)
    reflects = np.stack([np.interp(fine, np.arange(91), 1 - e) for e in rows.T], axis=1)
    weight = np.sin(np.radians(2 * fine))[:, None]
    return 1 / np.trapz(reflects * weight, np.radians(fine), axis=0)
