"""The equations of kernels/thermal/thermal.h in float64 numpy, all facets at once; slabs by a dense solve."""
import numpy as np
import records

SIGMA = 5.670374419e-8
GROUND_REFLECTANCE = 0.15
NODES = 8


class Body:
    """What does not change with time; arrays of shape (facets)."""

    def __init__(self, facets, materials):
        of = materials[facets["material"]]
        read = lambda records, name: records[name].astype(np.float64)
        area = read(of, "exposed_area")
        self.normal = read(facets, "normal")
        self.two_sided = facets["two_sided"] != 0
        self.front = np.minimum(1, 2 * abs(area))
        self.back = np.maximum(0, 2 * abs(area) - 1)
        self.slab = area < 0
        self.absorptance = read(of, "solar_absorptance")
        self.emissivity = read(of, "thermal_emissivity")
        self.power = read(facets, "power_w_m2")
        self.capacity = (read(of, "density_kg_m3") * read(of, "specific_heat_j_kg_k")
                         * read(facets, "thickness_m"))
        self.conductance = read(of, "conductivity_w_m_k") / read(facets, "thickness_m")


def load_of(body, now, lit):
    """Row by row: direct, steady, back, convection, air, rain, rain temperature."""
    now = {name: np.float64(now[name]) for name in records.FORCING.names}
    sky = 0.5 * (1 + body.normal[:, 2])
    cosine = body.normal @ now["sun"]
    facing = np.where(body.two_sided, abs(cosine), np.maximum(0, cosine))
    level = now["direct_w_m2"] * max(0, now["sun"][2]) + now["diffuse_w_m2"]
    air = SIGMA * now["air_temperature_k"] ** 4
    sunlight = sky * now["diffuse_w_m2"] + (1 - sky) * GROUND_REFLECTANCE * level
    longwave = sky * now["sky_longwave_w_m2"] + (1 - sky) * air
    one = np.ones(len(sky))
    return np.array([
        body.front * body.absorptance * lit * facing * now["direct_w_m2"],
        body.power + body.front * (body.absorptance * sunlight + body.emissivity * longwave),
        body.back * body.emissivity * air,
        now["convection_w_m2_k"] * one,
        now["air_temperature_k"] * one,
        body.front * np.maximum(0, body.normal[:, 2]) * now["rain_w_m2_k"],
        now["rain_temperature_k"] * one])


def front_flux(body, load, t):
    direct, steady, _, convection, air, rain, rain_k = load
    emissivity = body.front * body.emissivity
    h = body.front * convection
    flux = direct + steady - emissivity * SIGMA * t**4 + h * (air - t) + rain * (rain_k - t)
    return flux, 4 * emissivity * SIGMA * t**3 + h + rain


def back_flux(body, load, t):
    emissivity, h = body.back * body.emissivity, body.back * load[3]
    flux = load[2] - emissivity * SIGMA * t**4 + h * (load[4] - t)
    return flux, 4 * emissivity * SIGMA * t**3 + h


def dew(body, load, now, t, film, dt):
    """Heat that vapour takes from the front, its slope, and the heat of a kilogram."""
    if not now["wet_below_k"] > 0:
        return 0 * t, 0 * t, 1 + 0 * t
    c, p = t - 273.15, np.float64(now["pressure_pa"])
    a, b = np.where(c < 0, 22.46, 17.62), np.where(c < 0, 272.62, 243.12)
    heat = np.where(c < 0, 2.83e6, 2.501e6 - 2361 * c)
    vapour = lambda c: 611.2 * np.exp(a * c / (b + c))
    wet = lambda c: 0.622 * vapour(c) / (p - 0.378 * vapour(c))
    passes = body.front * load[3] / 1005 * heat
    flux = passes * (wet(c) - np.float64(now["specific_humidity"]))
    slope = passes * (wet(c + 1e-4) - wet(c - 1e-4)) / 2e-4
    held = film * heat / dt
    return np.minimum(flux, held), np.where(flux > held, 0, slope), heat


def film_after(film, lost, heat, dt):
    return np.clip(film - dt * lost / heat, 0, 0.3)


def start(body, load, ratio=1):
    """Bisection: the balance of both faces falls with the front's temperature."""
    low, high = np.full_like(body.front, 1.0), np.full_like(body.front, 2000.0)
    through = np.where(body.slab, body.conductance, 1e12)
    for _ in range(200):
        front = 0.5 * (low + high)
        flux, _ = front_flux(body, load, front)
        back = front - flux / through
        warms = flux + back_flux(body, load, np.maximum(back, 1.0))[0] > 0
        low, high = np.where(warms, front, low), np.where(warms, high, front)
    fraction = np.cumsum(thickness(ratio)) - thickness(ratio) / 2
    return front, back, front[:, None] + fraction * (back - front)[:, None]


def thickness(ratio):
    """Of each node, of a slab of 1."""
    parts = float(ratio) ** np.arange(NODES)
    return parts / parts.sum()


def step_slab(body, load, dt, front, back, node, back_slope, vapour, ratio=1):
    """Backward Euler over face, nodes, face; the faces have no capacity. The back's flux falls with
    its temperature as it did at the last record of the weather."""
    count, part = len(front), thickness(ratio)
    middle = np.concatenate([[0], np.cumsum(part) - part / 2, [1]])
    link = body.conductance[:, None] / np.diff(middle)
    store = body.capacity[:, None] * part / dt
    a, b = np.zeros((count, NODES + 2, NODES + 2)), np.zeros((count, NODES + 2))
    for face, t, flux_of in ((0, front, front_flux), (NODES + 1, back, back_flux)):
        flux, slope = flux_of(body, load, t)
        if face > 0:
            slope = back_slope
        else:
            flux, slope = flux - vapour[0], slope + vapour[1]
        inner, g = (1, link[:, 0]) if face == 0 else (NODES, link[:, NODES])
        a[:, face, face], a[:, face, inner] = slope + g, -g
        b[:, face] = flux + slope * t
    for j in range(1, NODES + 1):
        a[:, j, j] += store[:, j - 1]
        b[:, j] = store[:, j - 1] * node[:, j - 1]
        for other, g in ((j - 1, link[:, j - 1]), (j + 1, link[:, j])):
            a[:, j, j] += g
            a[:, j, other] -= g
    t = np.linalg.solve(a, b[:, :, None])[:, :, 0]
    return t[:, 0], t[:, -1], t[:, 1:-1]


def step_lump(body, load, dt, t, vapour):
    """The temperature, and its mean over the step."""
    front, back = front_flux(body, load, t), back_flux(body, load, t)
    flux, slope = front[0] + back[0] - vapour[0], front[1] + back[1] + vapour[1]
    decay = slope * dt / body.capacity
    return (t - np.expm1(-decay) * flux / slope,
            t + (1 + np.expm1(-decay) / decay) * flux / slope)


def history(facets, materials, forcing, step_s, lit=None, sub_steps=4, ratio=1):
    """Temperatures, shape (steps, facets); lit: (steps, facets). Nothing is wet at first."""
    body = Body(facets, materials)
    if lit is None:
        lit = np.ones((len(forcing), len(facets)))
    before = load_of(body, forcing[0], lit[0])
    front, back, node = start(body, before, ratio)
    rows, film = [front], np.zeros(len(facets))
    for earlier, now, sun in zip(forcing, forcing[1:], lit[1:]):
        after = load_of(body, now, sun)
        back_slope = back_flux(body, before, back)[1]
        for i in range(sub_steps):
            direct = before[0] if i < sub_steps // 2 else after[0]
            middle, end = (
                np.vstack([direct[None], (before + fraction * (after - before))[1:]])
                for fraction in ((i + 0.5) / sub_steps, (i + 1) / sub_steps))
            dt = step_s / sub_steps
            air = earlier if i < sub_steps // 2 else now
            of_lump, of_slab = (dew(body, load, air, front, film, dt) for load in (middle, end))
            lump, mean = step_lump(body, middle, dt, front, of_lump)
            slab, back, node = step_slab(body, end, dt, front, back, node, back_slope, of_slab,
                                         ratio)
            film = np.where(
                body.slab, film_after(film, of_slab[0] + of_slab[1] * (slab - front), of_slab[2], dt),
                film_after(film, of_lump[0] + of_lump[1] * (mean - front), of_lump[2], dt))
            front = np.where(body.slab, slab, lump)
        before = after
        rows.append(front)
    return np.array(rows)
