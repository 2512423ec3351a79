"""A mesh on a device, with the ray kernels to run over it."""
import numpy as np
import tree
from records import (BACKGROUND, BVH_BLOCK, BVH_NODE, CAMERA, FACET, HIT, MATERIAL, NONE,  # noqa: F401
                     WORLD)


class RayWorld:
    lanes = 16  # rays of a work-item

    def __init__(self, opencl, mesh, two_sided=None):
        self.opencl = opencl
        nodes, blocks, low, high = tree.build(*mesh, two_sided)
        self.facet_count = len(mesh[0])
        self.world = np.zeros(1, WORLD)
        self.world["ground_facet"] = NONE
        self.world["offset_m"] = 2.0**-20 * min(max(np.abs(low).max(), np.abs(high).max()), 4096)
        self.tree = {"world": self.world, "nodes": nodes.view(BVH_NODE), "blocks": blocks.view(BVH_BLOCK)}

    def run(self, name, shape, local=64, options="", **arguments):
        """Launches over (x, y) work-items, x padded to `local`."""
        size = (-(-shape[0] // local) * local, shape[1])
        self.opencl.run(name, size, (local, 1), f"-DRAY_LANES={self.lanes} {options}",
                        tree=self.tree, **arguments)

    def packets(self, count):
        """The launch of kernels with a packet of rays a work-item."""
        return (-(-count // self.lanes), 1)

    def batches(self, count):
        """The launch of kernels that sort their rays, kernels/rays/ray_order.h."""
        return (-(-count // (1024 if self.lanes == 16 else 1)), 1)

    def bundle(self):
        """Points of a work-item of hemisphere.cl and sun_history.cl."""
        return 64 if self.lanes == 16 else 1

    def trace(self, rays, **how):
        """rays: (n, 6). Returns range, facet."""
        rays = np.asarray(rays, np.float32)
        count, out = len(rays), (np.empty(len(rays), np.float32), np.empty(len(rays), np.uint32))
        self.run("trace", self.batches(count), count=count, stride=count, rays=rays.T,
                 out_range=out[0], out_facet=out[1], **how)
        return out

    def occluded(self, rays, **how):
        rays = np.asarray(rays, np.float32)
        count, out = len(rays), np.empty(len(rays), np.uint8)
        self.run("occluded", self.batches(count), count=count, stride=count, rays=rays.T,
                 out_met=out, **how)
        return out

    def primary(self, camera, columns, first, count, **how):
        side = 4 if self.lanes == 16 else 1
        rows = -(-(first + count) // columns) - first // columns
        out = np.empty(count, HIT)
        self.run("primary", (-(-columns // side), -(-rows // side)), count=count, first_pixel=first,
                 columns=columns, camera=camera, out_hit=out, **how)
        return out

    def sunlight(self, sun, hits, **how):
        out = np.empty(len(hits), np.float32)
        self.run("sunlight", self.packets(len(hits)), count=len(hits), sun_x=sun[0], sun_y=sun[1],
                 sun_z=sun[2], hit=hits, out_lit=out, **how)
        return out

    def hemisphere(self, cells, hits, material=None, temperature_k=None, number=None,
                   sun=(0, 0, 0), **how):
        """material, temperature_k: per facet, the ground's last; number: per material."""
        facets = np.zeros(self.facet_count + 1, FACET)
        facets["material"] = 0 if material is None else material
        temperature = np.zeros(len(facets), np.float32)
        temperature[:] = 300 if temperature_k is None else temperature_k
        materials = np.zeros(facets["material"].max() + 1, MATERIAL)
        materials["number"] = np.arange(len(materials)) if number is None else number
        met = self.cast(cells, hits, sun, **how)
        out = np.empty(len(hits), BACKGROUND)
        self.run("background", self.packets(len(hits)), count=len(hits), cell_count=len(cells),
                 surface={"facets": facets, "materials": materials, "facet_temperature_k": temperature},
                 hemisphere={"cell": cells, "hit": hits, "met": met}, out=out, **how)
        return out

    def cast(self, cells, hits, sun, **how):
        """The words of hemisphere.cl, shape (cell_count, count)."""
        met = np.empty((len(cells), len(hits)), np.uint32)
        shape = (-(-len(hits) // self.bundle()), -(-len(cells) // (72 if self.lanes == 16 else 1)))
        self.run("hemisphere", shape, count=len(hits), cell_count=len(cells), sun_x=sun[0],
                 sun_y=sun[1], sun_z=sun[2], cell=cells, hit=hits, out_met=met, **how)
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
