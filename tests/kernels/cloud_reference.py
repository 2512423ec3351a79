"""A scattering layer in float64 numpy: the equations of two streams, solved by collocation."""
import numpy as np


def chebyshev(n):
    """Points from 1 to -1 and the matrix that differentiates there."""
    x = np.cos(np.pi * np.arange(n + 1) / n)
    c = np.r_[2, np.ones(n - 1), 2] * (-1) ** np.arange(n + 1)
    apart = x[:, None] - x[None]
    d = np.outer(c, 1 / c) / (apart + np.eye(n + 1))
    return x, d - np.diag(d.sum(1))


X, DERIVATIVE = chebyshev(120)


def two_streams(depth, albedo, asymmetry, mu):
    """Zdunkowski's coefficients on a layer scaled by its forward peak g^2; up and down fluxes by
    collocation, for diffuse light of 1 and then for a sun of 1 on a level plane."""
    peak = asymmetry**2
    scaled = depth * (1 - albedo * peak)
    w, g = albedo * (1 - peak) / (1 - albedo * peak), asymmetry / (1 + asymmetry)
    a, b = (8 - w * (5 + 3 * g)) / 4, 3 * w * (1 - g) / 4
    n = len(X)
    d = DERIVATIVE * -2 / scaled  # optical depth from the top, where x is 1
    t = scaled * (1 - X) / 2
    system = np.block([[d - a * np.eye(n), b * np.eye(n)], [-b * np.eye(n), d + a * np.eye(n)]])
    beam = np.exp(-t / mu) / mu
    back = (2 - 3 * g * mu) / 4
    right = np.zeros((2 * n, 2))
    right[:n, 1], right[n:, 1] = -w * back * beam, w * (1 - back) * beam
    for row, value in ((n - 1, 0), (n, [1, 0])):  # none from below; diffuse light from above
        system[row] = 0
        system[row, row] = 1
        right[row] = value
    up, down = np.split(np.linalg.solve(system, right), 2)
    direct = np.exp(-scaled / mu) - np.exp(-depth / mu)
    return up[0, 0], down[-1, 0], up[0, 1], down[-1, 1] + direct
