"""The fixed point of film and temperature, with temperatures that do not come from an energy equation."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.bearing.thermal.field.coupling import Coupled, coupled
from roughfilm.rom.bearing.thermal.field.films import HeatedBearing, HeatedSolution
from roughfilm.rom.bearing.thermal.field.heated import Mixture
from roughfilm.rom.bearing.thermal.field.nodal import in_scene, logarithms, nodal_field
from roughfilm.rom.bearing.thermal.field.residual import residual_of
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution, solve, with_viscosities

VISCOSITY, SPEED, LENGTH, FILM = 0.05, 3.0, 0.1, 4e-5


@dataclass(frozen=True)
class GivenTemperature:
    """Temperatures of a film that a rule gives, with the viscosity η₀ exp(-0.03 (T - 300 K))."""

    temperature: Array
    settled: bool = True
    inlet: Mixture | None = None

    @property
    def viscosities(self) -> Viscosities:
        eta = VISCOSITY * np.exp(-0.03 * (self.temperature - 300))
        return Viscosities(flow=eta, shear=eta, carried=np.ones_like(eta))


def wedge(speed: float = SPEED) -> Problem:
    shape = Shape(
        thickness=lambda x, y: FILM * (2 - x / LENGTH) + 0 * y, breaks=(0.0, LENGTH), across=(0.0, 0.08), wide=False
    )
    return Problem(shape=shape, ends=Ends(inlet=0.0, sides=(0.0, 0.0)), speed=speed, viscosity=VISCOSITY)


def by_pressure(solution: Solution, near: GivenTemperature | None) -> GivenTemperature:  # noqa: ARG001
    """The film is hotter by 1 K for 10 kPa, so that a thinner lubricant is colder."""
    return GivenTemperature(300 + solution.state.pressure / 1e4)


def of_one_temperature(solution: Solution, near: GivenTemperature | None) -> GivenTemperature:  # noqa: ARG001
    return GivenTemperature(np.full(solution.grid.shape, 320.0))


def heated(problem: Problem, heating, cells: int = 24) -> HeatedSolution:
    bearing = HeatedBearing(heating=heating)
    found = solve(problem, (cells, cells), heated=bearing.film(tolerance=1e-11, ruptures=True))
    assert isinstance(found, HeatedSolution)
    return found


def test_the_film_has_the_viscosities_of_its_temperatures():
    found = heated(wedge(), by_pressure)
    own = found.problem.at_nodes
    np.testing.assert_allclose(own.flow, VISCOSITY * np.exp(-3e-6 * found.state.pressure), rtol=6e-5)
    assert found.changes[-1] <= 5e-5
    assert found.residual <= 1e-11
    assert residual_of(found, found.heated.viscosities) <= 1e-5
    assert residual_of(found, own) == pytest.approx(found.residual, abs=1e-11)


def test_each_grid_has_its_own_temperatures():
    found = heated(wedge(), by_pressure)
    coarse = found.coarser
    assert isinstance(coarse, HeatedSolution)
    expected = VISCOSITY * np.exp(-3e-6 * coarse.state.pressure)
    np.testing.assert_allclose(coarse.problem.at_nodes.flow, expected, rtol=6e-5)


def test_one_temperature_gives_the_film_of_its_viscosity():
    found = heated(wedge(), of_one_temperature)
    plain = Problem(**{**vars(wedge()), "viscosity": VISCOSITY * np.exp(-0.6)})
    np.testing.assert_allclose(found.state.pressure, solve(plain, (24, 24)).state.pressure, rtol=1e-7, atol=1e-3)
    assert len(found.changes) == 1  # the finest grid starts from the viscosities of the coarser one


def test_a_wall_that_slides_back_mirrors_the_film():
    back = wedge(-SPEED)
    shape = Shape(**{**vars(back.shape), "thickness": lambda x, y: FILM * (1 + x / LENGTH) + 0 * y})
    here, there = heated(wedge(), by_pressure), heated(Problem(**{**vars(back), "shape": shape}), by_pressure)
    np.testing.assert_allclose(there.state.pressure, here.state.pressure, rtol=1e-4, atol=1.0)
    values = logarithms(here.heated.viscosities)
    x, y = np.meshgrid(here.grid.x, here.grid.y, indexing="ij")
    mirrored = in_scene(there, values)
    np.testing.assert_allclose(mirrored(LENGTH - x, y).flow, here.heated.viscosities.flow, rtol=1e-12)


def test_a_field_is_linear_between_nodes():
    found = heated(wedge(), of_one_temperature)
    x, y = np.meshgrid(found.grid.x, found.grid.y, indexing="ij")
    field = nodal_field(found, np.stack([1 + 2 * x + 3 * y, x - y, 0 * x + 0.5]))
    at = np.array([0.0, 0.013, 0.0777, 0.1]), np.array([0.08, 0.0123, 0.0501, 0.0])
    viscosities = field(*at)
    np.testing.assert_allclose(np.log(viscosities.flow), 1 + 2 * at[0] + 3 * at[1], atol=1e-12)
    np.testing.assert_allclose(np.log(viscosities.shear), at[0] - at[1], atol=1e-12)
    np.testing.assert_allclose(viscosities.carried, 0.5)


@dataclass(frozen=True)
class Number:
    """A film of which nothing but the viscosity of its nodes counts."""

    solution: Solution


def of_rule(rule) -> Coupled:
    """The fixed point of a rule for the temperature over ln(η/η₀) of a film."""
    plain = solve(wedge(), (8, 8))

    def again(film: Number, values: Array, _error: float) -> Number:
        eta = np.exp(values[0])
        problem = Problem(
            **{**vars(film.solution.problem), "at_nodes": Viscosities(flow=eta, shear=eta, carried=values[2])}
        )
        return Number(Solution(**{**vars(film.solution), "problem": problem}))

    def heating(solution: Solution, near: GivenTemperature | None) -> GivenTemperature:
        own = solution.problem.at_nodes
        thinned = np.zeros(solution.grid.shape) if own is None else np.log(own.flow / VISCOSITY)
        return GivenTemperature(rule(thinned, None if near is None else near.temperature))

    return coupled(Number(plain), again, heating, tolerance=1e-9)


@pytest.mark.parametrize("slope", [0.5, -0.9, -3.0])
def test_rules_with_any_slope_converge(slope):
    """Plain iteration diverges for a slope below -1; with T = 320 K + c ln(η/η₀), -0.03 (T - 300 K) = ln(η/η₀)."""
    found = of_rule(lambda thinned, _: 320 - slope / 0.03 * thinned)
    expected = -0.6 / (1 - slope)
    np.testing.assert_allclose(np.log(found.heated.viscosities.flow / VISCOSITY), expected, rtol=1e-6)
    assert len(found.changes) < 12


@dataclass(frozen=True)
class Loaded:
    """A film whose load has an error, as a search that stops early leaves it."""

    solution: Solution
    error: float


def test_the_last_film_carries_its_load_to_the_tolerance_of_the_search():
    """Films that change further carry it to a part of their change, the last one with an error of 0."""
    asked: list[float] = []

    def again(film: Loaded, values: Array, error: float) -> Loaded:
        asked.append(error)
        varied = nodal_field(film.solution, values)
        return Loaded(with_viscosities(film.solution, varied, tolerance=1e-11, ruptures=True), error)

    found = coupled(Loaded(solve(wedge(), (24, 24)), 0.01), again, by_pressure, error=0.01, carried=0.2)
    assert found.film.error == asked[-1] == 0
    assert 0 < asked[0] < found.changes[0]
    np.testing.assert_array_less(found.changes[-1], 2e-5)


def at_inlet(response: float) -> Coupled:
    """Films of the temperature T of their inlet, whose mixture has 320 K + 0.6 (T - 320 K) + 20 K ln(η/η₀).

    With ln(η/η₀) = -0.03 (T - 300 K), T is that of its own mixture where 0.4 (T - 320 K) = -0.6 (T - 300 K).
    """
    plain = solve(wedge(), (8, 8))

    def again(film: Number, values: Array, _error: float) -> Number:
        eta = np.exp(values[0])
        own = Viscosities(flow=eta, shear=eta, carried=values[2])
        return Number(replace(film.solution, problem=replace(film.solution.problem, at_nodes=own)))

    def heating(solution: Solution, near: GivenTemperature | None) -> GivenTemperature:
        own, shape = solution.problem.at_nodes, solution.grid.shape
        thinned = 0.0 if own is None else float(np.log(own.flow / VISCOSITY).mean())
        temperature = 320.0 if near is None else near.inlet.following
        error = 320 + 0.6 * (temperature - 320) + 20 * thinned - temperature
        field = None if response == 0 else np.stack([np.full(shape, response)] * 2 + [np.zeros(shape)])
        mixture = Mixture(temperature=temperature, error=error, slope=0.6, response=field)
        return GivenTemperature(np.full(shape, temperature), settled=abs(error) < 1e-4, inlet=mixture)

    return coupled(Number(plain), again, heating, tolerance=1e-9)


@pytest.mark.parametrize("response", [0.0, -0.03])
def test_the_temperature_at_the_inlet_is_found_with_the_film(response):
    found = at_inlet(response)
    np.testing.assert_allclose(found.heated.temperature, 308, atol=1e-3)


def test_temperatures_that_run_away_end_in_one_line():
    with pytest.raises(ConvergenceError, match=r"thermal runaway.* grew from .* to .* °C, above 500 °C") as caught:
        of_rule(lambda _, before: np.full((9, 9), 320.0) if before is None else 1.1 * before)
    assert caught.value.outcome is Outcome.DIVERGED
    assert "\n" not in str(caught.value)


def test_temperatures_that_never_settle_end_in_one_line():
    numbers = np.random.default_rng(3)
    with pytest.raises(ConvergenceError, match=r"differ by .* after 60 films, above the tolerance") as caught:
        of_rule(lambda _thinned, _before: 320 + 10 * numbers.random((9, 9)))
    assert caught.value.outcome is Outcome.STALLED
    assert caught.value.iterations == 60
