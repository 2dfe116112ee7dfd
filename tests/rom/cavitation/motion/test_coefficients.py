"""Stiffness and damping: against differences of films, closed forms of short and long journals, and of a recess."""

from dataclasses import replace

import numpy as np
import pytest
from moving_films import (
    CLEARANCE,
    RADIUS,
    SPEED,
    VISCOSITY,
    damping_of_slow_motions,
    drive,
    full,
    journal,
    plates,
    steady,
)

from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.coupled import settled
from roughfilm.rom.cavitation.motion.film import Inflow

PLACE = np.array([0.3, -0.4]) * CLEARANCE


@pytest.fixture(scope="module")
def cavitated():
    """A journal with a cavity, its film at a place, and the coefficients there."""
    film = journal((32, 6), halved=True)
    at = steady(film, PLACE, tolerance=1e-12)
    assert (at.kind == CAVITY).any()
    return film, at, coefficients(film, at, speed=SPEED)


def test_the_stiffness_is_the_difference_of_steady_forces(cavitated):
    film, at, found = cavitated
    step = 1e-4 * CLEARANCE
    for number, change in enumerate(step * np.eye(2)):
        forces = [
            film.force(
                settled(film, replace(at, place=PLACE + side * change), drive(film), tolerance=1e-12).state.pressure
            )
            for side in (1, -1)
        ]
        differences = -(forces[0] - forces[1]) / (2 * step)
        np.testing.assert_allclose(
            found.stiffness[:, number], differences, rtol=1e-5, atol=1e-6 * found.stiffness.max()
        )


def test_the_damping_is_the_difference_of_forces_of_slow_steady_motions(cavitated):
    film, _, found = cavitated
    np.testing.assert_allclose(
        found.damping, damping_of_slow_motions(film, PLACE), rtol=1e-4, atol=1e-5 * found.damping.max()
    )


def test_the_damping_of_a_film_without_cavitation_is_symmetric():
    film = journal((24, 4), ruptures=False)
    found = coefficients(film, steady(film, PLACE, tolerance=1e-12), speed=SPEED).damping
    np.testing.assert_allclose(found, found.T, rtol=1e-7)
    assert (np.linalg.eigvalsh(found) > 0).all()


def short_journal(eccentricity, width):
    """Force, stiffness and damping of a short journal with the film over half of it (Ocvirk).

    From p = -(6η/h³)(B²/4 - y²)(U/2 ∂h/∂x + ∂h/∂t) over 0 < θ < π with h = c (1 + ε cos θ), which integrates over y to
    the force -η B³/h³ (…) per length; by quadrature of the derivatives. The limits of the film contribute nothing to
    first order, since p = 0 there. Friswell et al. 2010, Dynamics of Rotating Machines, 5.5.3, has the integrals.
    """
    count = 20000
    theta = (np.arange(count) + 0.5) * np.pi / count
    weight = RADIUS * np.pi / count
    h = CLEARANCE * (1 + eccentricity * np.cos(theta))
    normals = np.stack([np.cos(theta), np.sin(theta)])
    slopes = np.stack([-np.sin(theta), np.cos(theta)]) / RADIUS
    wedge = SPEED / 2 * eccentricity * CLEARANCE * slopes[0]
    scale = VISCOSITY * width**3
    force = (-scale * wedge / h**3 * normals).sum(axis=1) * weight
    by_place = scale * (3 * normals * wedge / h**4 - SPEED / 2 * slopes / h**3)
    by_velocity = -scale * normals / h**3
    stiffness = -(normals[:, None] * by_place).sum(axis=-1) * weight
    damping = -(normals[:, None] * by_velocity).sum(axis=-1) * weight
    return force, stiffness, damping


def friswell(eccentricity):
    """K c/W and B c ω/W of a short journal in closed form, v against the load; Friswell et al. 2010, 5.87."""
    e, q = eccentricity, np.pi**2
    h = (q * (1 - e**2) + 16 * e**2) ** -1.5
    root = np.sqrt(1 - e**2)
    stiffness = (
        4
        * h
        * np.array(
            [
                [q * (2 - e**2) + 16 * e**2, np.pi * (q * (1 - e**2) ** 2 - 16 * e**4) / (4 * e * root)],
                [
                    -np.pi * (q * (1 - e**2) * (1 + 2 * e**2) + 32 * e**2 * (1 + e**2)) / (4 * e * root),
                    q * (1 + 2 * e**2) + 32 * e**2 * (1 + e**2) / (1 - e**2),
                ],
            ]
        )
    )
    cross = -8 * h * (q * (1 + 2 * e**2) - 16 * e**2)
    damping = np.array(
        [
            [2 * np.pi * h * root * (q * (1 + 2 * e**2) - 16 * e**2) / e, cross],
            [cross, 2 * np.pi * h * (q * (1 - e**2) ** 2 + 48 * e**2) / (e * root)],
        ]
    )
    return stiffness, damping


@pytest.mark.parametrize("eccentricity", [0.2, 0.6])
def test_narrow_journals_have_the_coefficients_of_short_ones(eccentricity):
    width = 0.05 * RADIUS
    film = journal((192, 8), width=width, halved=True)
    at = steady(film, [eccentricity * CLEARANCE, 0.0], tolerance=1e-11)
    found = coefficients(film, at, speed=SPEED)
    force, stiffness, damping = short_journal(eccentricity, width)
    load = np.hypot(*force)
    np.testing.assert_allclose(film.force(at.state.pressure), force, atol=0.01 * load)
    np.testing.assert_allclose(found.stiffness, stiffness, atol=0.02 * np.abs(stiffness).max())
    np.testing.assert_allclose(found.damping, damping, atol=0.02 * np.abs(damping).max())


@pytest.mark.parametrize("eccentricity", [0.2, 0.6])
def test_the_quadrature_of_short_journals_is_their_closed_form(eccentricity):
    force, stiffness, damping = short_journal(eccentricity, RADIUS)
    load = np.hypot(*force)
    up = force / load
    turned = np.array([[up[1], -up[0]], up])
    factor = CLEARANCE / load
    k, b = friswell(eccentricity)
    np.testing.assert_allclose(factor * turned @ stiffness @ turned.T, k, rtol=1e-4)
    np.testing.assert_allclose(factor * SPEED / RADIUS * turned @ damping @ turned.T, b, rtol=1e-4)


def test_infinitely_wide_journals_have_the_coefficients_of_sommerfeld():
    """Without cavitation F = 12πηU(R/c)² ε/((2 + ε²)√(1 - ε²)) across the eccentricity.

    It turns with the eccentricity, so that its stiffness across is f/e and along f'(e). A journal that orbits at the
    rate φ̇ has the force of one that turns at ω - 2φ̇, so that its damping across is 2f/(ωe); that along the eccentricity
    is 12πηR³/(c³(1 - ε²)^(3/2)).
    """
    e = 0.5
    film = journal((256, 1), wide=True, ruptures=False)
    at = steady(film, [e * CLEARANCE, 0.0], tolerance=1e-12)
    found = coefficients(film, at, speed=SPEED)

    def force(e):
        return 12 * np.pi * VISCOSITY * SPEED * (RADIUS / CLEARANCE) ** 2 * e / ((2 + e**2) * np.sqrt(1 - e**2))

    across = film.force(at.state.pressure)[1]
    assert abs(across) == pytest.approx(force(e), rel=1e-4)
    by_e = (force(e + 1e-6) - force(e - 1e-6)) / (2e-6 * CLEARANCE)
    sign = -np.sign(across)
    stiffness = sign * np.array([[0.0, -force(e) / (e * CLEARANCE)], [by_e, 0.0]])
    radial = 12 * np.pi * VISCOSITY * RADIUS**3 / (CLEARANCE**3 * (1 - e**2) ** 1.5)
    damping = np.diag([radial, 2 * force(e) * RADIUS / (SPEED * e * CLEARANCE)])
    np.testing.assert_allclose(found.stiffness, stiffness, rtol=1e-3, atol=1e-4 * np.abs(stiffness).max())
    np.testing.assert_allclose(found.damping, damping, rtol=1e-3, atol=1e-4 * np.abs(damping).max())


class Capillary:
    """A restrictor whose flow is k Δp."""

    def __init__(self, conductance):
        self.conductance = conductance

    def flow(self, drop):
        return self.conductance * drop, self.conductance


def test_plates_with_a_recess_behind_a_capillary_have_the_closed_form():
    """A recess of length 2a and lands of length l: k (pₛ - pᵣ) = 2 (h³/(12ηl) pᵣ + l ḣ/2) + 2a ḣ, and the load on it.

    The force per width is (2a + l) pᵣ - 2ηl³ḣ/h³, so that the load, K = -∂F/∂h and B = -∂F/∂ḣ follow.
    """
    half, land, height, viscosity, supply = 0.02, 0.03, 5e-5, 0.05, 2e6
    length, nodes = 2 * (half + land), 100
    conductance = height**3 / (12 * viscosity * land)
    recess = Inflow(
        covers=lambda x, y: (np.abs(x - length / 2) <= half * (1 + 1e-9)) & np.isfinite(y),
        pressure=supply,
        restrictor=Capillary(conductance),
    )
    film = plates(nodes, length=length, viscosity=viscosity, inflows=(recess,))
    lever, flow = 2 * half + land, conductance + 2 * height**3 / (12 * viscosity * land)
    within = supply * conductance / flow
    load = within * lever
    start = replace(full(film, [1.3 * height]), pressures=np.array([0.5 * supply]))
    at = settled(film, start, drive(film, force=[-load]), tolerance=1e-11)
    assert at.place[0] == pytest.approx(height, rel=1e-8)
    assert at.pressures[0] == pytest.approx(within, rel=1e-8)
    entering = at.balance[film.covered[0]].sum()
    assert entering == pytest.approx(conductance * (supply - within), rel=1e-8)
    found = coefficients(film, at, speed=0.0)
    stiffness = lever * supply * conductance / flow**2 * 6 * height**2 / (12 * viscosity * land)
    squeeze = 2 * viscosity * land**3 / height**3 * (1 - (length / nodes / land) ** 2)  # a sum over the nodes
    assert found.stiffness[0, 0] == pytest.approx(stiffness, rel=1e-6)
    assert found.damping[0, 0] == pytest.approx(lever**2 / flow + squeeze, rel=1e-6)
