"""Temperatures of the airport at ten in the morning: part of its runway and of what stands there."""
import numpy as np
import pytest

SLABS, TAR = 22, 28  # concrete/roadway and the gaps in it, by their codes


@pytest.fixture(scope="module")
def planes(program, airport, tmp_path_factory):
    out = tmp_path_factory.mktemp("airport")
    done = program.run("render", airport, "-o", out, "--set", "camera.crop=[180,180,160,160]")
    assert done.returncode == 0, done.stderr
    return program.load(out, "airport").planes


def test_tar_gaps_run_hotter_than_slabs_in_the_morning(planes):
    """Dark and thin against light and thick; thesis, Figures 3-15 and 3-17."""
    lit = planes["sunlit"] == 1
    tar, slabs = (planes["temperature_c"][lit & (planes["material"] == m)] for m in (TAR, SLABS))

    assert len(tar) > 100 and len(slabs) > 1000
    assert np.percentile(tar, 10) > np.percentile(slabs, 90) + 5


def test_slabs_in_shade_are_never_warmer_than_the_same_slabs_lit(planes):
    """All of them are level and of one thickness: their sun alone differs."""
    slabs = planes["material"] == SLABS
    shade, lit = (planes["temperature_c"][slabs & (planes["sunlit"] == s)] for s in (0, 1))

    assert len(shade) > 50
    assert shade.max() <= lit.max() + 1e-3  # float32


def test_thermal_shadows_persist_after_the_sun_has_moved(planes):
    """Slabs in the sun again for half an hour or less against those that never left it."""
    lit = (planes["material"] == SLABS) & (planes["sunlit"] == 1)
    recent = lit & (planes["minutes_since_sun_change"] <= 30)
    always = lit & (planes["hours_lit_24h"] == planes["hours_lit_24h"][lit].max())

    assert recent.sum() > 10
    assert planes["temperature_c"][recent].mean() < planes["temperature_c"][always].min() - 1
