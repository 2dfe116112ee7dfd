"""The cross flow of a lay that walls which move freely leave out."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.free.lay import StraightFactors, lay_error, straight
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.homogenization.gap_factors import GapFactors


@dataclass(frozen=True)
class Crossed:
    """Smooth flow with the cross flow ``part`` of that along the film."""

    part: float

    def __call__(self, h):
        return GapFactors(
            along=h**3,
            across=h**3,
            cross=self.part * h**3,
            drag=h,
            drag_across=self.part * h,
            couette=1 / h,
            shear_couette=0 * h,
            streaming=1 / h,
            least=h,
        )


def problem(factors):
    shape = Shape(
        thickness=lambda x, y: 2e-6 - 1e-4 * x + 0 * y,
        breaks=(0.0, 0.01),
        across=(0.0, 0.01),
        wide=False,
        roughness=factors,
    )
    return Problem(shape=shape, ends=Ends(sides=(0.0, 0.0)), speed=1.0, viscosity=0.1)


def load(solution):
    return float((solution.grid.areas * solution.state.pressure).sum())


def test_the_load_of_a_symmetric_film_changes_by_the_square_of_the_cross_flow():
    left_out = straight(problem(Crossed(0.1)), 0.3e-6)
    plain = solve(left_out, (24, 24))
    forth, back = (load(solve(problem(Crossed(part)), (24, 24), tolerance=1e-8)) for part in (0.1, -0.1))
    assert forth == pytest.approx(back, rel=1e-6)
    bound = lay_error(plain, even=True)
    assert bound == pytest.approx(0.01, rel=1e-9)
    assert 1e-4 < abs(forth / load(plain) - 1) < bound
    assert lay_error(plain, even=False) == pytest.approx(0.1, rel=1e-9)


def test_other_factors_are_kept_and_an_oblique_lay_is_refused():
    h = np.array([1e-6, 3e-6])
    own, kept = Crossed(0.05)(h), StraightFactors(Crossed(0.05))(h)
    assert not kept.cross.any()
    assert not kept.drag_across.any()
    assert all(
        np.array_equal(getattr(kept, name), getattr(replace(own), name))
        for name in ("along", "across", "drag", "least")
    )
    with pytest.raises(InputError, match=r"cross flow is 0\.2 times .* along or across the sliding"):
        straight(problem(Crossed(0.2)), 0.3e-6)
