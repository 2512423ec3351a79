import numpy as np
import records

NONE = 0xFFFFFFFF


def test_a_pixel_has_the_temperature_of_its_facet_and_no_history(opencl):
    hit = np.zeros(3, records.HIT)
    hit["facet"] = [1, NONE, 0]
    temperature_k, planes = np.zeros(3, np.float32), np.zeros((5, 3), np.float32)

    opencl.run("facet_temperature", (64,), (64,), count=3, first_plane=3, hit=hit,
               temperature_k=np.float32([290, 310]), out_k=temperature_k, planes=planes)

    assert list(temperature_k) == [310.0, 0.0, 290.0]
    assert (planes[:3] == 0).all() and (planes[3:] == -9999).all()
