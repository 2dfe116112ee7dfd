"""The mean temperature of a film: closed forms, transported profiles, and heat balances of many films."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.evaluation.flows import flow_along, node_balances
from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.problem import Inflow, Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution, solve
from roughfilm.rom.homogenization.ridges import sinusoidal_ridges
from roughfilm.rom.lubricants.compressibility import DowsonHigginson
from roughfilm.rom.lubricants.liquid import Liquid
from roughfilm.rom.lubricants.viscosity import Barus, Roelands
from roughfilm.rom.temperature.closed_forms.couette import adiabatic_couette
from roughfilm.rom.temperature.closed_forms.slider import adiabatic_slider, slightly_heated_slider
from roughfilm.rom.temperature.dissipation import dissipation, film_flows
from roughfilm.rom.temperature.mean import MeanTemperature, mean_temperature

T0, ETA, BETA, HEAT = 313.15, 0.05, 0.03, 1.7e6
FILM, LENGTH, WIDTH, SPEED = 4e-5, 0.1, 0.08, 10.0
TURN, CLEARANCE = 2 * np.pi * 0.05, 5e-5


def liquid(slope: float = BETA, *, viscosity: float = ETA, heat: float = HEAT) -> Liquid:
    """η = η0 exp(-β (T - T0)) and a constant ρ c."""

    def over_temperature(temperature: Array) -> tuple[Array, Array]:
        eta = viscosity * np.exp(-slope * (temperature - T0))
        return eta, -slope * eta

    return Liquid(
        temperature=T0,
        viscosity=over_temperature,
        heat=lambda temperature: (heat * (temperature - T0), heat + 0 * temperature),
        conductivity=0.13,
    )


OIL = {"viscosity": ETA, "temperature_coefficient": BETA, "heat_per_volume": HEAT}
PAD = {"film": FILM, "rise": FILM, "length": LENGTH, "speed": SPEED}
INVISCID = liquid(viscosity=0.0)
"""A liquid whose film dissipates nothing, though its pressure and its flows are those of another."""


def shape_of(thickness: Callable[[Array, Array], Array], **options: object) -> Shape:
    given = {"breaks": (0.0, LENGTH), "across": (0.0, WIDTH), "wide": False, **options}
    return Shape(thickness=lambda x, y: thickness(x, y) + 0 * x + 0 * y, **given)


def problem_of(shape: Shape, ends: Ends, **options: object) -> Problem:
    return Problem(**{"shape": shape, "ends": ends, "speed": SPEED, "viscosity": ETA, **options})


def wedge(x: Array, _y: Array) -> Array:
    return FILM * (2 - x / LENGTH)


def eccentric(x: Array, _y: Array) -> Array:
    return CLEARANCE * (1 + 0.7 * np.cos(x / TURN * 2 * np.pi))


def groove(low: float, high: float, pressure: float = 2e5) -> Inflow:
    return Inflow(covers=lambda x, y: (x >= low) & (x <= high) & (abs(y / WIDTH - 0.5) < 0.4), pressure=pressure)


INLET = 3e7
OPEN = Ends(inlet=0.0, sides=(0.0, 0.0))
RING = {"breaks": (0.0, TURN), "joined": (True, False)}
BEGIN, END = 0.2 * TURN, 0.25 * TURN
FILMS = {
    "pad": problem_of(shape_of(wedge), OPEN),
    "journal": problem_of(
        shape_of(eccentric, **{**RING, "breaks": (0.0, BEGIN, END, TURN)}),
        Ends(sides=(0.0, 0.0)),
        inflows=(groove(BEGIN, END),),
    ),
    "journal in a bath": problem_of(shape_of(eccentric, **RING), Ends(sides=(1e5, 1e5))),
    "starved": problem_of(shape_of(wedge), Ends(inlet=None, theta=0.6, sides=(0.0, 0.0))),
    "side inflow": problem_of(shape_of(wedge), Ends(inlet=2e6, sides=(3e6, 0.0))),
    "reverse flow": problem_of(shape_of(wedge), Ends(inlet=0.0, outlet=3e7), speed=1.0),
    "at rest": problem_of(shape_of(wedge), Ends(inlet=1e6, sides=(5e5, 0.0)), speed=0.0),
    "polar": problem_of(
        shape_of(lambda x, y: FILM * (2 - x / 0.8), breaks=(0.0, 0.8), across=(0.1, 0.2), polar=True), OPEN, speed=60.0
    ),
    "infinitely wide": problem_of(shape_of(wedge, wide=True), Ends(inlet=0.0)),
    "cavitated": problem_of(shape_of(lambda x, y: FILM * (1 + 4 * (x / LENGTH - 0.4) ** 2)), OPEN),
    "pocket": problem_of(
        shape_of(
            lambda x, y: FILM * (1 + 5 * ((abs(x - 0.05) < 0.02) & (abs(y - 0.04) < 0.02))),
            breaks=(0.0, 0.03, 0.07, 0.1),
            steps_across=(0.02, 0.06),
        ),
        OPEN,
    ),
    "groove": problem_of(shape_of(wedge), OPEN, inflows=(groove(0.04, 0.06, 1e6),)),
    "rough": problem_of(shape_of(wedge, roughness=sinusoidal_ridges(0.5 * FILM, 0.0)), OPEN),
    "oblique lay": problem_of(shape_of(wedge, roughness=sinusoidal_ridges(0.5 * FILM, 0.6)), OPEN),
    "rough cavitated": problem_of(
        shape_of(
            lambda x, y: FILM * (1 + 4 * (x / LENGTH - 0.4) ** 2), roughness=sinusoidal_ridges(0.5 * FILM, np.pi / 4)
        ),
        OPEN,
    ),
    "compressible": problem_of(
        shape_of(wedge),
        Ends(inlet=INLET, sides=(0.0, 0.0)),
        compressibility=DowsonHigginson(law="dowson_higginson"),
        piezoviscosity=Barus(law="barus", pressure_coefficient="20 1/GPa"),
    ),
    "roelands": problem_of(shape_of(wedge), OPEN, piezoviscosity=Roelands(law="roelands", index=0.6)),
    "closing": problem_of(shape_of(wedge), OPEN, opening=lambda x, y: -2e-3 + 0 * x),
}
CIRCULATING = {"journal", "journal in a bath"}


SUCKING = problem_of(shape_of(lambda x, y: FILM * (1 + x / LENGTH)), OPEN)
"""A film that takes liquid in at its sides, as it does not rupture."""


@cache
def film(name: str, cells: int = 24) -> Solution:
    return solve(FILMS[name], (cells, cells))


def errors_of(found: MeanTemperature) -> float:
    """Generated + in - out - to walls - stored, over what is generated and enters."""
    places = found.carried.values()
    came, left = sum(one.heat_in for one in places), sum(one.heat_out for one in places)
    generated, to_walls = float(found.dissipation.sum()), float(found.to_walls.sum())
    return abs(generated + came - left - to_walls - found.stored) / (generated + abs(came))


@pytest.mark.parametrize("name", FILMS)
def test_energy_leaves_as_it_comes(name: str) -> None:
    solution = film(name)
    entering = T0 + 8 * np.sin(40 * solution.grid.x)[:, None] + 5 * np.cos(50 * solution.grid.y)
    for found in (
        mean_temperature(solution, liquid()),
        mean_temperature(solution, liquid(), entering=entering),
        mean_temperature(solution, liquid(), exchange=500.0, wall=T0 - 5),
    ):
        assert errors_of(found) < 1e-8
        assert found.imbalance < 1e-8
        assert np.isfinite(found.temperature).all()


@pytest.mark.parametrize("name", [name for name in FILMS if name != "polar"])
def test_dissipation_is_the_power_of_friction_and_of_the_flows(name: str) -> None:
    """Σ W = u F + Σ P Q with P = ∫ dp/θ, to round-off or, where only P at the inlet is known, to the residual."""
    solution = film(name)
    flows, pressure = film_flows(solution), solution.state.pressure
    if name == "compressible":
        integral = quad(lambda p: 1 / (1 + solution.problem.compression(np.array([p]))[0][0]), 0, INLET, epsabs=0)[0]
        pressure = np.where(pressure == INLET, integral, 0.0)
        assert integral < 0.995 * INLET
    power = dissipation(solution, flows)
    given = solution.problem.speed * friction(solution)
    scale = given + float(np.abs(pressure * flows.entering).sum())
    work = float((pressure * (flows.entering - flows.stored)).sum())
    assert power.sum() == pytest.approx(given + work, abs=(1e-9 if name == "compressible" else 1e-12) * scale)
    assert power.min() > -1e-3 * power.max()


def test_dissipation_of_a_sector_is_the_power_of_its_torque() -> None:
    """M = ∫ r τ dA: of a parallel sector without pressure η ω r²/h, so that the power is η ω² ∫ r³ dr dφ/h."""
    flat = shape_of(lambda x, y: FILM, breaks=(0.0, 0.8), across=(0.1, 0.2), polar=True)
    solution = solve(problem_of(flat, OPEN, speed=60.0), (12, 64))
    power = dissipation(solution, film_flows(solution)).sum()
    assert power == pytest.approx(ETA * 60.0**2 * 0.8 * (0.2**4 - 0.1**4) / 4 / FILM, rel=1e-3)


@pytest.mark.parametrize("name", FILMS)
def test_liquid_that_enters_warm_stays_so_without_dissipation(name: str) -> None:
    found = mean_temperature(film(name), INVISCID, entering=T0 + 7)
    moving = np.ones(found.temperature.shape, dtype=bool)
    if name == "closing":
        moving = film_flows(film(name)).entering >= 0  # the others are fed by the closing wall as well
    np.testing.assert_allclose(found.temperature[moving], T0 + 7, rtol=0, atol=1e-9)


def couette(cells: int) -> tuple[MeanTemperature, Array]:
    flat = problem_of(shape_of(lambda x, y: FILM, wide=True), Ends(inlet=0.0))
    solution = solve(flat, (cells, 1))
    return mean_temperature(solution, liquid()), solution.grid.x


def order(errors: list[float]) -> float:
    return float(np.log2(errors[0] / errors[-1]) / (len(errors) - 1))


def test_adiabatic_couette_flow() -> None:
    errors, at_end = [], []
    for cells in (16, 32, 64):
        found, x = couette(cells)
        exact = adiabatic_couette(x, film=FILM, speed=SPEED, temperature=T0, **OIL)
        error = np.abs(found.temperature[:, 0] - exact)
        errors.append(float(error[1:].max()))
        at_end.append(float(error[-1]))
    assert exact[-1] - T0 > 24
    assert at_end[-1] < 1e-3
    assert errors[-1] < 1e-2
    assert order(errors) == pytest.approx(2, abs=0.25)
    assert order(at_end) > 1.7


def test_walls_take_heat() -> None:
    """ρ c (u h/2) dT/dx = η u²/h - U (T - T_w) for a constant viscosity: T nears T_w + η u²/(h U) exponentially."""
    exchange, wall, errors = 5e3, T0 - 10, []
    for cells in (16, 32, 64):
        solution = solve(problem_of(shape_of(lambda x, y: FILM, wide=True), Ends(inlet=0.0)), (cells, 1))
        found = mean_temperature(solution, liquid(0.0), exchange=exchange, wall=wall)
        far = wall + ETA * SPEED**2 / FILM / exchange
        exact = far + (T0 - far) * np.exp(-exchange * solution.grid.x / (HEAT * SPEED * FILM / 2))
        errors.append(float(np.abs(found.temperature[1:, 0] - exact[1:]).max()))
    assert errors[-1] < 2e-2
    assert order(errors) == pytest.approx(2, abs=0.35)


def test_circulating_liquid_gives_its_heat_to_the_walls() -> None:
    """Between parallel walls that are periodic in both directions, T = T_w + η u²/(h U) everywhere."""
    closed = shape_of(lambda x, y: FILM, joined=(True, True))
    solution = solve(problem_of(closed, Ends(anchor=(0.0, 0.0, 1e5))), (16, 12))
    found = mean_temperature(solution, liquid(0.0), exchange=1e5)
    np.testing.assert_allclose(found.temperature, T0 + ETA * SPEED**2 / FILM / 1e5, rtol=0, atol=1e-8)


@pytest.mark.parametrize("wide", [True, False])
def test_liquid_that_only_circulates_has_no_steady_temperature(wide: bool) -> None:
    closed = shape_of(eccentric, **{**RING, "joined": (True, not wide), "wide": wide})
    solution = solve(problem_of(closed, Ends(anchor=(0.0, 0.0, 1e5))), (16, 12))
    with pytest.raises(ConvergenceError, match="heats by more than 500 K"):
        mean_temperature(solution, liquid())


def test_slight_heating_of_a_wedge() -> None:
    """The temperature at the outlet to first order in the heating, from the solution of constant viscosity."""
    exact = slightly_heated_slider(**PAD, **OIL).outlet_rise
    errors = []
    for cells in (16, 32, 64):
        solution = solve(FILMS["infinitely wide"], (cells, 1))
        errors.append(abs(mean_temperature(solution, liquid(0.0)).temperature[-1, 0] - T0 - exact))
        slight = mean_temperature(solution, liquid(heat=1000 * HEAT)).temperature[-1, 0] - T0
        assert slight * 1000 == pytest.approx(exact, rel=BETA * exact / 1000 + 1 / cells**2)
    assert errors[-1] < 1e-3 * exact
    assert order(errors) == pytest.approx(2, abs=0.3)


def stream_function(solution: Solution) -> Array:
    """The stream function at the nodes, m³/s, but for the last i: flows between corners of the control volumes."""
    entering = node_balances(solution)
    through = np.vstack([entering[:1], flow_along(solution)[:-1]])
    through[0, 0] = 0.0
    low = np.append(0.0, -np.cumsum(entering[:-1, 0]))
    corners = low[:, None] + np.pad(np.cumsum(through, axis=1), ((0, 0), (1, 0)))
    rows = np.column_stack([corners[:, 0], (corners[:, 1:-2] + corners[:, 2:-1]) / 2, corners[:, -1]])
    return np.vstack([rows[:1], (rows[1:-1] + rows[2:]) / 2, rows[-1:]])


@pytest.mark.parametrize("problem", [SUCKING, FILMS["polar"]], ids=["side inflow", "polar"])
def test_heat_follows_the_streamlines(problem: Problem) -> None:
    """Without dissipation T is a function of the stream function: second-order accurate in the mean over the film."""
    errors = []
    for cells in (24, 48, 96):
        solution = solve(problem, (cells, cells), ruptures=False)
        psi = stream_function(solution)
        profile = T0 + 10 * np.sin(4 * psi / np.abs(psi).max())
        found = mean_temperature(solution, INVISCID, entering=profile)
        errors.append(float(np.abs(found.temperature - profile)[1:-1, 1:-1].mean()))
    assert errors[-1] < 0.02
    assert order(errors) == pytest.approx(2, abs=0.3)


def test_a_front_is_carried_without_overshoot() -> None:
    """A rod of warm liquid keeps its rows in a parallel film; oblique to the rows it stays within the temperatures."""
    flat = solve(problem_of(shape_of(lambda x, y: FILM), OPEN), (16, 24))
    warm = np.broadcast_to(np.where(abs(flat.grid.y / WIDTH - 0.5) < 0.2, 10.0, 0.0), flat.grid.shape)
    found = mean_temperature(flat, INVISCID, entering=T0 + warm)
    np.testing.assert_allclose(found.temperature, T0 + warm, rtol=0, atol=1e-9)
    for sign in (10.0, -10.0):
        solution = film("side inflow", 48)
        front = np.broadcast_to(np.where(abs(solution.grid.y / WIDTH - 0.5) < 0.2, sign, 0.0), solution.grid.shape)
        carried = mean_temperature(solution, INVISCID, entering=T0 + front).temperature - T0
        assert carried.min() >= min(sign, 0.0) - 1e-2
        assert carried.max() <= max(sign, 0.0) + 1e-2
        assert np.ptp(carried[-1]) > 9


def test_cavities_and_rings_are_among_the_films() -> None:
    for name in ("journal", "cavitated", "starved", "rough cavitated"):
        assert (film(name).kind == CAVITY).mean() > 0.1
    found = mean_temperature(film("reverse flow"), liquid())
    assert found.carried["inlet"].flow_out > 0
    assert found.carried["outlet"].flow_in > 0
    assert mean_temperature(film("side inflow"), liquid()).carried["sides"].flow_in > 0


def test_a_start_does_not_change_the_temperature() -> None:
    solution = film("pad")
    found = mean_temperature(solution, liquid())
    again = mean_temperature(solution, liquid(), start=found.temperature + 20)
    np.testing.assert_allclose(again.temperature, found.temperature, rtol=0, atol=1e-3)


def in_turn(cells: int, oil: Liquid, films: int) -> tuple[Solution, MeanTemperature, list[float]]:
    """The last of films of η(T) and of temperatures of films, and the changes of ln η."""
    problem, changes, old = FILMS["infinitely wide"], [], np.full(cells + 1, np.log(ETA))
    x = np.linspace(0, LENGTH, old.size)
    for _ in range(films):

        def field(at: Array, _y: Array, old: Array = old) -> Viscosities:
            eta = np.exp(np.interp(at, x, old))
            return Viscosities(flow=eta, shear=eta, carried=np.ones_like(eta))

        solution = solve(replace(problem, viscosities=field), (cells, 1))
        found = mean_temperature(solution, oil)
        new = np.log(found.viscosities.flow[:, 0])
        changes.append(float(np.abs(new - old).max()))
        old = new
    return solution, found, changes


@pytest.mark.parametrize("heat", [HEAT, HEAT / 50])
def test_films_and_fields_in_turn_contract(heat: float) -> None:
    """Each change of ln η is below a quarter of the last, also where η falls to a fiftieth in the film."""
    changes = np.array(in_turn(64, liquid(heat=heat), 6)[2])
    assert (changes[1:] < 0.25 * changes[:-1]).all()


def test_they_end_at_the_adiabatic_slider() -> None:
    exact, errors = adiabatic_slider(**PAD, temperature=T0, **OIL), []
    for cells in (16, 32, 64):
        solution, found, _ = in_turn(cells, liquid(), 6)
        load = float((solution.grid.areas * solution.state.pressure).sum())
        values = np.array([load, friction(solution), flow_along(solution)[0, 0], found.temperature[-1, 0] - T0])
        truth = np.array([exact.load, exact.friction, exact.flow, exact.outlet_temperature - T0])
        errors.append(np.abs(values / truth - 1))
        powers = SPEED * friction(solution), found.carried["outlet"].heat_out, float(found.dissipation.sum())
        assert powers == pytest.approx([powers[0]] * 3, rel=1e-6)
    assert (errors[-1] < 1e-3).all()
    assert (np.log2(errors[0] / errors[-1]) / 2 > 1.7).all()
