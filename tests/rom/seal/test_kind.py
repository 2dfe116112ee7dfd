"""The sizes by which errors of a seal are divided."""

import pytest

from roughfilm.rom.seal.kind import KIND


def test_nothing_is_relative_to_less_than_what_counts_as_sealed():
    """A leakage or permeability below 10⁻⁹ of that of a smooth gap of the rms height, a gap below 10⁻³ of that."""
    values = {"leakage_per_width": 0.0, "smooth_leakage": 2e-3, "permeability": 1e-40, "mean_gap": 0.0}
    values |= {"rms_height": 1e-6, "area_fraction": 0.3}
    sizes = {"leakage_per_width": 2e-12, "permeability": 1e-27, "mean_gap": 1e-9, "area_fraction": 0.3}
    assert {name: float(KIND.scale(values, name)) for name in sizes} == pytest.approx(sizes)
