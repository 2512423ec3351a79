"""The tree that kernels trace, built by host/tree/bvh.c itself."""
import ctypes
import pathlib
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ["tree/bvh.c", "tree/bvh_binary.c", "tree/bvh_wide.c", "mesh/corner_tree.c", "mesh/polygon.c",
           "base/interrupt.c", "base/status.c", "base/terminal_text.c"]


class Source(ctypes.Structure):
    _fields_ = [("facet_count", ctypes.c_uint32), ("vertex_count", ctypes.c_uint32)]
    _fields_ += [(name, ctypes.c_void_p) for name in ("corner", "position", "two_sided")]


class Tables(ctypes.Structure):
    _fields_ = [("node", ctypes.c_void_p), ("block", ctypes.c_void_p)]
    _fields_ += [(name, ctypes.c_uint32)
                 for name in ("node_count", "block_count", "triangle_count")]
    _fields_ += [("low", ctypes.c_float * 3), ("high", ctypes.c_float * 3)]


def _load():
    with tempfile.TemporaryDirectory() as folder:
        library = f"{folder}/bvh.so"
        sources = [str(ROOT / "host" / name) for name in SOURCES]
        flags = ["-std=c11", "-D_GNU_SOURCE", "-O2", "-shared", "-fPIC", f"-I{ROOT}", f"-I{ROOT / 'host'}"]
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
