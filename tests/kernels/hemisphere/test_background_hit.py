import numpy as np
import records


def run(opencl, background):
    hit = np.empty(len(background), records.HIT)
    opencl.run("background_hit", (64,), count=len(background), background=background, hit=hit)
    return hit


def test_the_point_met_becomes_a_hit(opencl):
    background = np.zeros(3, records.BACKGROUND)
    background["facet"] = (4, 9, 2)
    background["point"] = np.arange(9).reshape(3, 3)
    background["normal"] = ((0, 0, 1), (0, 1, 0), (-1, 0, 0))

    hit = run(opencl, background)

    for name in ("facet", "point", "normal"):
        assert np.array_equal(hit[name], background[name])


def test_no_background_is_a_miss(opencl):
    background = np.zeros(2, records.BACKGROUND)
    background["facet"] = records.NONE

    hit = run(opencl, background)

    assert np.all(hit["facet"] == records.NONE) and np.all(np.isinf(hit["range_m"]))
