"""Reads the ENVI images that radsig writes, with python3-spectral."""

import numpy as np
import spectral.io.envi


def read(stem):
    """Returns the header (a dict) and the planes by name without unit, each of shape (rows, columns);
    a pixel without a value is NaN."""
    image = spectral.io.envi.open(f"{stem}.hdr", f"{stem}.img")
    values = np.array(image.load(), dtype=np.float32)
    values[values == float(image.metadata["data ignore value"])] = np.nan
    names = [name.split(" [")[0] for name in image.metadata["band names"]]
    return image.metadata, {name: values[:, :, i] for i, name in enumerate(names)}
