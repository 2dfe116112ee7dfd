"""Viscosities across a straight gap against closed forms, and against profiles that are integrated here."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.lubricants.shear_thinning import CarreauYasuda, ReeEyring, ThinningLaw
from roughfilm.rom.shear_thinning.closed_forms import eyring_flow, power_law_flow
from roughfilm.rom.shear_thinning.straight_gap import thinned_across, thinned_by_flow, thinned_by_gradient

VISCOSITY, FILM, EYRING_STRESS = 0.05, 2e-6, 2e6
EYRING = ReeEyring.model_validate({"law": "ree_eyring", "critical_stress": "2 MPa"})
CARREAU = CarreauYasuda.model_validate(
    {"law": "carreau_yasuda", "index": 0.5, "critical_stress": "10 kPa", "exponent": 1.5}
)


def by_gradient(law: ThinningLaw, speed: float, along: Array | float, across: Array | float = 0.0) -> Viscosities:
    along, across = np.broadcast_arrays(np.atleast_1d(along), across)
    one = np.ones(along.shape)
    return thinned_by_gradient(law.curve(VISCOSITY), VISCOSITY * one, FILM * one, speed, (along, across))


def flow(found: Viscosities, speed: float, gradient: Array | float) -> Array:
    return np.asarray(found.carried * speed * FILM / 2 - FILM**3 / (12 * found.flow) * gradient)


def wall_stress(found: Viscosities, speed: float, gradient: Array | float) -> Array:
    return np.asarray(found.shear * speed / FILM + found.carried * FILM / 2 * gradient)


@pytest.mark.parametrize("law", [EYRING, CARREAU], ids=["Ree-Eyring", "Carreau-Yasuda"])
@pytest.mark.parametrize("speed", [0.01, 1.0, 300.0, -20.0])
def test_plane_couette_flow_has_the_viscosity_of_its_shear_rate(law: ThinningLaw, speed: float) -> None:
    found = by_gradient(law, speed, 0.0)
    expected = law.viscosity_at(np.array([abs(speed) / FILM]), VISCOSITY)
    np.testing.assert_allclose(found.shear, expected, rtol=1e-9)
    np.testing.assert_allclose(found.flow, expected, rtol=1e-9)
    np.testing.assert_allclose(found.carried, 1, rtol=1e-12)


@pytest.mark.parametrize("speed", [0.0, 5.0, 200.0])
def test_a_ree_eyring_film_has_the_flow_and_the_stress_of_the_closed_form(speed: float) -> None:
    gradient = np.array([-6e12, -1e12, 1e10, 2e11, 4e12])
    found = by_gradient(EYRING, speed, gradient)
    q, stress = eyring_flow(VISCOSITY, EYRING_STRESS, FILM, speed, gradient)
    np.testing.assert_allclose(flow(found, speed, gradient), q, rtol=1e-8, atol=1e-9 * np.abs(q).max())
    np.testing.assert_allclose(wall_stress(found, speed, gradient), stress, rtol=1e-8, atol=1e-8 * stress.max())


@pytest.mark.parametrize("index", [0.3, 0.7])
def test_far_above_the_critical_rate_a_carreau_film_has_the_flow_of_a_power_law(index: float) -> None:
    law = CarreauYasuda.model_validate({"law": "carreau_yasuda", "index": index, "critical_stress": "1 Pa"})
    gradient = np.array([1e10, -1e11])
    consistency = VISCOSITY * (VISCOSITY / 1.0) ** (index - 1)
    expected = power_law_flow(consistency, index, FILM, gradient)
    np.testing.assert_allclose(flow(by_gradient(law, 0.0, gradient), 0.0, gradient), expected, rtol=1e-5)


def profile(law: ThinningLaw, speed: float, along: float, across: float) -> tuple[float, float, float]:
    """The flows and the stress on the sliding wall of the equations of motion, (η v')' = ∇p, as a boundary problem.

    The velocity is scaled by the sliding speed, and the viscosity found from the stress by bisection.
    """
    unit = VISCOSITY * speed / FILM
    gradient = np.array([along, across]) * FILM / unit

    def rate(stress: Array) -> Array:
        low, high = np.zeros_like(stress), np.full_like(stress, 1e12)
        for _ in range(200):
            middle = (low + high) / 2
            less = law.viscosity_at(middle, VISCOSITY) * middle < stress
            low, high = np.where(less, middle, low), np.where(less, high, middle)
        return (low + high) / 2

    def motion(z: Array, y: Array) -> Array:
        stress = np.hypot(y[2], y[3])
        over = np.divide(rate(unit * stress), stress, out=np.zeros_like(stress), where=stress > 0) * FILM / speed
        return np.stack([y[2] * over, y[3] * over, gradient[0] + 0 * z, gradient[1] + 0 * z, y[0], y[1]])

    def walls(at: Array, end: Array) -> Array:
        return np.array([at[0] - 1, at[1], end[0], end[1], at[4], at[5]])

    z = np.linspace(0, 1, 41)
    start = np.stack([1 - z, 0 * z, -0.3 + 0 * z, 0.01 + 0 * z, z, 0 * z])
    found = solve_bvp(motion, walls, z, start, tol=1e-8, max_nodes=20000)
    assert found.success
    return (
        float(found.sol(1.0)[4]) * speed * FILM,
        float(found.sol(1.0)[5]) * speed * FILM,
        float(found.sol(0.0)[2]) * unit,
    )


@pytest.mark.parametrize("law", [EYRING, CARREAU], ids=["Ree-Eyring", "Carreau-Yasuda"])
def test_flows_along_and_across_are_those_of_the_equations_of_motion(law: ThinningLaw) -> None:
    speed, along, across = 20.0, 4e10, 7e10
    found = by_gradient(law, speed, along, across)
    q_x, q_y, stress = profile(law, speed, along, across)
    assert flow(found, speed, along)[0] == pytest.approx(q_x, rel=1e-6)
    assert -(FILM**3) / (12 * found.flow[0]) * across == pytest.approx(q_y, rel=1e-6)
    assert wall_stress(found, speed, along)[0] == pytest.approx(-stress, rel=1e-6)


def test_the_gradient_of_a_flow_leads_back_to_it() -> None:
    random = np.random.default_rng(0)
    speed, along, across = 10.0, 1e11 * random.normal(size=(9, 7)), 3e10 * random.normal(size=(9, 7))
    for law in (EYRING, CARREAU):
        found = by_gradient(law, speed, along, across)
        driven = flow(found, speed, along) - speed * FILM / 2, -(FILM**3) / (12 * found.flow) * across
        one = np.ones(along.shape)
        back = thinned_by_flow(law.curve(VISCOSITY), VISCOSITY * one, FILM * one, speed, driven).viscosities
        for name in ("flow", "shear", "carried"):
            np.testing.assert_allclose(getattr(back, name), getattr(found, name), rtol=1e-7)


def test_a_newtonian_film_keeps_its_viscosity_to_the_last_bit() -> None:
    law = CarreauYasuda.model_validate({"law": "carreau_yasuda", "index": 1, "critical_stress": "1 Pa"})
    found = by_gradient(law, 7.0, np.array([-1e10, 0.0, 3e11]), 2e10)
    assert (found.flow == VISCOSITY).all()
    assert (found.shear == VISCOSITY).all()
    assert (found.carried == 1).all()


def test_a_film_at_rest_without_pressure_keeps_its_viscosity() -> None:
    found = by_gradient(CARREAU, 0.0, 0.0)
    assert (found.flow[0], found.shear[0], found.carried[0]) == (VISCOSITY, VISCOSITY, 1.0)


def test_a_viscosity_that_varies_across_is_sheared_by_one_stress() -> None:
    """Without pressure the stress is uniform, and the shear rates at it give the speed of the wall and the flow."""
    points, weights = np.polynomial.legendre.leggauss(12)
    points, weights = (1 + points) / 2, weights / 2
    at_rest, stress = VISCOSITY * np.exp(-2 * points), 1.5 * EYRING_STRESS
    rate = EYRING_STRESS / at_rest * np.sinh(1.5)
    speed, q = FILM * float(weights @ rate), FILM**2 * float(weights @ (points * rate))
    driven = np.array([q - speed * FILM / 2]), np.zeros(1)
    film = np.full(1, FILM)
    found, relative = thinned_across(EYRING.curve(VISCOSITY), at_rest[None], (points, weights), film, speed, driven)
    np.testing.assert_allclose(found[0], stress / rate, rtol=1e-8)
    np.testing.assert_allclose(relative[0], [-1.5, 0, 0, 0], atol=1e-8)
    again, _ = thinned_across(
        EYRING.curve(VISCOSITY), at_rest[None], (points, weights), film, speed, driven, start=1.1 * relative
    )
    np.testing.assert_allclose(again, found, rtol=1e-8)


def test_a_uniform_viscosity_across_is_that_of_the_film() -> None:
    points, weights = np.polynomial.legendre.leggauss(40)
    points, weights = (1 + points) / 2, weights / 2
    speed, along, across = 10.0, np.array([1e11]), np.array([-4e10])
    film = by_gradient(CARREAU, speed, along, across)
    driven = flow(film, speed, along) - speed * FILM / 2, -(FILM**3) / (12 * film.flow) * across
    found = thinned_across(
        CARREAU.curve(VISCOSITY), np.full((1, 40), VISCOSITY), (points, weights), np.full(1, FILM), speed, driven
    )[0][0]
    zeroth = (weights / found).sum()
    assert 1 / zeroth == pytest.approx(film.shear[0], rel=1e-4)
    assert 2 * (weights * points / found).sum() / zeroth == pytest.approx(film.carried[0], rel=1e-4)
