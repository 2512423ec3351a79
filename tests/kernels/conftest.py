import pyopencl as cl
import pytest
from opencl import OpenCL
from ray_world import RayWorld


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
    return OpenCL(context)
