"""Every mesh and sounding that installed packages bring along is read, or refused with the reason."""
import sys

import pytest
from built_program import ROOT

sys.path.insert(0, str(ROOT / "tests"))
import packaged_files  # noqa: E402


def test_packaged_files_are_read_or_refused_with_the_reason():
    where = packaged_files.folders()
    if not packaged_files.files(where):
        pytest.skip("no package with meshes or soundings is installed (assimp-testmodels, trimesh, metpy ..)")
    rows = packaged_files.table(where)

    assert [row for row in rows if row[2] not in ("read", "refused")] == []
    assert [row for row in rows if row[2] == "refused" and len(row[3]) < 10] == []
