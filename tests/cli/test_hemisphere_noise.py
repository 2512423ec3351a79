"""Exact mode: how far a pixel is from what its hemisphere brings, in rms over the pixels of a picture, with one sample
a pixel and with sixteen; against closed forms (Howell's catalogue of configuration factors, C-13 and B-1)."""
import numpy as np
import pytest

LWIR = (8.0, 14.0)
EMISSIVITY = 0.5  # of the floor, which at 1 K emits nothing


def quad(name, *corners):
    """A facet as text, its vertices counted from the end."""
    return "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + f"usemtl {name}\nf -4 -3 -2 -1\n"


FLOOR = quad("floor", (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
WEST = quad("west", (0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1))
EAST = quad("east", (1, 1, 0), (1, 0, 0), (1, 0, 1), (1, 1, 1))
SOUTH = quad("south", (1, 0, 0), (0, 0, 0), (0, 0, 1), (1, 0, 1))
NORTH = quad("north", (0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1))

WALLS_K = {"west": 400.0, "east": 300.0, "south": 350.0, "north": 250.0}


def to_wall(distance, left, right, height):
    """The fraction of its hemisphere that an upright rectangle takes on the floor of a point.
    distance to its plane; left, right: how far it reaches to both sides of the foot."""
    slant = np.hypot(distance, height)
    return sum(np.arctan2(side, distance) - distance / slant * np.arctan2(side, slant)
               for side in (left, right)) / (2 * np.pi)


def fractions(x, y):
    """Of the four walls around a unit square."""
    return {"west": to_wall(x, y, 1 - y, 1), "east": to_wall(1 - x, y, 1 - y, 1),
            "south": to_wall(y, x, 1 - x, 1), "north": to_wall(1 - y, x, 1 - x, 1)}


def camera(pixels, width=1.0, height=0.9):
    return {"projection": "orthographic", "width_m": width, "focal_length_mm": None,
            "position_m": [0.5, 0.5, height], "target_m": [0.5, 0.5, 0.0],
            "pixels": [pixels, pixels]}


def floor_picture(program, folder, mesh, walls_k, pixels, samples, width=1.0, **changes):
    """What the floor reflects, in radiances of the band, as the picture shows it."""
    materials = [{"name": "floor", "emissivity": EMISSIVITY, "temperature_k": 1.0}]
    materials += [{"name": n, "emissivity": 1.0, "temperature_k": t} for n, t in walls_k.items()]
    got = program.render(folder, meshes={"court.obj": FLOOR + mesh},
                         geometry=[{"file": "court.obj"}], material=materials,
                         camera=camera(pixels, width),
                         render={"samples_per_pixel": samples, **changes.pop("render", {})}, **changes)
    return got.planes["radiance_lwir"] / (1 - EMISSIVITY)


def area_mean(function, pixels, points=8):
    """The mean of a function of the floor's place over each pixel, north on top."""
    at = (np.arange(pixels * points) + 0.5) / (pixels * points)
    x, y = np.meshgrid(at, at[::-1])
    return function(x, y).reshape(pixels, points, pixels, points).mean(axis=(1, 3))


def middle(function, pixels):
    return area_mean(function, pixels, 1)


def expected(radiance, names, x, y):
    parts = fractions(x, y)
    return sum(parts[n] * radiance.band_planck(*LWIR, WALLS_K[n]) for n in names)


@pytest.mark.parametrize("mesh, names, bounds", [
    pytest.param(WEST, ["west"], (0.01, 0.003), id="wall"),
    pytest.param(WEST + EAST + SOUTH + NORTH, ["west", "east", "south", "north"], (0.008, 0.001), id="court"),
])
@pytest.mark.parametrize("samples", [1, 16])
def test_rms_beside_walls(program, radiance, tmp_path, mesh, names, bounds, samples):
    pixels = 50
    got = floor_picture(program, tmp_path, mesh, {n: WALLS_K[n] for n in names}, pixels, samples)

    exact = (middle if samples == 1 else area_mean)(
        lambda x, y: expected(radiance, names, x, y), pixels)
    far = slice(2, -2)  # pixels farther than .03 from a wall
    error = (got / exact - 1)[far, far]
    assert np.sqrt((error**2).mean()) < bounds[samples > 1]
    assert abs((got - exact)[far, far].mean() / exact[far, far].mean()) < 0.0005


@pytest.mark.parametrize("samples, bound", [(1, 0.01), (16, 0.0015)])
def test_rms_in_a_street_canyon(program, radiance, tmp_path, samples, bound):
    """Walls as high as the street is wide, a hundred times as long, under a sky of their own temperature."""
    west = quad("west", (0, -50, 0), (0, 51, 0), (0, 51, 1), (0, -50, 1))
    east = quad("east", (1, 51, 0), (1, -50, 0), (1, -50, 1), (1, 51, 1))
    pixels, sky_k = 50, 260.0
    walls_k = {n: WALLS_K[n] for n in ("west", "east")}
    got = floor_picture(program, tmp_path, west + east, walls_k, pixels, samples,
                        atmosphere={"uniform": {**program.vacuum, "sky_temperature_k": sky_k}})

    def arriving(x, y):
        parts = to_wall(x, y + 50, 51 - y, 1), to_wall(1 - x, y + 50, 51 - y, 1)
        black = [radiance.band_planck(*LWIR, t) for t in (*walls_k.values(), sky_k)]
        return parts[0] * black[0] + parts[1] * black[1] + (1 - sum(parts)) * black[2]

    exact = (middle if samples == 1 else area_mean)(arriving, pixels)
    error = (got / exact - 1)[:, 2:-2]  # farther than .03 from a wall
    assert np.sqrt((error**2).mean()) < bound
    assert abs(error.mean()) < 0.0005


def boxes(count, rng):
    """Boxes on a plane of 1 m, each with four sides and a top, facing outwards."""
    text = ""
    for _ in range(count):
        x, y = rng.uniform(0.05, 0.9, 2)
        a, b, c = rng.uniform(0.02, 0.08, 3)
        low, high = (x, x + a), (y, y + b)
        text += quad("west", (low[0], high[0], 0), (low[0], high[0], c), (low[0], high[1], c),
                     (low[0], high[1], 0))
        text += quad("west", (low[1], high[1], 0), (low[1], high[1], c), (low[1], high[0], c),
                     (low[1], high[0], 0))
        text += quad("west", (low[1], high[0], 0), (low[1], high[0], c), (low[0], high[0], c),
                     (low[0], high[0], 0))
        text += quad("west", (low[0], high[1], 0), (low[0], high[1], c), (low[1], high[1], c),
                     (low[1], high[1], 0))
        text += quad("west", (low[0], high[0], c), (low[1], high[0], c), (low[1], high[1], c),
                     (low[0], high[1], c))
    return text


@pytest.mark.parametrize("samples, bound", [(1, 0.025), (16, 0.003)])
def test_rms_among_boxes(program, tmp_path, samples, bound):
    mesh, pixels = boxes(40, np.random.default_rng(1)), 32
    sky = {"uniform": {**program.vacuum, "sky_temperature_k": 250.0}}
    pictures = []
    for name, render in [("some", {}),
                         ("dense", {"hemisphere_step_deg": {"zenith": 1.5, "azimuth": 3}})]:
        folder = tmp_path / name
        folder.mkdir()
        pictures.append(floor_picture(program, folder, mesh, {"west": 310.0}, pixels, samples,
                                      width=0.1, atmosphere=sky, render=render))

    floor = pictures[1] < 0.9 * pictures[1].max()  # boxes emit much more
    error = (pictures[0] / pictures[1] - 1)[floor]
    assert np.sqrt((error**2).mean()) < bound
    assert abs(error.mean()) < 0.0005
