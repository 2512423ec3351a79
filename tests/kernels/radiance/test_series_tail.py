"""What is left of a series that was broken off, against closed forms."""
import numpy as np
import pytest
from probe import probe


def tail(opencl, first, middle, last):
    return probe(opencl, "series_tail.h", "out[0] = series_tail(in0[i], in1[i], in2[i]);",
                 [np.array(x, float) for x in (first, middle, last)], options="-DSPECTRUM_WIDTH=1")[0]


@pytest.mark.parametrize("ratio", [0.01, 0.3, 0.9, 0.98])
def test_of_a_geometric_series_it_is_the_rest(opencl, ratio):
    sums = 5 + 3 * np.cumsum(ratio ** np.arange(3.0))

    rest = tail(opencl, *sums[:, None])

    assert rest == pytest.approx(3 * ratio**3 / (1 - ratio), rel=1e-6 / (1 - ratio) ** 2, abs=1e-6)


@pytest.mark.parametrize("sums", [(1.0, 1.0, 1.0), (1.0, 2.0, 3.0), (1.0, 2.0, 4.0), (1.0, 2.0, 1.5),
                                  (1.0, 1.0, 2.0), (0.0, 0.0, 0.0)])
def test_it_is_nothing_where_the_sums_do_not_fall_by_a_ratio(opencl, sums):
    assert tail(opencl, *np.array(sums)[:, None]) == 0
