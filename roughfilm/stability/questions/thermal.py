"""Films with temperatures that test the thermal models, and the judgement of the answers."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.timing import working_time
from roughfilm.contact.foundation.units import Quantity
from roughfilm.ladder import find
from roughfilm.rom.bearing.corners import CARRIED, PUMPED
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.field.across import BetweenWalls
from roughfilm.rom.bearing.thermal.field.adiabatic import AdiabaticWalls
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm
from roughfilm.rom.bearing.thermal.field.solve import solve_heated
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.stability.checks.thermal import broken_field, broken_totals
from roughfilm.stability.form import Judgement

MODELS = ("heat_balance", "adiabatic", "across")
"""The models with temperature."""

ISOTHERMAL = "reynolds_cavitating"

HEATINGS: Mapping[str, Callable[[Bearing], Any]] = {"adiabatic": AdiabaticWalls, "across": BetweenWalls}
"""The energy equations of the models whose temperature varies over the film."""

COMPARED = (
    "load",
    "friction",
    "film_min",
    "temperature_max",
    "temperature_mean",
    "effective_temperature",
    "outlet_temperature",
    "heat_generated",
)
"""Quantities that must agree with those on a finer grid."""

SUPPLIED, DENSITY, CAPACITY, CONDUCTIVITY, THINNING = 40.0, 860.0, 2000.0, 0.14, 0.03
"""Of the lubricant: temperature, °C, density, kg/m³, heat capacity, J/(kg K), conductivity, W/(m K), and β, 1/K."""

SPEED, LENGTH, FILM = 10.0, 0.05, 30e-6
"""Of the films: sliding speed, m/s, length, m, and film thickness, m, of the heating number."""

LONGEST_S = 20.0
"""Largest CPU time of a question, s: a film that takes longer does not end."""

LESS_HEAT = 5e-3
"""Relative excess of the heat of a film over that of the isothermal one that grids may cause beyond uncertainties."""


def bounded(ask: Callable[[], Any]) -> Any:
    """The answer of a question, or its error, in a bounded time.

    Raises
    ------
    TimeoutError
        If either takes more than ``LONGEST_S``.
    """
    start, error = working_time(), None
    try:
        answer = ask()
    except (InputError, ConvergenceError) as caught:
        answer, error = None, caught
    if (cpu_s := working_time() - start) > LONGEST_S:
        raise TimeoutError(f"an end after {cpu_s:.3g} s CPU: {error or 'an answer'}")
    if error is not None:
        raise error
    return answer


def viscosity(heating: float, thinning: float = THINNING) -> float:
    """The viscosity η, Pa s, whose heating number β η u L/(ρ c h²) is given: ln η falls by it without thinning."""
    return heating * DENSITY * CAPACITY * FILM**2 / (thinning * SPEED * LENGTH)


def nahme(heating: float) -> float:
    """The Nahme number β η u²/k of a heating number."""
    return THINNING * viscosity(heating) * SPEED**2 / CONDUCTIVITY


def lubricant(heating: float, thinning: float = THINNING, **more: Any) -> dict[str, Any]:
    """The table of a lubricant with the viscosity of a heating number, and other entries."""
    law = {"law": "exponential", "temperature_coefficient": f"{thinning!r} 1/K"}
    entries = {
        "viscosity": f"{viscosity(heating)!r} Pa*s",
        "temperature": f"{SUPPLIED!r} degC",
        "density": f"{DENSITY!r} kg/m^3",
        "heat_capacity": f"{CAPACITY!r} J/(kg*K)",
        "conductivity": f"{CONDUCTIVITY!r} W/(m*K)",
        "thermoviscosity": law,
    }
    given = {**entries, **more}
    return {key: entry for key, entry in given.items() if entry is not None}


def film(geometry: Mapping[str, Any], table: Mapping[str, Any], **tables: Any) -> Bearing:
    """The scene of a film with a lubricant and other tables."""
    entries = {"name": "a film", "kind": "bearing", "motion": {"speed": f"{SPEED!r} m/s"}}
    scene = read_scene({**entries, "geometry": dict(geometry), "lubricant": dict(table), **tables})
    assert isinstance(scene, Bearing)
    return scene


@dataclass(frozen=True, kw_only=True)
class Film:
    """The result of a model with the film of its finest grid; none of the model with one temperature."""

    result: Result
    solution: Solution | None = None
    heated: HeatedFilm | None = None


def solved(scene: Bearing, model: str, cells: int) -> Film:
    """The result of a model and, where the temperature varies over the film, the film and its temperatures."""
    solver, request = find("bearing", model), Request(resolution=cells)
    if model not in HEATINGS:
        return Film(result=solver.solve(scene, request))
    last: list[tuple[Solution, HeatedFilm]] = []

    def heating(bearing: Bearing) -> Callable[[Solution, HeatedFilm | None], HeatedFilm]:
        equation = HEATINGS[model](bearing)

        def recorded(solution: Solution, near: HeatedFilm | None) -> HeatedFilm:
            found: HeatedFilm = equation(solution, near)
            last[:] = [(solution, found)]
            return found

        return recorded

    result = replace(solver, compute=partial(solve_heated, heating=heating)).solve(scene, request)
    ((solution, heated),) = last
    return Film(result=result, solution=solution, heated=heated)


@dataclass(frozen=True, kw_only=True)
class Answer:
    """The answer of a model to a scene, on a grid and on one with half the cell size.

    Attributes
    ----------
    scene : the scene.
    film : the answer.
    finer : result on the finer grid.
    most : heat of the isothermal film, of which the warm one generates less; None where this need not be.
    """

    scene: Bearing
    film: Film
    finer: Result
    most: Quantity | None


def asked(scene: Bearing, model: str, cells: int, *, less: bool = False) -> Answer:
    """Solve a scene by a model on two grids.

    Parameters
    ----------
    less : whether the film must generate less heat than at the temperature of the supply.
    """
    film_of_grid, finer = solved(scene, model, cells), solved(scene, model, 2 * cells).result
    most = find("bearing", ISOTHERMAL).solve(scene, Request(resolution=cells))["power_loss"] if less else None
    return Answer(scene=scene, film=film_of_grid, finer=finer, most=most)


def judged(answer: Answer, *, even: bool = True) -> Judgement:
    """The judgement of an answer by the balance of its heat, the laws of its temperatures, and a finer grid."""
    film, result = answer.film, answer.film.result
    faults: list[str] = []
    if film.solution is not None and film.heated is not None:
        faults += broken_field(answer.scene, result, film.solution, film.heated, even=even)
    else:
        faults += broken_totals(result)
    if answer.most is not None:
        heat = result["heat_generated"]
        allowed = answer.most.value * (1 + LESS_HEAT) + (answer.most.uncertainty or 0.0) + (heat.uncertainty or 0.0)
        if heat.value > allowed:
            faults.append(f"the film heats by {heat.value:.5g} W, the cold one by {answer.most.value:.5g} W")
    apart, unknown, inside, count = _apart(result, answer.finer)
    reported = not faults and not apart and bool(unknown)
    faults += apart + unknown
    values = result.numerics.details
    error = abs(answer.finer["load"].value / result["load"].value - 1) if result["load"].value else 0.0
    return Judgement(
        iterations=round(values["heated_films"]),
        right=not faults,
        reported=reported,
        error=error,
        numbers={"inside": float(inside), "compared": float(count)},
        message="; ".join(faults),
    )


def _apart(result: Result, finer: Result) -> tuple[list[str], list[str], int, int]:
    """The quantities outside of both uncertainties, those without one, and how many of how many one alone contains."""
    apart, unknown, inside, count = [], [], 0, 0
    infinite = any("the pressure jumps" in warning for warning in result.warnings)
    for name in COMPARED:
        if name not in result.quantities:
            continue
        one, other = result[name], finer[name]
        if one.uncertainty is None or other.uncertainty is None:
            stated = any(warning.startswith(f"{name}: unknown uncertainty") for warning in result.warnings)
            if not (stated or (infinite and name in {*CARRIED, *PUMPED})):
                unknown.append(f"{name} has no uncertainty")
            continue
        difference, slack = abs(other.value - one.value), 1e-9 * abs(one.value)
        count += 1
        inside += difference <= one.uncertainty + slack
        if difference > one.uncertainty + other.uncertainty + slack:
            apart.append(
                f"{name} differs by {difference:.3g} from that on a finer grid, the uncertainties are "
                f"{one.uncertainty:.3g} and {other.uncertainty:.3g}"
            )
    return apart, unknown, inside, count
