"""Pairs of films with temperatures: exact solutions, limits, warmer supplies, other models, and films under a load."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from roughfilm.contact.foundation.arrays import Array
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.stability.form import Judgement
from roughfilm.stability.questions.thermal import (
    CAPACITY,
    DENSITY,
    FILM,
    ISOTHERMAL,
    LENGTH,
    SPEED,
    SUPPLIED,
    THINNING,
    film,
    lubricant,
    viscosity,
)

NO_THINNING = 1e-9
"""β of a lubricant whose viscosity hardly depends on temperature, 1/K."""

SAME = 1e-6
"""Allowed relative difference of a film of such a lubricant from the isothermal one."""

WARMER = 20.0
"""Temperature of a warmer supply above the other one, K."""

FACTOR = 2.0
"""Largest ratio of the friction of ``heat_balance`` and ``adiabatic``, and of their heats."""

SAME_FILM = 1e-4
"""Allowed relative difference of the film under a load from the known one, beyond uncertainties."""


@dataclass(frozen=True, kw_only=True)
class Compared:
    """An answer and what is asked of it.

    Attributes
    ----------
    error : its error.
    faults : what is wrong, in words.
    films : number of films on the finest grid.
    """

    error: float
    faults: tuple[str, ...]
    films: int


def judged_pair(answer: Compared) -> Judgement:
    """The judgement of an answer that was compared."""
    return Judgement(
        iterations=answer.films, right=not answer.faults, error=answer.error, message="; ".join(answer.faults)
    )


def _solved(
    geometry: Mapping[str, Any], table: Mapping[str, Any], tables: Mapping[str, Any], model: str, cells: int
) -> Result:
    return find("bearing", model).solve(film(geometry, table, **tables), Request(resolution=cells))


def _films(result: Result) -> int:
    return round(result.numerics.details.get("heated_films", 1.0))


def exact_wedge(rise: float, heating: float) -> dict[str, float]:
    """The load, friction and largest temperature of a wide wedge, by shooting for its flow q, m²/s.

    ∂p/∂x = 6 η u/h² - 12 η q/h³ and ρ c q ∂T/∂x = η u²/h + 12 η (q - u h/2)²/h³ with η(T) = η₀ exp(-β (T - T₀)), and
    p = 0 at both ends.

    Parameters
    ----------
    rise : h at the inlet over that at the outlet, less 1.
    heating : heating number.
    """
    least = viscosity(heating)

    def along(flow: float) -> Any:
        def slopes(x: float, values: Array) -> list[float]:
            h = FILM * (1 + rise * (1 - x / LENGTH))
            eta = least * np.exp(-THINNING * values[1])
            gradient = 6 * eta * SPEED / h**2 - 12 * eta * flow / h**3
            power = eta * SPEED**2 / h + 12 * eta * (flow - SPEED * h / 2) ** 2 / h**3
            pull = eta * SPEED / h + h / 2 * gradient
            return [gradient, power / (DENSITY * CAPACITY * flow), values[0], pull]

        return solve_ivp(slopes, (0.0, LENGTH), [0.0, 0.0, 0.0, 0.0], rtol=1e-9, atol=1e-9, method="LSODA")

    most = SPEED * FILM * (1 + rise) / 2
    flow = brentq(lambda one: float(along(one).y[0, -1]), SPEED * FILM / 2 * (1 + 1e-9), most, xtol=1e-16, rtol=1e-12)
    _, temperature, load, friction = along(flow).y[:, -1]
    return {
        "load_per_width": float(load),
        "friction_per_width": float(friction),
        "temperature_max": SUPPLIED + float(temperature),
    }


def against_exact(rise: float, heating: float, cells: int) -> Compared:
    """Solve a wide wedge by ``adiabatic``, and compare it with its exact solution."""
    geometry = {"shape": "linear", "length": f"{LENGTH!r} m", "film": f"{FILM!r} m", "rise": f"{rise * FILM!r} m"}
    result, truth = _solved(geometry, lubricant(heating), {}, "adiabatic", cells), exact_wedge(rise, heating)
    faults = []
    for name, value in truth.items():
        found = result[name]
        if found.uncertainty is None or abs(found.value - value) > found.uncertainty:
            faults.append(f"{name} is {found.value:.6g}, exact {value:.6g}, uncertainty {found.uncertainty or 0.0:.2g}")
    error = abs(result["load_per_width"].value / truth["load_per_width"] - 1)
    return Compared(error=error, faults=tuple(faults), films=_films(result))


def against_isothermal(geometry: Mapping[str, Any], tables: Mapping[str, Any], model: str, cells: int) -> Compared:
    """Solve a film whose viscosity hardly depends on temperature, and compare it with the isothermal one."""
    table = {
        **lubricant(0.1),
        "thermoviscosity": {"law": "exponential", "temperature_coefficient": f"{NO_THINNING} 1/K"},
    }
    result, cold = (_solved(geometry, table, tables, one, cells) for one in (model, ISOTHERMAL))
    errors = {name: abs(result[name].value / cold[name].value - 1) for name in ("load", "friction")}
    faults = tuple(
        f"{name} differs by {error:.2g} from the isothermal one" for name, error in errors.items() if error > SAME
    )
    return Compared(error=max(errors.values()), faults=faults, films=_films(result))


def against_warmer(geometry: Mapping[str, Any], tables: Mapping[str, Any], model: str, cells: int) -> Compared:
    """Solve a film with a supply at the reference temperature and with a warmer one, whose friction must be less.

    The rise of the temperature must be less too, as the same film of a thinner lubricant heats less.
    """
    cold = lubricant(1.0)
    thinner = viscosity(1.0) * float(np.exp(-THINNING * WARMER))
    warm = {**cold, "temperature": f"{SUPPLIED + WARMER!r} degC", "viscosity": f"{thinner!r} Pa*s"}
    one, other = (_solved(geometry, table, tables, model, cells) for table in (cold, warm))
    faults = []
    if not other["friction"].value < one["friction"].value:
        faults.append(f"the friction grows from {one['friction'].value:.5g} to {other['friction'].value:.5g} N")
    rises = [r["outlet_temperature"].value - t for r, t in ((one, SUPPLIED), (other, SUPPLIED + WARMER))]
    if not rises[1] < rises[0]:
        faults.append(f"the rise of the temperature grows from {rises[0]:.4g} to {rises[1]:.4g} K")
    return Compared(error=0.0, faults=tuple(faults), films=_films(other))


def against_adiabatic(geometry: Mapping[str, Any], tables: Mapping[str, Any], heating: float, cells: int) -> Compared:
    """Solve a film by ``heat_balance`` and ``adiabatic``, whose frictions and heats must be of the same size."""
    one, other = (
        _solved(geometry, lubricant(heating), tables, model, cells) for model in ("heat_balance", "adiabatic")
    )
    ratios = {name: one[name].value / other[name].value for name in ("friction", "heat_to_lubricant", "load")}
    faults = tuple(
        f"{name} is {ratio:.3g} of that by adiabatic"
        for name, ratio in ratios.items()
        if not 1 / FACTOR < ratio < FACTOR
    )
    return Compared(error=abs(ratios["friction"] - 1), faults=faults, films=_films(other))


def loaded(geometry: Mapping[str, Any], tables: Mapping[str, Any], heating: float, model: str, cells: int) -> Compared:
    """Solve for the load of a known film with temperatures, then search the film of this load."""
    table = lubricant(heating)
    known = _solved(geometry, table, tables, model, cells)
    free = {key: entry for key, entry in geometry.items() if key not in ("film", "eccentricity")}
    load = {"load": {"force": f"{known['load'].value!r} N"}}
    result = _solved(free, table, {**tables, **load}, model, cells)
    least, found = known["film_min"].value, result["film_min"]
    error, slack = abs(found.value / least - 1), SAME_FILM + (found.uncertainty or 0.0) / least
    carried = result["load"].value / known["load"].value - 1
    faults = [f"the film differs by {error:.2g} from the known one"] if error > slack else []
    if abs(carried) > SAME_FILM:
        faults.append(f"the load differs by {carried:.2g}")
    return Compared(error=error, faults=tuple(faults), films=_films(result))
