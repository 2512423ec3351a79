"""All weather that installed packages bring along is read, or refused with the reason."""
import sys

import pytest
from built_program import ROOT

sys.path.insert(0, str(ROOT / "tests"))
import packaged_weather  # noqa: E402


def test_packaged_weather_is_read_or_refused_with_the_reason():
    where = packaged_weather.folders()
    if not packaged_weather.files(where):
        pytest.skip("no package with weather is installed (pvlib, accim ..)")
    rows = packaged_weather.table(where)

    assert [row for row in rows if row[2] not in ("read", "refused")] == []
    assert [row for row in rows if row[2] == "refused" and len(row[3]) < 10] == []
