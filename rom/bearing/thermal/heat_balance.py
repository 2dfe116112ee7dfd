"""The film at the one temperature at which its heat is balanced."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Protocol, TypeVar

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.timing import working_time
from roughfilm.contact.foundation.units import ZERO_CELSIUS, Quantity
from roughfilm.rom.bearing.quantities import Outputs
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shear_thinning import thinning
from roughfilm.rom.bearing.solve import solve
from roughfilm.rom.bearing.thermal.balanced import balanced
from roughfilm.rom.bearing.thermal.exchange import (
    ESTIMATED,
    Exchange,
    Temperatures,
    coldest,
    exchange_of,
    temperatures,
)
from roughfilm.rom.bearing.thermal.isothermal import isothermal_model
from roughfilm.rom.bearing.thermal.leading import leading_input, leading_warning
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.lubricants.liquid import Liquid

TEMPERATURE_TOLERANCE = 1e-5
"""Error of the effective temperature on the finest grid at which the search stops, K."""

COARSE_TOLERANCE = 1e-3
"""The same on the coarse grid, from which the finer ones start, K."""

DIFFERENCE = 0.25
"""Step of the temperature over which derivatives are taken, K."""

MAX_FINE_FILMS = 8
"""Largest number of films on the finest grid."""

ORDER = 2
"""Order at which the temperature is extrapolated to the finest grid."""

REFINED = 4
"""Cells of the finest grid over those of the coarse one from which on a grid between them is solved."""

EFFECTIVE = "effective_temperature"

FilmT = TypeVar("FilmT")
FoundT = TypeVar("FoundT", covariant=True)


@dataclass(frozen=True, kw_only=True)
class Sensitivity:
    """The changes of a film with the temperature T of its lubricant.

    Attributes
    ----------
    slope : change of the temperature that the heat of the film brings about with T, at most 0 for a film whose friction
        falls with T.
    changes : change of each quantity with T, in its unit per K.
    """

    slope: float = 0.0
    changes: Mapping[str, float] = field(default_factory=dict)


INSENSITIVE = Sensitivity()
"""No changes, which leave a film at the temperature at which it is solved."""


@dataclass(frozen=True, kw_only=True)
class Heated:
    """The outputs of a film at one temperature, with the temperatures that its heat brings about.

    On each grid the heat is balanced at a temperature of its own, T + (T_eq - T)/(1 - dT_eq/dT), and the quantities are
    those at it, to first order in its difference to T.

    Attributes
    ----------
    base : the outputs of the isothermal model.
    liquid : the lubricant over temperature.
    temperature : temperature T of the film, K.
    sensitivity : changes with T.
    """

    base: Outputs
    liquid: Liquid
    temperature: float
    sensitivity: Sensitivity = INSENSITIVE

    @property
    def outputs(self) -> Outputs:
        """The functions that evaluate the film."""
        return replace(
            self.base,
            quantities=self.quantities,
            factor_uncertainties=self.factor_uncertainties,
            iteration_uncertainties=self.transfer_uncertainties,
            warnings=self.warnings,
        )

    def warnings(self, scene: Bearing, solution: Solution) -> list[str]:
        """The warnings of the isothermal model, and the input on which the temperature depends most."""
        leading = leading_input(scene, solution, self.base.quantities(scene, solution), self.liquid, self.temperature)
        return [*self.base.warnings(scene, solution), *leading_warning(leading)]

    def quantities(self, scene: Bearing, solution: Solution) -> dict[str, Quantity]:
        """The quantities of the isothermal model, its temperatures and heat flows."""
        quantities = self.base.quantities(scene, solution)
        exchange = exchange_of(scene, solution, quantities, self.liquid.temperature)
        found = temperatures(exchange, self.liquid)
        quantities |= heat_quantities(exchange, found, wide=solution.problem.shape.wide)
        step = (found.effective - self.temperature) / (1 - self.sensitivity.slope)
        changes = {**self.sensitivity.changes, EFFECTIVE: 0.0}
        moved = {
            name: replace(one, value=one.value + changes.get(name, 0.0) * step) for name, one in quantities.items()
        }
        return moved | {EFFECTIVE: replace(quantities[EFFECTIVE], value=self.temperature + step - ZERO_CELSIUS)}

    def factor_uncertainties(
        self, scene: Bearing, solution: Solution, quantities: Mapping[str, Quantity]
    ) -> dict[str, float]:
        """The uncertainties that flow factors cause, at the temperature and by the temperature that they change."""
        own = dict(self.base.factor_uncertainties(scene, solution, quantities))
        power, flow = (
            max(
                (own.get(name, 0.0) / abs(quantities[name].value) for name in names if quantities[name].value),
                default=0.0,
            )
            for names in ([n for n in quantities if n.startswith("power_loss")], [n for n in quantities if "flow" in n])
        )
        rise = abs(self.temperature - self.liquid.temperature)
        shift = (power + flow) * rise / (1 - self.sensitivity.slope)
        changes = self.sensitivity.changes
        uncertainties = {name: own.get(name, 0.0) + abs(changes.get(name, 0.0)) * shift for name in quantities}
        hot = dict.fromkeys(("inlet_temperature", "outlet_temperature"), (power + flow) * rise)
        generated = {
            name: power * abs(one.value)
            for name, one in quantities.items()
            if name.startswith(("heat_", "bearing_heat_"))
        }
        extra = {**hot, **generated, EFFECTIVE: shift}
        return {name: value + extra.get(name, 0.0) for name, value in uncertainties.items()}

    def transfer_uncertainties(
        self, scene: Bearing, levels: Sequence[Solution], quantities: Mapping[str, Quantity]
    ) -> dict[str, float]:
        """The uncertainties by a heat transfer to the surroundings that is estimated: its range at this film.

        Each end of the range changes the temperatures that the heat of the film brings about, and with that of the film
        all quantities, to first order.
        """
        exchange = exchange_of(scene, levels[0], self.base.quantities(scene, levels[0]), self.liquid.temperature)
        here = temperatures(exchange, self.liquid)
        if not here.estimated:
            return {}
        wide = levels[0].problem.shape.wide
        own = heat_quantities(exchange, here, wide=wide)
        ends = [
            heat_quantities(exchange, temperatures(exchange, self.liquid, part=part), wide=wide) for part in ESTIMATED
        ]
        shifts = {name: max(abs(end[name].value - one.value) for end in ends) for name, one in own.items()}
        balanced, changes = shifts[EFFECTIVE] / (1 - self.sensitivity.slope), self.sensitivity.changes
        uncertainties = {name: abs(changes.get(name, 0.0)) * balanced for name in quantities}
        return uncertainties | shifts | {EFFECTIVE: balanced}


def heat_quantities(exchange: Exchange, found: Temperatures, *, wide: bool) -> dict[str, Quantity]:
    """The temperatures, °C, and heat flows, W (W/m if infinitely wide), of a film with one temperature.

    ``effective_temperature`` is that of the film, ``inlet_temperature`` that of the mixture of new and recirculated
    lubricant, ``outlet_temperature`` that of what leaves. ``heat_generated`` is the power of friction and of the
    pressures at the edges, ``heat_to_lubricant`` and ``heat_to_surroundings`` are what takes it away.
    """
    suffix, unit = ("_per_width", "W/m") if wide else ("", "W")
    heats = {
        "heat_generated": exchange.power,
        "heat_to_lubricant": found.to_lubricant,
        "heat_to_surroundings": found.to_surroundings,
    }
    degrees = {EFFECTIVE: found.effective, "inlet_temperature": found.inlet, "outlet_temperature": found.outlet}
    return {
        **{name: Quantity(value=value - ZERO_CELSIUS, unit="degC") for name, value in degrees.items()},
        **{f"{name}{suffix}": Quantity(value=value, unit=unit) for name, value in heats.items()},
    }


def solve_heat_balance(solver: Model[Bearing], scene: Bearing, request: CheckedRequest, progress: Progress) -> Result:
    """Solve the isothermal film of a scene at the temperature at which its heat is balanced.

    The temperature is sought on a coarse grid, extrapolated from there and from a grid between to the finest one, and
    corrected there until the film has the temperature that its heat brings about to ``TEMPERATURE_TOLERANCE``. A
    lubricant whose viscosity does not change has the film of the isothermal model to the last bit. One that thins with
    shear has the film of ``shear_thinning`` at that temperature.

    The uncertainty of a quantity is that of the isothermal model, where the heat is balanced on each grid at a
    temperature of its own. It contains no error of the model, which takes one temperature for the whole film.

    Parameters
    ----------
    solver : the model.
    request : the numerical options.

    Raises
    ------
    InputError
        If no film carries the load, neither flows nor the surroundings take the heat away, or friction heats the
        film without end.
    ConvergenceError
        If the film, its load or its temperature does not converge.
    """
    wall, cpu = time.perf_counter(), working_time()
    liquid = scene.lubricant.liquid
    sizes = grids(solver.offered(scene).series, request.resolution)

    def film(temperature: float, cells: int, sensitivity: Sensitivity = INSENSITIVE) -> Result:
        model = isothermal_model(scene)
        outputs = model.outputs if cells == request.resolution else model.outputs.searched
        heated = Heated(base=outputs, liquid=liquid, temperature=temperature, sensitivity=sensitivity)
        hot = scene.at_temperature(temperature)
        return solve(
            solver,
            hot,
            replace(request, resolution=cells),
            partial(_within, progress, cells / request.resolution),
            film=model.film,
            ruptures=True,
            outputs=heated.outputs,
            heat=thinning(hot),
            **model.more,
        )

    result, error, films = balanced_film(film, _values, scene, sizes)
    numerics = replace(
        result.numerics,
        cpu_s=working_time() - cpu,
        wall_s=time.perf_counter() - wall,
        details={**result.numerics.details, "heat_balance": error, "heated_films": float(films)},
    )
    temperature = _values(result)[EFFECTIVE] + ZERO_CELSIUS
    hot = scene.lubricant.hot(temperature)
    return replace(
        result,
        numerics=numerics,
        provenance={**result.provenance, "scene": scene_entries(scene)},
        warnings=tuple(dict.fromkeys([*result.warnings, *hot])),
    )


def _within(progress: Progress, share: float, fraction: float, words: str) -> None:
    """Report the progress of a film on a grid with a share of the finest cells along a side."""
    progress(share * fraction, words)


def _values(result: Result) -> dict[str, float]:
    return {name: quantity.value for name, quantity in result.quantities.items()}


def grids(series: Sequence[int], cells: int) -> list[int]:
    """Numbers of cells from the coarse grid to the finest one."""
    return [size for size in series if size < cells] + [cells]


class FilmAt(Protocol[FoundT]):
    """The film at a temperature, K, on a grid of so many cells, evaluated by :class:`Heated`."""

    def __call__(self, temperature: float, cells: int, sensitivity: Sensitivity = ..., /) -> FoundT:
        """Solve the film."""
        ...


def balanced_film(
    film: FilmAt[FilmT], values: Callable[[FilmT], Mapping[str, float]], scene: Bearing, sizes: Sequence[int]
) -> tuple[FilmT, float, int]:
    """The film on the finest grid at the temperature at which its heat is balanced.

    Parameters
    ----------
    film : film(temperature, cells, sensitivity), the film at a temperature, K.
    values : values(film), its quantities, among them ``effective_temperature`` in °C.
    scene : the bearing.
    sizes : numbers of cells from the coarse grid to the finest one.

    Returns
    -------
    film, error of its temperature, K, and number of films on the finest grid.

    Raises
    ------
    InputError
        If neither flows nor the surroundings take the heat away, or friction heats the film without end.
    ConvergenceError
        If a film or its temperature does not converge.
    """

    def effective(temperature: float, cells: int, sensitivity: Sensitivity = INSENSITIVE) -> float:
        return values(film(temperature, cells, sensitivity))[EFFECTIVE] + ZERO_CELSIUS

    finest = sizes[-1]
    coarse, guess, sensitivity = _on_coarse_grid(film, values, scene, sizes)
    guesses = [(coarse, guess)]
    if finest >= REFINED * coarse:
        guesses.append((finest // 2, effective(guess, finest // 2, sensitivity)))
    temperature, films = _extrapolated(guesses, finest), 0
    while True:
        found, films = film(temperature, finest, sensitivity), films + 1
        brought_about = values(found)[EFFECTIVE] + ZERO_CELSIUS
        error = abs(brought_about - temperature)
        if error <= TEMPERATURE_TOLERANCE:
            return found, error, films
        if films == MAX_FINE_FILMS:
            raise ConvergenceError(
                f"heat_balance: the temperature still changes by {error:.2g} K after {films} films; take another "
                "resolution"
            )
        temperature = brought_about


def _on_coarse_grid(
    film: FilmAt[FilmT], values: Callable[[FilmT], Mapping[str, float]], scene: Bearing, sizes: Sequence[int]
) -> tuple[int, float, Sensitivity]:
    """The cells of the coarsest grid that has a film, its temperature, K, and the sensitivity there."""
    supplied = scene.lubricant.liquid.temperature

    def effective(cells: int, temperature: float) -> float:
        return values(film(temperature, cells))[EFFECTIVE] + ZERO_CELSIUS

    for cells in sizes:
        last = cells == sizes[-1]
        tolerance = TEMPERATURE_TOLERANCE / 4 if last else COARSE_TOLERANCE
        try:
            found = balanced(
                partial(effective, cells), supplied, coldest=coldest(scene, supplied), tolerance=tolerance
            ).temperature
            one, other = values(film(found, cells)), values(film(found + DIFFERENCE, cells))
        except (InputError, ConvergenceError):
            if last:
                raise
            continue
        changes = {name: (other[name] - value) / DIFFERENCE for name, value in one.items() if name in other}
        slope = changes.pop(EFFECTIVE)
        return cells, found, Sensitivity(slope=slope, changes=changes)
    raise AssertionError(sizes)


def _extrapolated(guesses: list[tuple[int, float]], cells: int) -> float:
    """The temperature on the finest grid, K, from those on coarser ones, at second order."""
    if len(guesses) == 1:
        return guesses[0][1]
    (coarse, one), (middle, other) = guesses
    coarse_part, middle_part, fine_part = (float(size) ** -ORDER for size in (coarse, middle, cells))
    return other + (other - one) * (fine_part - middle_part) / (middle_part - coarse_part)
