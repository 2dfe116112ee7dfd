"""The polynomials across the film: orthogonality and integrals."""

import numpy as np
import pytest

from roughfilm.rom.thin_film.basis import STIFFNESS, gauss_basis


def test_polynomials_are_orthogonal_in_slope_and_carry_no_flow_but_the_first():
    across = gauss_basis(7)
    assert (across.slope * across.weights) @ across.slope.T == pytest.approx(STIFFNESS * np.eye(7), abs=1e-12)
    assert across.shape @ across.weights == pytest.approx([across.flow, *np.zeros(6)], abs=1e-14)
    assert across.nodes**3 @ across.above == pytest.approx((1 - across.nodes**4) / 4)
