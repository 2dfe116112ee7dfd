"""Films that are solved on half of their width: the same as over the whole width, also at the ends of the middle."""

from dataclasses import replace

import numpy as np
import pytest
from moving_films import drive, full

from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.grid import doubled, grid
from roughfilm.rom.cavitation.motion.coupled import settled
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape


@pytest.mark.parametrize("ends", [Ends(theta=0.6, sides=(0.0, 0.0)), Ends(inlet=2e5, outlet=1e5, sides=(0.0, 0.0))])
def test_half_of_a_pad_with_a_starved_or_pressurised_inlet_is_that_of_the_whole(ends):
    half = Shape(thickness=lambda x, y: 2e-5 - 1e-3 * x + 0 * y, breaks=(0.0, 0.01), across=(0.005, 0.01), wide=False)
    upper = grid(half, (10, 4))
    problem = Problem(shape=replace(half, across=(0.0, 0.01)), ends=ends, speed=1.0, viscosity=0.05)
    normals = (lambda x, y: 1 + 0 * x + 0 * y,)
    whole = MovingFilm(problem=problem, grid=doubled(upper), normals=normals)
    part = MovingFilm(problem=replace(problem, shape=half), grid=upper, normals=normals, halved=True)
    one, other = (settled(film, full(film, [0.0]), drive(film), tolerance=1e-12) for film in (whole, part))
    middle = other.state.pressure.shape[1] - 1
    assert one.state.pressure.max() > 1e4
    assert other.state.pressure == pytest.approx(one.state.pressure[:, middle:], rel=1e-9, abs=1e-3)
    np.testing.assert_allclose(other.state.fill, one.state.fill[:, middle:], atol=1e-9)
