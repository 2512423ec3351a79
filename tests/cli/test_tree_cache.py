"""The cache of trees: which trees a program takes for its own follows from the sources that build them."""
import hashlib
import os
import struct

from built_program import ROOT

SIDE = 225  # 50,625 facets; from 50,000 on trees are kept


def write_terrain(path):
    points = [f"v {x} {y} {(x * y) % 7 * 0.1:.1f}" for y in range(SIDE + 1) for x in range(SIDE + 1)]
    row = SIDE + 1
    corners = [(y * row + x + 1, y * row + x + 2, (y + 1) * row + x + 2, (y + 1) * row + x + 1)
               for y in range(SIDE) for x in range(SIDE)]
    path.write_text("\n".join([*points, *("f %d %d %d %d" % c for c in corners)]) + "\n")


def test_the_layout_of_a_kept_tree_is_the_hash_of_the_sources_that_build_trees(program, tmp_path):
    mesh = tmp_path / "terrain.obj"
    write_terrain(mesh)
    stems = ("bvh", "bvh_binary", "bvh_cache", "bvh_wide", "polygon")
    sources = [*(ROOT / "kernels").rglob("records.h"),
               *(p for p in (ROOT / "host").rglob("*.[ch]") if p.stem in stems)]
    names = sorted(str(p.relative_to(ROOT)) for p in sources)
    text = b"".join((ROOT / n).read_bytes() for n in names)

    done = program.run("trace", mesh, input="10 10 5 0 0 -1\n",
                       env={**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")})

    assert done.returncode == 0, done.stderr
    kept, = (tmp_path / "cache" / "radsig").glob("*.tree")
    layout, = struct.unpack("<Q", kept.read_bytes()[8:16])
    assert len(names) == 11 and f"{layout:016x}" == hashlib.sha256(text).hexdigest()[:16]
