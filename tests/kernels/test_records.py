import numpy as np
import probe
import pyopencl as cl
import pytest
import ray_world
import records
import thermal_reference
from records import TWINS

def device_layout(opencl, name, fields):
    """Offset and size of every field, and last the record's size, as the device has them."""
    lines = "".join(f"out[{2 * i}] = (global char *)&r->{field} - (global char *)r;"
                    f"out[{2 * i + 1}] = sizeof(r->{field});" for i, field in enumerate(fields))
    source = ('#include "kernels/records.h"\n'
              f"kernel void layout(global const {name} *r, global uint *out)"
              f"{{ {lines} out[{2 * len(fields)}] = sizeof(*r); }}")
    program = cl.Program(opencl.context, source).build(f"-cl-std=CL1.2 -I {probe.ROOT}")
    record = probe.copy(opencl, np.zeros(512, np.uint8))
    return probe.launch(opencl, program.layout, 1, [record], 2 * len(fields) + 1, np.uint32)


@pytest.mark.parametrize("name", TWINS)
def test_numpy_and_device_agree_on_where_fields_lie(opencl, name):
    dtype = TWINS[name]

    layout = device_layout(opencl, name, dtype.names)

    expected = [n for f in dtype.names for n in (dtype.fields[f][1], dtype[f].itemsize)]
    assert list(layout) == expected + [dtype.itemsize]


@pytest.mark.parametrize("name", TWINS)
def test_a_record_is_a_multiple_of_16_bytes(name):
    assert TWINS[name].itemsize % 16 == 0


def test_every_record_of_the_header_has_a_twin():
    text = (probe.ROOT / "kernels/records.h").read_text()

    sized = {line.split("(")[1].split(",")[0] for line in text.splitlines()
             if line.startswith("RECORD_SIZE(")}
    assert sized == set(TWINS)


@pytest.mark.parametrize("name, dtype", [
    ("HIT", ray_world.HIT), ("WORLD", ray_world.WORLD), ("BACKGROUND", ray_world.BACKGROUND),
    ("CAMERA", ray_world.CAMERA), ("FACET", ray_world.FACET), ("MATERIAL", ray_world.MATERIAL),
    ("FACET", thermal_reference.FACET), ("MATERIAL", thermal_reference.MATERIAL),
    ("FORCING", thermal_reference.FORCING), ("SPAN", thermal_reference.SPAN)])
def test_other_twins_agree_where_they_name_the_same_field(name, dtype):
    whole = getattr(records, name)

    shared = [f for f in dtype.names if f in whole.names and not f.startswith("unused")]
    assert shared and dtype.itemsize == whole.itemsize
    assert [dtype.fields[f][:2] for f in shared] == [whole.fields[f][:2] for f in shared]


@pytest.mark.parametrize("name", [
    "BAND_PLANES", "BAND_PARTS", "RADIANCE_PARTS", "BAND_STDERR", "TRUTH_PLANES", "BAND_RADIANCE", "BAND_COUNTS",
    "BAND_APPARENT", "BAND_EMISSIVITY", "BAND_BACKGROUND_EMISSIVITY", "PIXEL_GROUP", "BAND_TEMPERATURES", "BAND_LOWEST_K",
    "BAND_HIGHEST_K", "NO_VALUE", "SPECTRA_WEIGHT", "SPECTRA_PLANCK_FIRST", "SPECTRA_PLANCK_SECOND", "SPECTRA_SUN",
    "SPECTRA_SKY", "SPECTRA_PATHS", "INTERACTION_MISSED", "INTERACTION_DIFFUSE",
    "INTERACTION_SPECULAR_SKY", "INTERACTION_SPECULAR_BACKGROUND"])
def test_constants_are_the_device_s(opencl, name):
    of_device = probe.probe(opencl, "pixel.h", f"out[0] = {name};", [[0.0]])[0, 0]

    own = name.removeprefix("SPECTRA_").removeprefix("INTERACTION_")
    assert of_device == getattr(records, own)
