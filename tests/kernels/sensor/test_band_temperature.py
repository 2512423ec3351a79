import numpy as np
import probe
import pytest
import records
from radiometry_reference import FIRST, SECOND, planck

BANDS = [(8.0, 14.0), (3.0, 5.0), (0.4, 0.7)]
KELVIN = records.BAND_LOWEST_K * (records.BAND_HIGHEST_K / records.BAND_LOWEST_K) ** (
    np.arange(records.BAND_TEMPERATURES) / (records.BAND_TEMPERATURES - 1))


def samples(low_um, high_um):
    """Wavelengths and weights every 10 cm-1, padded to 16 with weight 0."""
    steps = int((1e4 / low_um - 1e4 / high_um) / 10)
    wavelength = 1e4 / np.linspace(1e4 / low_um, 1e4 / high_um, steps + 1)
    weight = 0.5 * (np.diff(wavelength, prepend=low_um) + np.diff(wavelength, append=high_um))
    pad = -len(weight) % 16
    return np.pad(wavelength, (0, pad), mode="edge"), np.pad(weight, (0, pad))


@pytest.fixture(scope="module")
def tables(opencl):
    """ln of the radiance in band by the kernel, shape (bands, BAND_TEMPERATURES)."""
    of_band = [samples(*edges) for edges in BANDS]
    wavelength, weight = (np.concatenate(x) for x in zip(*of_band))
    bands = np.zeros(len(BANDS), records.BAND)
    bands["sample_count"] = [len(w) for w, _ in of_band]
    bands["first_sample"][1:] = np.cumsum(bands["sample_count"])[:-1]
    bands["first_weight"] = bands["first_sample"]
    rows = np.array([weight, FIRST / wavelength**5, SECOND / wavelength], np.float32)
    out = np.empty((len(BANDS), records.BAND_TEMPERATURES), np.float32)
    opencl.run("band_temperature", (records.BAND_TEMPERATURES // 16, len(BANDS)),
               sample_count=len(weight), spectra=rows, bands=bands, weights=np.float32(weight),
               ln_radiance=out)
    return out


def find(opencl, table, radiance):
    """Temperatures of radiances, K."""
    padded = np.resize(np.asarray(radiance, np.float32), records.BAND_TEMPERATURES)
    found = probe.probe(opencl, "band_temperature.h",
                        "out[0] = band_temperature_find(in0, in1[i]);", [table, padded],
                        options="-DLANES_WIDTH=1")[0]
    return found[: len(radiance)]


def ln_radiance(wavelength_um, weight, temperature_k):
    """ln of the sum in float64, the largest term taken out."""
    x = SECOND / (wavelength_um * temperature_k[:, None])
    with np.errstate(divide="ignore"):
        terms = np.log(weight * FIRST / wavelength_um**5) - x - np.log1p(-np.exp(-x))
    return np.logaddexp.reduce(terms, axis=1)


@pytest.mark.parametrize("band", range(len(BANDS)))
def test_the_table_equals_double_precision(tables, band):
    expected = ln_radiance(*samples(*BANDS[band]), KELVIN)

    # A row's temperature is the exponential of a float32 of up to 10, off by 6e-7 of itself, and the
    # sum is rounded a few times more: 2e-6 in ln T.
    slope = np.gradient(expected, np.log(KELVIN))
    assert np.max(abs(tables[band] - expected) / np.maximum(1, slope)) < 2e-6


@pytest.mark.parametrize("band, low_k, high_k", [(0, 150, 400), (1, 150, 400), (2, 2000, 7000)])
def test_the_temperature_of_a_black_body_is_found(opencl, tables, band, low_k, high_k):
    wavelength, weight = samples(*BANDS[band])
    temperature = np.linspace(low_k, high_k, 1000)
    radiance = [(weight * planck(wavelength, t)).sum() for t in temperature]

    found = find(opencl, tables[band], radiance)

    assert abs(found - temperature).max() < (0.002 if high_k < 1000 else 0.05)


def test_no_radiance_and_less_have_no_temperature(opencl, tables):
    found = find(opencl, tables[0], [0.0, -1.0, -np.inf, np.nan, np.inf])

    assert np.all(found == -1)


def test_radiances_beyond_the_ends_of_the_table_have_no_temperature(opencl, tables):
    above = np.exp(tables[1][-1].astype(float)) * 1.001

    assert find(opencl, tables[1], [above])[0] == -1
    assert find(opencl, tables[1], [above * 0.998])[0] == pytest.approx(20000, rel=0.003)
