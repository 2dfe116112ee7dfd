"""Viscosities that vary over a film, against films of one viscosity and the closed form of a single line."""

from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.evaluation.flows import flow_along
from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.cavitation.fluid import Viscosities, ViscosityField
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve

VISCOSITY, SPEED, LENGTH, FILM = 0.05, 3.0, 0.1, 4e-5


def wedge(viscosities: ViscosityField | None = None, *, viscosity: float = VISCOSITY, wide: bool = True) -> Problem:
    shape = Shape(
        thickness=lambda x, y: FILM * (2 - x / LENGTH) + 0 * y, breaks=(0.0, LENGTH), across=(0.0, 0.08), wide=wide
    )
    ends = Ends(inlet=0.0, sides=None if wide else (0.0, 0.0))
    return Problem(shape=shape, ends=ends, speed=SPEED, viscosity=viscosity, viscosities=viscosities)


def uniform(flow: float, shear: float, carried: float) -> ViscosityField:
    def field(x: Array, y: Array) -> Viscosities:
        one = np.ones(np.broadcast(x, y).shape)
        return Viscosities(flow=flow * one, shear=shear * one, carried=carried * one)

    return field


@pytest.mark.parametrize("wide", [True, False])
def test_a_uniform_field_equals_its_viscosity(wide: bool) -> None:
    given = solve(wedge(uniform(0.02, 0.02, 1.0), wide=wide), (32, 16))
    plain = solve(wedge(viscosity=0.02, wide=wide), (32, 16))
    np.testing.assert_allclose(given.state.pressure, plain.state.pressure, rtol=1e-9, atol=1e-6)
    assert friction(given) == pytest.approx(friction(plain), rel=1e-9)


def test_viscosities_across_the_film_scale_flow_and_stress() -> None:
    """With s and η_p uniform the pressure is that at s η_p; the stress is η_s u/h + s h/2 ∂p/∂x."""
    given, plain = solve(wedge(uniform(0.03, 0.02, 0.8)), (128, 1)), solve(wedge(viscosity=0.8 * 0.03), (128, 1))
    np.testing.assert_allclose(given.state.pressure, plain.state.pressure, rtol=1e-9, atol=1e-6)
    sheared = SPEED * LENGTH / FILM * np.log(2)
    by_pressure = friction(plain) - 0.8 * 0.03 * sheared
    assert friction(given) == pytest.approx(0.02 * sheared + 0.8 * by_pressure, rel=1e-4)


def field(x: Array, y: Array) -> Viscosities:
    varied = VISCOSITY * np.exp(-1.5 * x / LENGTH) + 0 * y
    return Viscosities(flow=varied, shear=varied, carried=np.ones_like(varied))


def test_pressure_of_a_line_is_second_order() -> None:
    """∂p/∂x = 12 η(x) (u h/2 - q)/h³ with the flow q for which both ends are at ambient pressure."""
    x = np.linspace(0, LENGTH, 20001)
    middle, step = (x[1:] + x[:-1]) / 2, x[1] - x[0]
    h, eta = FILM * (2 - middle / LENGTH), VISCOSITY * np.exp(-1.5 * middle / LENGTH)
    by_sliding, by_flow = 6 * eta * SPEED / h**2, 12 * eta / h**3
    q = by_sliding.sum() / by_flow.sum()
    pressure = np.concatenate([[0.0], np.cumsum(by_sliding - q * by_flow) * step])
    errors = []
    for cells in (32, 64, 128):
        found = solve(wedge(field), (cells, 1))
        exact = np.interp(found.grid.x, x, pressure)
        errors.append(float(np.abs(found.state.pressure[:, 0] - exact).max() / pressure.max()))
        assert flow_along(found)[0, 0] == pytest.approx(q, rel=10 / cells**2)
    assert errors[-1] < 2e-4
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(2, abs=0.2)


def test_sliding_the_other_way_mirrors_the_field() -> None:
    here = solve(wedge(field), (48, 1))
    other = wedge(lambda x, y: field(LENGTH - x, y))
    shape = replace(other.shape, thickness=lambda x, y: FILM * (1 + x / LENGTH) + 0 * y)
    back = solve(replace(other, shape=shape, speed=-SPEED), (48, 1))
    np.testing.assert_allclose(back.state.pressure, here.state.pressure, rtol=1e-9, atol=1e-3)
