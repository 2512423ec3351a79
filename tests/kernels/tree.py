"""The tree that kernels trace, built by host/tree/bvh.c itself."""
import ctypes
import pathlib
import re
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOST = ROOT / "host"


class Source(ctypes.Structure):
    _fields_ = [("facet_count", ctypes.c_uint32), ("vertex_count", ctypes.c_uint32)]
    _fields_ += [(name, ctypes.c_void_p) for name in ("corner", "position", "two_sided")]


class Tables(ctypes.Structure):
    _fields_ = [("node", ctypes.c_void_p), ("block", ctypes.c_void_p)]
    _fields_ += [(name, ctypes.c_uint32)
                 for name in ("node_count", "block_count", "triangle_count")]
    _fields_ += [("low", ctypes.c_float * 3), ("high", ctypes.c_float * 3)]


def _sources(path, found):
    """A file of C, and those that have what its headers declare."""
    if path.is_file() and path not in found:
        found.add(path)
        for file in (path, path.with_suffix(".h")):
            for name in re.findall(r'#include "([^"]+)\.h"', file.read_text()):
                _sources(HOST / f"{name}.c", found)
    return found


def _load():
    with tempfile.TemporaryDirectory() as folder:
        library = f"{folder}/bvh.so"
        sources = map(str, _sources(HOST / "tree/bvh.c", set()))
        flags = ["-std=c11", "-D_GNU_SOURCE", "-O2", "-shared", "-fPIC", f"-I{ROOT}", f"-I{HOST}"]
        subprocess.run(["cc", *flags, "-o", library, *sources, "-lm"], check=True)
        bvh = ctypes.CDLL(library)
    bvh.bvh_look.restype = ctypes.POINTER(Tables)
    return bvh


_bvh = _load()


def build(corner, position, two_sided=None):
    """Returns node bytes, block bytes, low and high."""
    corner = np.ascontiguousarray(corner, np.uint32)
    position = np.ascontiguousarray(position, np.float32)
    tree = ctypes.c_void_p()
    sides = None if two_sided is None else np.ascontiguousarray(two_sided, np.uint8)
    source = Source(len(corner), len(position), corner.ctypes.data, position.ctypes.data,
                    None if sides is None else sides.ctypes.data)
    code = _bvh.bvh_build(ctypes.byref(tree), ctypes.byref(source))
    assert code == 0
    tables = _bvh.bvh_look(tree).contents
    nodes = np.frombuffer(ctypes.string_at(tables.node, 256 * tables.node_count), np.uint8)
    blocks = np.frombuffer(ctypes.string_at(tables.block, 320 * tables.block_count), np.uint8)
    low, high = np.array(tables.low), np.array(tables.high)
    _bvh.bvh_free(tree)
    return nodes, blocks, low, high
