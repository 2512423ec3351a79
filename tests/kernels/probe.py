"""Runs a few lines of OpenCL C over arrays, to reach functions of kernels/*.h that no kernel is."""
import pathlib

import numpy as np
import pyopencl as cl

ROOT = pathlib.Path(__file__).resolve().parents[2]


def find(name):
    """Path below ROOT of a file of kernels/."""
    return next((ROOT / "kernels").rglob(name)).relative_to(ROOT)


def copy(opencl, array):
    """A buffer with the bytes of an array."""
    return cl.Buffer(opencl.context, cl.mem_flags.COPY_HOST_PTR,
                     hostbuf=np.ascontiguousarray(array))


def room(opencl, size):
    """A buffer of so many bytes."""
    return cl.Buffer(opencl.context, cl.mem_flags.READ_WRITE, int(size))


def read(opencl, memory, shape, dtype=np.float32):
    """What a buffer holds."""
    out = np.empty(shape, dtype)
    cl.enqueue_copy(opencl.queue, out, memory)
    return out


def launch(opencl, kernel, count, arguments, shape, dtype=np.float32):
    """Runs a kernel over `count` (a number or a shape); its last argument is an array of `shape`,
    which is returned."""
    memory = room(opencl, np.prod(shape) * np.dtype(dtype).itemsize)
    kernel(opencl.queue, count if isinstance(count, tuple) else (count,), None, *arguments, memory)
    return read(opencl, memory, shape, dtype)


def probe(opencl, header, body, inputs, outputs=1, options=""):
    """Runs `body` for every i: float arrays in0[i], in1[i] ... in, out[0..outputs) out.
    Returns shape (outputs, n)."""
    arrays = [np.ascontiguousarray(a, np.float32) for a in inputs]
    parameters = "".join(f"global const float *in{k}, " for k in range(len(arrays)))
    source = (f'#include "{find(header)}"\n'
              f"kernel void probe({parameters}global float *all)\n"
              f"{{ const uint i = get_global_id(0); float out[{outputs}];\n{body}\n"
              f"for (int k = 0; k < {outputs}; k++) all[k * get_global_size(0) + i] = out[k]; }}\n")
    program = cl.Program(opencl.context, source).build(f"-cl-std=CL1.2 -I {ROOT} {options}")
    count = len(arrays[0])
    return launch(opencl, program.probe, count, [copy(opencl, a) for a in arrays],
                  (outputs, count))
