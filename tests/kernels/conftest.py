import collections
import pathlib

import pyopencl as cl
import pytest

KERNELS = pathlib.Path(__file__).resolve().parents[2] / "kernels"

OpenCL = collections.namedtuple("OpenCL", "context queue build")


@pytest.fixture(scope="session")
def context():
    devices = [d for p in cl.get_platforms() for d in p.get_devices()]
    cpus = [d for d in devices if d.type & cl.device_type.CPU]
    return cl.Context((cpus or devices)[:1])


@pytest.fixture(scope="session")
def opencl(context):
    """context, queue and build(name): the kernel of kernels/NAME.cl."""
    built = {}

    def build(name, options=""):
        if (name, options) not in built:
            source = (KERNELS / f"{name}.cl").read_text()
            program = cl.Program(context, source).build(f"-cl-std=CL1.2 -I {KERNELS} {options}")
            built[name, options] = getattr(program, name)
        return built[name, options]

    return OpenCL(context, cl.CommandQueue(context), build)
