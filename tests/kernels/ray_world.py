"""A mesh on a device, with the ray kernels to run over it."""
import numpy as np
import pyopencl as cl
import tree

NONE = 0xFFFFFFFF
HIT = np.dtype([("point", "f4", 3), ("range_m", "f4"), ("facet", "u4"), ("normal", "f4", 3)])
WORLD = np.dtype([("ground_facet", "u4"), ("ground_z_m", "f4"), ("offset_m", "f4"),
                  ("cull_back", "u4")])
BACKGROUND = np.dtype([("shape_factor", "f4"), ("mean_temperature_k", "f4"), ("material", "u4"),
                       ("facet", "u4"), ("point", "f4", 3), ("normal", "f4", 3),
                       ("met_count", "u4"), ("unused", "u4")])
CAMERA = np.dtype([(name, "f4", 3) for name in ("position", "corner", "across", "down")]
                  + [(name, "u4") for name in ("first_column", "first_row", "is_orthographic",
                                               "samples_per_side", "seed")] + [("unused", "u4", 3)])
FACET = np.dtype([("normal", "f4", 3), ("material", "u4"), ("rest", "u4", 8)])
MATERIAL = np.dtype([("before", "f4", 9), ("number", "u4"), ("unused", "u4", 2)])


class RayWorld:
    lanes = 16  # rays of a work-item

    def __init__(self, opencl, mesh, two_sided=None):
        self.opencl = opencl
        nodes, blocks, low, high = tree.build(*mesh, two_sided)
        self.facet_count = len(mesh[0])
        self.nodes, self.blocks = self.copy(nodes), self.copy(blocks)
        self.world = np.zeros(1, WORLD)
        self.world["ground_facet"] = NONE
        self.world["offset_m"] = 2.0**-20 * max(np.abs(low).max(), np.abs(high).max())

    def copy(self, array):
        flags = cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR
        return cl.Buffer(self.opencl.context, flags, hostbuf=np.ascontiguousarray(array))

    def run(self, name, count, arguments, *outputs, shape=None, local=64, options=""):
        """Launches over `shape`, or `count` rays, with a size padded to `local`; returns the
        outputs."""
        arrays = [np.empty(count, dtype) for dtype in outputs]
        memory = [cl.Buffer(self.opencl.context, cl.mem_flags.WRITE_ONLY, a.nbytes) for a in arrays]
        width, height = shape or (-(-count // self.lanes), 1)
        size = (-(-width // local) * local, height)
        kernel = self.opencl.build(name, f"-DRAY_LANES={self.lanes} {options}")
        kernel(self.opencl.queue, size, (local, 1), np.uint32(count), *arguments, *memory)
        for array, buffer in zip(arrays, memory):
            cl.enqueue_copy(self.opencl.queue, array, buffer)
        return arrays

    def batches(self, count):
        """The launch of kernels that sort their rays, kernels/rays/ray_order.h."""
        return (-(-count // (1024 if self.lanes == 16 else 1)), 1)

    def bundle(self):
        """Points of a work-item of hemisphere.cl and sun_history.cl."""
        return 64 if self.lanes == 16 else 1

    def trace(self, rays, **how):
        """rays: (n, 6). Returns range, facet."""
        rays = np.asarray(rays, np.float32)
        arguments = (np.uint32(len(rays)), self.world[0], self.nodes, self.blocks,
                     self.copy(rays.T))
        shape = self.batches(len(rays))
        return self.run("trace", len(rays), arguments, np.float32, np.uint32, shape=shape, **how)

    def occluded(self, rays, **how):
        rays = np.asarray(rays, np.float32)
        arguments = (np.uint32(len(rays)), self.world[0], self.nodes, self.blocks,
                     self.copy(rays.T))
        shape = self.batches(len(rays))
        return self.run("occluded", len(rays), arguments, np.uint8, shape=shape, **how)[0]

    def primary(self, camera, columns, first, count, **how):
        arguments = (np.uint32(first), np.uint32(columns), camera[0], self.world[0], self.nodes,
                     self.blocks)
        side = 4 if self.lanes == 16 else 1
        rows = -(-(first + count) // columns) - first // columns
        shape = (-(-columns // side), -(-rows // side))
        return self.run("primary", count, arguments, HIT, shape=shape, **how)[0]

    def sunlight(self, sun, hits, **how):
        arguments = (*np.float32(sun), self.world[0], self.nodes, self.blocks, self.copy(hits))
        return self.run("sunlight", len(hits), arguments, np.float32, **how)[0]

    def hemisphere(self, cells, hits, material=None, temperature_k=None, number=None,
                   sun=(0, 0, 0), **how):
        """material, temperature_k: per facet, the ground's last; number: per material."""
        cell_count, count = len(cells), len(hits)
        facets = np.zeros(self.facet_count + 1, FACET)
        facets["material"] = 0 if material is None else material
        temperature = np.zeros(len(facets), np.float32)
        temperature[:] = 300 if temperature_k is None else temperature_k
        materials = np.zeros(facets["material"].max() + 1, MATERIAL)
        materials["number"] = np.arange(len(materials)) if number is None else number
        cells, facets, temperature, materials, hits = (
            self.copy(a) for a in (cells, facets, temperature, materials, hits))
        met = self.cast(cell_count, cells, count, hits, sun, **how)
        rays = (np.uint32(cell_count), self.world[0], self.nodes, self.blocks)
        arguments = (*rays, cells, facets, temperature, materials, hits, self.copy(met), None)
        shape = (-(-count // self.lanes), 1)
        return self.run("background", count, arguments, BACKGROUND, shape=shape, **how)[0]

    def cast(self, cell_count, cells, count, hits, sun, local=64, options=""):
        """The words of hemisphere.cl, shape (cell_count, count)."""
        met = np.empty((cell_count, count), np.uint32)
        memory = cl.Buffer(self.opencl.context, cl.mem_flags.WRITE_ONLY, met.nbytes)
        width = -(-count // self.bundle())
        size = (-(-width // local) * local, -(-cell_count // (72 if self.lanes == 16 else 1)))
        kernel = self.opencl.build("hemisphere", f"-DRAY_LANES={self.lanes} {options}")
        kernel(self.opencl.queue, size, (local, 1), np.uint32(count), np.uint32(cell_count),
               *np.float32(sun), self.world[0], self.nodes, self.blocks, cells, hits, memory)
        cl.enqueue_copy(self.opencl.queue, met, memory)
        return met


def points(position, normal):
    """Hit records of facet 0 at positions (n, 3) with normals (n, 3) or one for all."""
    position = np.atleast_2d(position)
    hits = np.zeros(len(position), HIT)
    hits["point"] = position
    hits["normal"] = normal
    return hits


def grid(zenith_step_deg, azimuth_step_deg, weight):
    """Cells (n, 4) as host/hemisphere/shape_factor.h describes them; weight: a function of the elevation."""
    elevation = np.radians(np.arange(zenith_step_deg / 2, 90, zenith_step_deg))
    azimuth = np.radians(np.arange(azimuth_step_deg / 2, 360, azimuth_step_deg))
    e, a = (x.ravel() for x in np.meshgrid(elevation, azimuth, indexing="ij"))
    w = weight(e)
    cells = np.stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e), w / w.sum()], 1)
    return cells.astype(np.float32)
