"""Films of a shear-thinning lubricant: the fixed point of viscosities and flows against integrated lines."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.optimize import brentq

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.evaluation.flows import flow_along
from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution, on_grid
from roughfilm.rom.lubricants.shear_thinning import CarreauYasuda, ReeEyring, ThinningLaw
from roughfilm.rom.lubricants.viscosity import Barus, Roelands
from roughfilm.rom.shear_thinning.closed_forms import eyring_flow, power_law_flow
from roughfilm.rom.shear_thinning.film import pressure_gradient, thinned, thinned_profiles

VISCOSITY, SPEED, LENGTH, FILM, STRESS = 0.05, 4.0, 0.02, 1e-5, 1e4
EYRING = ReeEyring.model_validate({"law": "ree_eyring", "critical_stress": "10 kPa"})
CARREAU = CarreauYasuda.model_validate({"law": "carreau_yasuda", "index": 0.5, "critical_stress": "2 kPa"})


def wedge(*, wide: bool = True, **changes: object) -> Problem:
    shape = Shape(
        thickness=lambda x, y: FILM * (2 - x / LENGTH) + 0 * y, breaks=(0.0, LENGTH), across=(0.0, 0.02), wide=wide
    )
    ends = Ends(inlet=0.0, sides=None if wide else (0.0, 0.0))
    return replace(Problem(shape=shape, ends=ends, speed=SPEED, viscosity=VISCOSITY), **changes)


def film_of(
    problem: Problem, law: ThinningLaw, cells: tuple[int, int], *, films: int = 40
) -> tuple[Solution, list[float]]:
    """The film with the viscosities of its own flows, and their changes."""
    nodes, curve, changes = grid(problem.shape, cells), law.curve(VISCOSITY), []
    film = on_grid(problem, nodes, start=None, sweeps=400, tolerance=1e-12)
    for _ in range(films):
        found = thinned(film, curve).viscosities
        own = film.problem.at_nodes
        changes.append(float(np.abs(np.log(found.flow / (VISCOSITY if own is None else own.flow))).max()))
        if changes[-1] < 1e-11:
            break
        varied = replace(problem, viscosities=lambda x, y, found=found: found)
        film = on_grid(varied, nodes, start=film.state, sweeps=1, tolerance=1e-12)
    return film, changes


def line_of_eyring() -> tuple[float, float, float]:
    """Flow, load and friction of the wedge, from the gradient at which the closed form has the flow."""

    def gradient(q: float, h: float) -> float:
        return float(
            brentq(lambda g: float(eyring_flow(VISCOSITY, STRESS, h, SPEED, g)[0]) - q, -6e10, 6e10, xtol=1e-4)
        )

    def integrals(q: float) -> Array:
        """∫ dp/dx dx, ∫ p dx by parts, and ∫ τ dx."""

        def at(x: float) -> Array:
            h = FILM * (2 - x / LENGTH)
            g = gradient(q, h)
            return np.array([g, -x * g, float(eyring_flow(VISCOSITY, STRESS, h, SPEED, g)[1])])

        return np.asarray(quad_vec(at, 0, LENGTH, epsrel=1e-9, epsabs=1e-6)[0])

    q = float(brentq(lambda q: float(integrals(q)[0]), 0.55 * SPEED * FILM, 0.75 * SPEED * FILM, rtol=1e-9))
    _, load, pull = integrals(q)
    return q, float(load), float(pull)


def test_a_line_of_a_ree_eyring_liquid_is_second_order() -> None:
    q, load, pull = line_of_eyring()
    errors = []
    for cells in (64, 128, 256):
        film, _ = film_of(wedge(), EYRING, (cells, 1))
        found = float(flow_along(film)[0, 0]), float((film.grid.areas * film.state.pressure).sum()), friction(film)
        errors.append([abs(one / exact - 1) for one, exact in zip(found, (q, load, pull), strict=True)])
    assert max(errors[-1]) < 1e-5
    orders = np.log2(np.array(errors[0]) / np.array(errors[2])) / 2
    np.testing.assert_allclose(orders, 2, atol=0.3)
    newtonian = on_grid(wedge(), grid(wedge().shape, (64, 1)), start=None, sweeps=400, tolerance=1e-12)
    assert load < 0.7 * float((newtonian.grid.areas * newtonian.state.pressure).sum())


@pytest.mark.parametrize("index", [0.3, 0.6])
def test_the_iteration_contracts_by_one_less_index_where_pressure_alone_drives(index: float) -> None:
    law = CarreauYasuda.model_validate({"law": "carreau_yasuda", "index": index, "critical_stress": "0.1 Pa"})
    shape = Shape(thickness=lambda x, y: FILM + 0 * x + 0 * y, breaks=(0.0, LENGTH), wide=True)
    driven = wedge(shape=shape, ends=Ends(inlet=2e5, outlet=1e5), speed=0.0)
    film, changes = film_of(driven, law, (16, 1))
    ratios = np.array(changes[3:8]) / np.array(changes[2:7])
    np.testing.assert_allclose(ratios, 1 - index, rtol=0.05)
    consistency = VISCOSITY * (VISCOSITY / 0.1) ** (index - 1)
    expected = power_law_flow(consistency, index, FILM, -1e5 / LENGTH)
    assert flow_along(film)[0, 0] == pytest.approx(float(expected), rel=1e-4)


def test_an_index_of_one_is_the_newtonian_film_to_the_last_bit() -> None:
    law = CarreauYasuda.model_validate({"law": "carreau_yasuda", "index": 1, "critical_stress": "1 Pa"})
    for pressure_law in (
        Barus.model_validate({"law": "barus", "pressure_coefficient": "20 1/GPa"}),
        Roelands.model_validate({"law": "roelands", "index": 0.6}),
    ):
        plain = on_grid(
            wedge(wide=False, piezoviscosity=pressure_law),
            grid(wedge(wide=False).shape, (16, 12)),
            start=None,
            sweeps=400,
            tolerance=1e-12,
        )
        film, changes = film_of(plain.problem, law, (16, 12), films=2)
        assert changes == [0.0]
        assert (film.state.pressure == plain.state.pressure).all()


@pytest.mark.parametrize(
    "pressure_law",
    [
        Barus.model_validate({"law": "barus", "pressure_coefficient": "20 1/GPa"}),
        Roelands.model_validate({"law": "roelands", "index": 0.6}),
    ],
    ids=["Barus", "Roelands"],
)
def test_under_pressure_the_flow_is_that_of_the_thicker_liquid(pressure_law: Barus | Roelands) -> None:
    """The gradient at the nodes and the viscosity at rest under their pressure give the flow of the closed form."""
    film, changes = film_of(wedge(piezoviscosity=pressure_law), EYRING, (256, 1))
    assert changes[-1] < 1e-9
    pressure = film.state.pressure[:, 0]
    at_rest = VISCOSITY / pressure_law.fluidity(pressure, VISCOSITY)[0]
    gradient = np.gradient(pressure, film.grid.x)
    q = [
        float(eyring_flow(eta, STRESS, h, SPEED, g)[0])
        for eta, h, g in zip(at_rest, film.faces.thickness[:, 0], gradient, strict=True)
    ]
    np.testing.assert_allclose(q[2:-2], flow_along(film)[0, 0], rtol=2e-3)
    assert at_rest.max() > 1.1 * VISCOSITY


def test_a_film_with_a_width_and_cavities_settles() -> None:
    """Each film lowers the change at least by 1 - n, and the cavity has the viscosity of its shear rate."""
    shape = Shape(
        thickness=lambda x, y: FILM * (1 + 8 * (x / LENGTH - 0.4) ** 2) + 0 * y,
        breaks=(0.0, LENGTH),
        across=(0.0, 0.02),
        wide=False,
    )
    film, changes = film_of(wedge(wide=False, shape=shape), CARREAU, (32, 24))
    assert changes[-1] < 1e-9
    assert max(np.array(changes[5:]) / np.array(changes[4:-1])) < 1.1 * (1 - CARREAU.index)
    own, (along, across) = film.problem.at_nodes, pressure_gradient(film)
    assert own is not None
    cavity = (film.kind == CAVITY) & (along == 0) & (across == 0)
    assert cavity.sum() > 50
    expected = CARREAU.viscosity_at(SPEED / film.faces.thickness[cavity], VISCOSITY)
    np.testing.assert_allclose(own.shear[cavity], expected, rtol=1e-8)


def test_profiles_of_one_viscosity_at_rest_are_those_of_the_film() -> None:
    """Under pressure the profiles across have the integrals of the film's viscosities, for every law of pressure."""
    points, weights = np.polynomial.legendre.leggauss(24)
    points, weights = (1 + points) / 2, weights / 2
    curve = EYRING.curve(VISCOSITY)
    plain = wedge(piezoviscosity=Roelands.model_validate({"law": "roelands", "index": 0.6}))
    film = on_grid(plain, grid(plain.shape, (24, 1)), start=None, sweeps=400, tolerance=1e-12)
    expected = thinned(film, curve).viscosities
    at_rest = np.full((*film.grid.shape, points.size), VISCOSITY)
    found, _ = thinned_profiles(film, curve, at_rest, (points, weights))
    np.testing.assert_allclose(1 / (weights / found).sum(axis=-1), expected.shear, rtol=1e-3)
    newtonian = CarreauYasuda.model_validate({"law": "carreau_yasuda", "index": 1, "critical_stress": "1 Pa"})
    assert (thinned_profiles(film, newtonian.curve(VISCOSITY), at_rest, (points, weights))[0] == VISCOSITY).all()
