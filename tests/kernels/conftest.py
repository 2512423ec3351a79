import collections
import probe
import pyopencl as cl
import pytest
from ray_world import RayWorld

OpenCL = collections.namedtuple("OpenCL", "context queue build")


@pytest.fixture(scope="session")
def context():
    devices = [d for p in cl.get_platforms() for d in p.get_devices()]
    cpus = [d for d in devices if d.type & cl.device_type.CPU]
    return cl.Context((cpus or devices)[:1])


@pytest.fixture(params=[16, 1])
def ray_lanes(request, monkeypatch):
    """Runs a test with packets of rays, as on CPUs, and with single rays, as on GPUs."""
    monkeypatch.setattr(RayWorld, "lanes", request.param)


@pytest.fixture(scope="session")
def opencl(context):
    """context, queue and build(name): the kernel of kernels/.../NAME.cl."""
    built = {}

    def build(name, options=""):
        if (name, options) not in built:
            source = (probe.ROOT / probe.find(f"{name}.cl")).read_text()
            program = cl.Program(context, source).build(f"-cl-std=CL1.2 -I {probe.ROOT} {options}")
            built[name, options] = getattr(program, name)
        return built[name, options]

    return OpenCL(context, cl.CommandQueue(context), build)
