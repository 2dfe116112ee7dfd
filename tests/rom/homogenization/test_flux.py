"""The derivative of the permeability by the gap against closed forms of ridges."""

import numpy as np
import pytest

from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.flux import widening


def test_a_wider_gap_between_ridges_carries_more_as_in_closed_form():
    """Across ridges A = 1/<h⁻³>, so that ∂A = 3 <h⁻⁴>/<h⁻³>²; along them A = <h³>, so that ∂A = 3 <h²>."""
    gap = 1 + 0.4 * np.cos(2 * np.pi * np.arange(256) / 256)
    h = np.outer(gap, np.ones(8)) * 1e-6
    correctors = flow_factors(h, (1e-6, 1e-6)).correctors
    across = 3 * np.mean(gap**-4.0) / np.mean(gap**-3.0) ** 2 * 1e-12
    assert widening(h, (1e-6, 1e-6), correctors[0], 0) == pytest.approx(across, rel=1e-3)
    assert widening(h, (1e-6, 1e-6), correctors[1], 1) == pytest.approx(3 * np.mean(gap**2) * 1e-12, rel=1e-3)


def test_contact_does_not_widen():
    h = np.full((8, 8), 1e-6)
    h[:, 3] = 0
    corrector = flow_factors(h, (1e-6, 1e-6)).correctors[0]
    assert widening(h, (1e-6, 1e-6), corrector, 0) == pytest.approx(7 / 8 * 3e-12)
