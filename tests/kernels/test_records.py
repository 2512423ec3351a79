import numpy as np
import probe
import pyopencl as cl
import pytest
import records
from opencl import SCALARS, launches
from probe import ROOT
from records import TWINS

RECORDS = sorted(set(TWINS) - {"conduction_group"})  # which has as many lanes as the kernel


def device_layout(opencl, name, fields):
    """Offset and size of every field, and last the record's size, as the device has them."""
    lines = "".join(f"out[{2 * i}] = (global char *)&r->{field} - (global char *)r;"
                    f"out[{2 * i + 1}] = sizeof(r->{field});" for i, field in enumerate(fields))
    header, = launches.headers_of([name], ROOT / "kernels")
    source = (f'#include "{header}"\n'
              f"kernel void layout(global const {name} *r, global uint *out)"
              f"{{ {lines} out[{2 * len(fields)}] = sizeof(*r); }}")
    program = cl.Program(opencl.context, source).build(
        f"-cl-std=CL1.2 -I {ROOT}")
    record = probe.copy(opencl, np.zeros(512, np.uint8))
    return probe.launch(opencl, program.layout, 1, [record], 2 * len(fields) + 1, np.uint32)


@pytest.mark.parametrize("name", RECORDS)
def test_numpy_and_device_agree_on_where_fields_lie(opencl, name):
    dtype = TWINS[name]

    layout = device_layout(opencl, name, dtype.names)

    expected = [n for f in dtype.names for n in (dtype.fields[f][1], dtype[f].itemsize)]
    assert list(layout) == expected + [dtype.itemsize]


@pytest.mark.parametrize("name", RECORDS)
def test_a_record_is_a_multiple_of_16_bytes(name):
    assert TWINS[name].itemsize % 16 == 0


def test_every_record_that_a_kernel_takes_has_a_twin(opencl):
    taken = {a.type for k in opencl.kernels.values() for a, _ in k.arguments}

    assert taken - set(SCALARS) == set(TWINS)


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
