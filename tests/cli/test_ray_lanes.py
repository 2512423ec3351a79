"""Rays in packets of 16, as on CPUs, and one by one, as on GPUs, make the same images."""
import os

import numpy as np
import pytest


@pytest.mark.parametrize("mode", ["exact", "thesis"])
def test_single_rays_make_the_image_that_packets_make(program, airport, tmp_path, mode):
    images = []
    for lanes in ("1", "16"):
        out = tmp_path / lanes
        done = program.run("render", airport, "-o", out, "--size", "72x48", "--mode", mode,
                           env={**os.environ, "RADSIG_RAY_LANES": lanes})
        assert done.returncode == 0, done.stderr
        images.append(program.load(out, "airport"))

    one, many = images
    assert one.planes.keys() == many.planes.keys() and len(one.planes) > 5
    for name in one.planes:
        # PoCL's exp and acos of vectors differ from those of scalars in their last bit; that of a
        # temperature about 300 K is 3.1e-5 K.
        last_bit = 3.1e-5 if name.endswith("_c") else 0.0
        np.testing.assert_allclose(one.planes[name], many.planes[name], rtol=1e-6, atol=last_bit,
                                   err_msg=name)
