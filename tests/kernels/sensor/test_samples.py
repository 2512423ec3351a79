import numpy as np
import pytest
import records

COUNT = 50


def planes_of_samples(samples, none=0.2):
    """Shape (3, COUNT, samples): continuous values, numbers of things, and those that one in five lacks."""
    random = np.random.default_rng(7)
    planes = np.stack([random.normal(300.0, 20.0, (COUNT, samples)),
                       random.integers(0, 4, (COUNT, samples)),
                       random.normal(10.0, 2.0, (COUNT, samples))]).astype(np.float32)
    planes[2][random.random((COUNT, samples)) < none] = records.NO_VALUE
    planes[2, 0] = records.NO_VALUE
    return planes


def truth_mean(opencl, planes, categorical):
    count, pixels, samples = planes.shape
    out = np.empty((count, pixels), np.float32)
    opencl.run("truth_mean", (pixels, count), pixel_count=pixels, sample_count=samples,
               categorical=categorical, samples=planes, planes=out)
    return out


@pytest.mark.parametrize("samples", [4, 9, 64])
def test_the_mean_of_samples_is_that_of_those_with_a_value(opencl, samples):
    planes = planes_of_samples(samples)

    got = truth_mean(opencl, planes, 0b010)

    valued = np.ma.masked_equal(planes.astype(float), records.NO_VALUE).mean(axis=2)
    expected = valued.filled(records.NO_VALUE)
    assert got[[0, 2]] == pytest.approx(expected[[0, 2]], rel=1e-6)  # float32 sums of differences
    assert got[2, 0] == records.NO_VALUE


def test_samples_that_agree_have_their_own_value_as_mean(opencl):
    planes = np.full((1, 3, 25), np.float32(288.123), np.float32)

    assert (truth_mean(opencl, planes, 0) == np.float32(288.123)).all()


@pytest.mark.parametrize("samples", [4, 9, 64])
def test_the_mode_of_samples_is_the_commonest_and_of_equals_the_lowest(opencl, samples):
    planes = planes_of_samples(samples)

    got = truth_mean(opencl, planes, 0b010)[1]

    values = [np.unique(pixel, return_counts=True) for pixel in planes[1]]  # ascending
    assert list(got) == [value[np.argmax(count)] for value, count in values]


def padded(planes):
    """Rows as long as whole groups of pixels."""
    return np.pad(planes, ((0, 0), (0, 0), (0, -planes.shape[2] % records.PIXEL_GROUP)))


def band_mean(opencl, samples_of, bands, ln_radiance):
    """All planes, from all but the apparent temperature and the standard error."""
    count, _, pixels, samples = samples_of.shape
    wants = (1 << records.BAND_PLANES) - 1
    planes = [k for k in range(records.BAND_PLANES)
              if k not in (records.BAND_APPARENT, records.BAND_STDERR)]
    own = padded(samples_of[:, planes].reshape(count, len(planes), -1))
    row = -(-pixels // records.PIXEL_GROUP) * records.PIXEL_GROUP
    out = np.empty((count, records.BAND_PLANES, row), np.float32)
    opencl.run("band_mean", (pixels, count), pixel_count=pixels, sample_count=samples, wants=wants,
               has=sum(1 << k for k in planes), bands=bands, ln_radiance=ln_radiance, samples=own,
               planes=out)
    return out[..., :pixels]


@pytest.mark.parametrize("is_mean", [0, 1])
def test_band_planes_of_samples_are_means_with_their_standard_error(opencl, is_mean):
    random = np.random.default_rng(3)
    samples_of = random.normal(40.0, 3.0, (2, records.BAND_PLANES, COUNT, 16)).astype(np.float32)
    bands = np.zeros(2, records.BAND)
    bands["width_um"], bands["is_mean"] = 5.0, is_mean
    # A body whose radiance is its temperature.
    kelvin = records.BAND_LOWEST_K * (records.BAND_HIGHEST_K / records.BAND_LOWEST_K) ** (
        np.arange(records.BAND_TEMPERATURES) / (records.BAND_TEMPERATURES - 1))
    ln_radiance = np.log(np.stack([kelvin, kelvin])).astype(np.float32)

    planes = band_mean(opencl, samples_of, bands, ln_radiance)

    mean = samples_of.astype(float).mean(axis=3)
    end = records.BAND_PARTS + records.RADIANCE_PARTS
    others = [k for k in range(end) if k != 2]
    assert planes[:, others] == pytest.approx(mean[:, others], rel=1e-6)
    error = samples_of[:, 0].astype(float).std(axis=2, ddof=1) / 4
    assert planes[:, records.BAND_STDERR] == pytest.approx(error, rel=1e-5)
    # The table's steps are 1 %; between them 1/T is linear in ln L: 1.3e-5 of T.
    apparent_c = mean[:, 0] * (5.0 if is_mean else 1.0) - 273.15
    assert planes[:, 2] == pytest.approx(apparent_c, abs=0.005)
