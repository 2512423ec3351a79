"""Kernels by name, launched by the names of their signatures (kernels/launches.py)."""
import sys

import numpy as np
import pyopencl as cl
from probe import ROOT, find
from records import TWINS

sys.path.append(str(ROOT / "kernels"))
import launches  # noqa: E402

SCALARS = {"uint": np.dtype("u4"), "int": np.dtype("i4"), "float": np.dtype("f4"), "uchar": np.dtype("u1")}


def dtype_of(type_):
    return SCALARS.get(type_) or TWINS[type_]


class OpenCL:
    """context, queue, and kernels that are built once."""

    def __init__(self, context):
        self.context, self.queue = context, cl.CommandQueue(context)
        self.kernels = {k.name: k for k in launches.read()}
        self.built = {}

    def build(self, name, options=""):
        """The kernel of kernels/.../NAME.cl."""
        if (name, options) not in self.built:
            source = (ROOT / find(f"{name}.cl")).read_text()
            program = cl.Program(self.context, source).build(f"-cl-std=CL1.2 -I {ROOT} {options}")
            self.built[name, options] = getattr(program, name)
        return self.built[name, options]

    def run(self, name, size, local=None, options="", **given):
        """Launches a kernel. A buffer is given as an array, and one that the kernel writes holds
        afterwards what it wrote; a group is given as a dict."""
        arguments, written = self.bind(name, given)
        self.build(name, options)(self.queue, size, local, *arguments)
        for array, memory in written:
            cl.enqueue_copy(self.queue, array, memory)

    def bind(self, name, given):
        """OpenCL's arguments, and the arrays that a launch writes with their memory."""
        given = flat(given)
        arguments, written = [], []
        for argument, names in self.kernels[name].arguments:
            place = f"kernel {name}: {'.'.join(names)}"
            value = given.pop(tuple(names), None)
            if value is None and not argument.is_optional:
                raise TypeError(f"{place} is missing")
            own = value if value is None else self.bind_one(argument, value, place)
            arguments.append(own)
            if argument.is_buffer and not argument.is_input:
                written.append((value, own))
        if given:
            raise TypeError(f"kernel {name}: there is no {'.'.join(next(iter(given)))}")
        return arguments, written

    def bind_one(self, argument, value, place):
        expected = dtype_of(argument.type)
        if not argument.is_buffer and argument.type in SCALARS:
            return expected.type(value)
        found = getattr(value, "dtype", type(value))
        if found != expected:
            raise TypeError(f"{place} is {found}, expected {argument.type}: {expected}")
        if not argument.is_buffer:
            return np.asarray(value).reshape(())[()]
        if not argument.is_input and not value.flags.c_contiguous:
            raise TypeError(f"{place} is written and not contiguous")
        array = np.ascontiguousarray(value)
        flags = cl.mem_flags.READ_WRITE
        if array.nbytes == 0:
            return cl.Buffer(self.context, flags, 64)
        return cl.Buffer(self.context, flags | cl.mem_flags.COPY_HOST_PTR, hostbuf=array)


def flat(given):
    """Values by the names that lead to them."""
    out = {}
    for name, value in given.items():
        if isinstance(value, dict):
            out.update({(name, inner): own for inner, own in value.items()})
        else:
            out[name,] = value
    return out
